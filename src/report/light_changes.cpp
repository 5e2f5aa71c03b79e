#include "report/light_changes.h"

#include <algorithm>
#include <utility>

#include "core/pattern.h"
#include "core/text.h"
#include "report/columns.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t lights_of_kind(const Json& scene, const char* kind) {
  return scene.contains("lights") ? scene["lights"].value(kind, std::uint64_t{0}) : 0;
}

// 0 also in results that are older than this count.
std::uint64_t dark_lights(const Json& scene) {
  return static_cast<std::uint64_t>(number_at(scene, "/range_rule/dark").value_or(0.0));
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

bool has_cases(const Json& result, const Json& scene) {
  return std::ranges::any_of(result["cases"],
                             [&](const Json& result_case) { return result_case["scene"] == scene["name"]; });
}

// A level whose lights are all switched off has as many as before, and nothing is lit.
void add_dark_lights(const Json& result, bool are_allowed, LimitFindings& findings) {
  for (const Json& scene : result["scenes"]) {
    const std::uint64_t dark = dark_lights(scene);
    if (dark == 0 || !has_cases(result, scene)) continue;
    const std::uint64_t all = lights_of_kind(scene, "point") + lights_of_kind(scene, "spot");
    const std::string what = shown(scene["name"]) + ": of " + number_of(all, "light") + " " +
                             (dark == all ? "all" : std::to_string(dark)) +
                             " are dark (intensity 0, black, or range 0)";
    if (dark < all || lights_of_kind(scene, "box") > 0)
      findings.warnings.push_back(what + ", and budgets count them as lights");
    else if (are_allowed)
      findings.warnings.push_back(what);
    else
      findings.broken.push_back(
          what + ", so budgets say nothing of it (--allow-no-lights, limits.allow_no_lights, if " + "that is meant)");
  }
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

bool is_view_measured(const Json& result, const std::string& skipped_name) {
  return std::ranges::any_of(result["cases"], [&](const Json& result_case) {
    return skipped_name.starts_with(result_case["scene"].get<std::string>() + "/" +
                                    result_case["camera"].get<std::string>() + "/");
  });
}

// "level/camera" of "level/camera/grid/method"; "" of what is no case, "level/samples visible".
std::string view_of(const std::string& scene, const std::string& skipped_name) {
  if (!skipped_name.starts_with(scene + "/")) return "";
  const std::size_t slash = skipped_name.find('/', scene.size() + 1);
  return slash == std::string::npos ? "" : skipped_name.substr(0, slash);
}

// Scenes and cameras of which all combinations were skipped.
void add_not_measured(const Json& result, bool are_no_lights_allowed, LimitFindings& findings) {
  struct View {
    std::string name, first_reason;
    std::uint64_t combinations = 0;
    bool has_no_lights = false;
  };
  std::vector<View> views;
  for (const Json& scene : result["scenes"])
    for (const Json& skipped : result["skipped"]) {
      const std::string name = skipped["name"].get<std::string>(), view = view_of(scene["name"], name);
      if (view.empty() || is_view_measured(result, name)) continue;
      const bool has_no_lights = lights_text(scene) == "no lights";
      auto found = std::ranges::find(views, view, &View::name);
      if (found == views.end()) found = views.insert(views.end(), {view, shown(skipped["reason"]), 0, has_no_lights});
      ++found->combinations;
    }
  for (const View& view : views) {
    const bool is_allowed = view.has_no_lights && are_no_lights_allowed;
    (is_allowed ? findings.warnings : findings.broken)
        .push_back(view.name + ": " + (view.has_no_lights ? "has no lights, and " : "") + "none of its " +
                   number_of(view.combinations, "combination") +
                   " could be measured, so budgets say nothing of it: " + view.first_reason);
  }
}

// The result's scene that stands for the base's; null: none.
const Json* scene_now(const Json& base, const Json& result, const Json& base_scene) {
  return scene_before(result, base, base_scene);
}

// Scenes and cameras of the base of which the result has no case, each once.
void add_gone_views(const Json& result, const LightGate& gate, LimitFindings& findings) {
  const Pattern wanted(gate.filter, "--filter");
  std::vector<std::string> gone;
  for (const Json& base_case : (*gate.base)["cases"]) {
    if (!wanted.is_in(base_case["name"].get<std::string>())) continue;
    const auto scenes = std::ranges::find_if((*gate.base)["scenes"],
                                             [&](const Json& scene) { return scene["name"] == base_case["scene"]; });
    const Json* now = scenes == (*gate.base)["scenes"].end() ? nullptr : scene_now(*gate.base, result, *scenes);
    const bool is_there =
        now != nullptr && std::ranges::any_of(result["cases"], [&](const Json& result_case) {
          return result_case["scene"] == (*now)["name"] && result_case["camera"] == base_case["camera"];
        });
    const std::string view =
        shown(base_case["scene"]) + (now == nullptr ? "" : ", camera " + shown(base_case["camera"]));
    if (!is_there && std::ranges::find(gone, view) == gone.end()) gone.push_back(view);
  }
  for (const std::string& view : gone)
    findings.broken.push_back(view + ": was measured in " + gate.base_name +
                              ", and this result has no case of it, so budgets say nothing of it; measure it or the " +
                              "baseline again, or leave it out (--filter)");
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
    const std::string text = name + ": its lights are not those of " + gate.base_name + ": " +
                             (are_as_many(*before, scene) && dark_lights(*before) == dark_lights(scene)
                                  ? "as many, " + lights_text(scene) + ", moved or changed"
                                  : counts);
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
  if (text.empty()) return "no lights";
  const std::uint64_t dark = dark_lights(scene);
  return dark == 0 ? text : text + ", " + std::to_string(dark) + " of them dark";
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
  add_dark_lights(result, gate.allows_no_lights, findings);
  add_not_measured(result, gate.allows_no_lights, findings);
  if (gate.base == nullptr) return findings;
  add_changed_lights(result, gate, findings);
  add_gone_views(result, gate, findings);
  return findings;
}

}  // namespace clusterbench::report
