#include "report/case_settings.h"

#include <algorithm>

#include "report/light_changes.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

Json scene_of(const Json& result, const Json& result_case) {
  for (const Json& scene : result["scenes"])
    if (scene["name"] == result_case["scene"]) return scene;
  return {};
}

// What the scenes' requests say of a key, each answer once.
Json answers_of(const Json& result, const char* key) {
  Json answers = Json::array();
  for (const Json& scene : result["config"].value("scenes", Json::array()))
    if (scene.contains(key) && std::ranges::find(answers, scene[key]) == answers.end()) answers.push_back(scene[key]);
  return answers;
}

// "its lights (300 points, now 250 points)"; "" where they are the same, as far as results tell.
std::string lights_that_changed(const Json& base_scene, const Json& next_scene) {
  if (light_change(base_scene, next_scene) != LightChange::changed) return "";
  const std::string before = lights_text(base_scene), now = lights_text(next_scene);
  return "its lights (" +
         (before == now ? "still " + now + ", some of them moved or changed" : before + ", now " + now) + ")";
}

}  // namespace

std::vector<std::string> differing_settings(const Json& base, const Json& base_case, const Json& next,
                                            const Json& next_case) {
  std::vector<std::string> out;
  const auto tell = [&](const Json& left, const Json& right, const std::string& what, const char* pointer) {
    if (left.value(Pointer(pointer), Json()) != right.value(Pointer(pointer), Json())) out.push_back(what);
  };
  const Json base_scene = scene_of(base, base_case), next_scene = scene_of(next, next_case);
  tell(base_scene, next_scene, "the scene itself (sha256)", "/sha256");
  if (!base_scene.is_null() && !next_scene.is_null())
    if (const std::string lights = lights_that_changed(base_scene, next_scene); !lights.empty()) out.push_back(lights);
  tell(base_scene, next_scene, "range_rule", "/range_rule/cutoff_lux");
  tell(base_scene, next_scene, "range_rule", "/range_rule/max_range");
  if (const Json& frames = base_case["frames"], &now = next_case["frames"]; frames != now)
    out.push_back("frames (" + frames.dump() + ", now " + now.dump() + ")");
  for (const char* key : {"camera", "viewport", "grid", "storage"})
    tell(base_case, next_case, key, (std::string("/") + key).c_str());
  tell(base_case, next_case, "the assigner's parameters", "/assigner/params");
  tell(base_case, next_case, "precision", "/precision/label");
  tell(base_case, next_case, "pre_cull", "/pre_cull/label");
  for (const char* key :
       {"seed", "shading", "samples", "lookup", "stability", "jitter", "shadow_cull", "shadow_frusta"})
    tell(base["config"], next["config"], key, (std::string("/") + key).c_str());
  for (const char* key : {"camera_fit", "boxes", "fov", "far"})
    if (answers_of(base, key) != answers_of(next, key)) out.emplace_back(key);
  if (out.empty()) out.emplace_back("something that results do not tell");
  return out;
}

}  // namespace clusterbench::report
