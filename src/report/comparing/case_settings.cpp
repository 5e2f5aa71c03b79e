#include "report/comparing/case_settings.h"
#include "report/cases/scene_lights.h"

#include <algorithm>

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::Case;
using result::Result;
using result::Scene;

const Scene* scene_of(const Result& result, const Case& result_case) {
  const auto found = std::ranges::find(result.scenes, result_case.scene, &Scene::name);
  return found == result.scenes.end() ? nullptr : &*found;
}

// The values of a key in the scenes' requests, each once.
Json answers_of(const Result& result, const char* key) {
  Json answers = Json::array();
  for (const Json& scene : result.config.value("scenes", Json::array()))
    if (scene.contains(key) && std::ranges::find(answers, scene[key]) == answers.end()) answers.push_back(scene[key]);
  return answers;
}

// "its lights (300 points, now 250 points)"; "" if they are the same, as far as results record them.
std::string lights_that_changed(const Scene& base_scene, const Scene& next_scene) {
  if (light_change(base_scene, next_scene) != LightChange::changed) return "";
  const std::string before = lights_text(base_scene), now = lights_text(next_scene);
  return "its lights (" +
         (before == now ? "still " + now + ", some of them moved or changed" : before + ", now " + now) + ")";
}

void add_scene_settings(const Scene& base, const Scene& next, std::vector<std::string>& out) {
  if (base.sha256 != next.sha256) out.emplace_back("the scene itself (sha256)");
  if (const std::string lights = lights_that_changed(base, next); !lights.empty()) out.push_back(lights);
  const Json before = result::to_json(base.range_rule), now = result::to_json(next.range_rule);
  for (const char* key : {"cutoff_lux", "max_range"})
    if (before[key] != now[key]) out.emplace_back("range_rule");
}

void add_case_settings(const Case& base, const Case& next, std::vector<std::string>& out) {
  const auto tell = [&](bool is_same, const char* what) {
    if (!is_same) out.emplace_back(what);
  };
  const auto label_of = [](const auto& part) { return part ? part->label : std::string(); };
  if (base.frames != next.frames)
    out.push_back("frames (" + std::to_string(base.frames) + ", now " + std::to_string(next.frames) + ")");
  tell(base.camera == next.camera, "camera");
  tell(base.viewport == next.viewport, "viewport");
  tell(result::to_json(base.grid) == result::to_json(next.grid), "grid");
  tell(base.storage == next.storage, "storage");
  tell(base.assigner.params == next.assigner.params, "the assigner's parameters");
  tell(label_of(base.precision) == label_of(next.precision), "precision");
  tell(label_of(base.pre_cull) == label_of(next.pre_cull), "pre_cull");
}

}  // namespace

std::vector<std::string> differing_settings(const Result& base, const Case& base_case, const Result& next,
                                            const Case& next_case) {
  std::vector<std::string> out;
  const Scene *base_scene = scene_of(base, base_case), *next_scene = scene_of(next, next_case);
  if (base_scene != nullptr && next_scene != nullptr) add_scene_settings(*base_scene, *next_scene, out);
  add_case_settings(base_case, next_case, out);
  for (const char* key :
       {"seed", "shading", "samples", "lookup", "stability", "jitter", "shadow_cull", "shadow_frusta"})
    if (base.config.value(key, Json()) != next.config.value(key, Json())) out.emplace_back(key);
  for (const char* key : {"camera_fit", "boxes", "fov", "far"})
    if (answers_of(base, key) != answers_of(next, key)) out.emplace_back(key);
  if (out.empty()) out.emplace_back("something that results do not tell");
  return out;
}

}  // namespace clusterbench::report
