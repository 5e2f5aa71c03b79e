#include "report/light_changes.h"

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "report/columns.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t lights_of_kind(const Json& scene, const char* kind) {
  return scene.contains("lights") ? scene["lights"].value(kind, std::uint64_t{0}) : 0;
}

bool are_as_many(const Json& a, const Json& b) {
  return std::ranges::all_of(std::initializer_list<const char*>{"point", "spot", "box"},
                             [&](const char* kind) { return lights_of_kind(a, kind) == lights_of_kind(b, kind); });
}

// Of cases of all grids and methods one for each scene, camera and viewport.
std::vector<const Json*> views_without_lights(const Json& result) {
  std::vector<const Json*> views;
  for (const Json& result_case : result["cases"]) {
    if (number_at(result_case, "/lights_in_view/max").value_or(1.0) > 0.0) continue;
    const auto is_same_view = [&](const Json* other) {
      return std::ranges::all_of(std::initializer_list<const char*>{"scene", "camera", "viewport"},
                                 [&](const char* key) { return (*other)[key] == result_case[key]; });
    };
    if (std::ranges::none_of(views, is_same_view)) views.push_back(&result_case);
  }
  return views;
}

void add_no_lights(const Json& result, bool are_allowed, LimitFindings& findings) {
  std::vector<std::string>& lines = are_allowed ? findings.warnings : findings.broken;
  const std::string advice = are_allowed ? "" : " (--allow-no-lights, limits.allow_no_lights, if that is meant)";
  std::string last_without;
  for (const Json* view : views_without_lights(result)) {
    const std::string scene = shown((*view)["scene"]);
    const std::uint64_t lights = view->value("lights", std::uint64_t{0});
    if (lights > 0)
      lines.push_back(scene + ", camera " + shown((*view)["camera"]) + ": none of " + number_of(lights, "light") +
                      " is ever in view, so budgets say nothing of it" + advice);
    else if (scene != std::exchange(last_without, scene))
      lines.push_back(scene + ": has no lights, so budgets say nothing of it" + advice);
  }
}

void add_changed_lights(const Json& result, const LightGate& gate, LimitFindings& findings) {
  for (const Json& scene : result["scenes"]) {
    const Json* before = scene_before(*gate.base, result, scene);
    const std::string name = shown(scene["name"]);
    if (before == nullptr) {
      findings.warnings.push_back(name + ": " + gate.base_name +
                                  " has no scene of this name, so its lights are not checked");
      continue;
    }
    const LightChange change = light_change(*before, scene);
    const std::string counts = lights_text(*before) + " then, " + lights_text(scene) + " now";
    if (change == LightChange::unknown)
      findings.warnings.push_back(name + ": " + gate.base_name +
                                  " is of an older version, which tells how many lights there were (" +
                                  lights_text(*before) + ", as now), but not which");
    if (change != LightChange::changed) continue;
    const std::string text =
        name + ": its lights are not those of " + gate.base_name + ": " +
        (are_as_many(*before, scene) ? "as many, " + lights_text(scene) + ", moved or changed" : counts);
    if (gate.allows_changed_lights)
      findings.warnings.push_back(text);
    else
      findings.broken.push_back(text + " (--allow-changed-lights, limits.allow_changed_lights, if that is meant)");
  }
}

}  // namespace

std::string lights_text(const Json& scene) {
  std::string text;
  for (const auto& [key, word] : {std::pair("point", "point"), std::pair("spot", "spot"), std::pair("box", "box")})
    if (const std::uint64_t count = lights_of_kind(scene, key); count > 0)
      text += (text.empty() ? "" : ", ") +
              (std::string(key) == "box" && count != 1 ? std::to_string(count) + " boxes" : number_of(count, word));
  return text.empty() ? "no lights" : text;
}

LightChange light_change(const Json& base_scene, const Json& next_scene) {
  const Json before = base_scene.value("light_digest", Json()), now = next_scene.value("light_digest", Json());
  if (!before.is_null() && !now.is_null()) return before == now ? LightChange::none : LightChange::changed;
  return are_as_many(base_scene, next_scene) ? LightChange::unknown : LightChange::changed;
}

const Json* scene_before(const Json& base, const Json& next, const Json& next_scene) {
  if (base["scenes"].size() == 1 && next["scenes"].size() == 1) return &base["scenes"][0];
  const auto found =
      std::ranges::find_if(base["scenes"], [&](const Json& scene) { return scene["name"] == next_scene["name"]; });
  return found == base["scenes"].end() ? nullptr : &*found;
}

LimitFindings light_findings(const Json& result, const LightGate& gate) {
  LimitFindings findings;
  add_no_lights(result, gate.allows_no_lights, findings);
  if (gate.base != nullptr) add_changed_lights(result, gate, findings);
  return findings;
}

}  // namespace clusterbench::report
