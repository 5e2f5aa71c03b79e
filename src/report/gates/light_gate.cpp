#include "report/gates/light_gate.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "assign/contract/assigner.h"
#include "core/pattern.h"
#include "core/text.h"
#include "report/cases/case_filter.h"
#include "report/cases/columns.h"
#include "report/cases/nothing_seen.h"
#include "report/cases/scene_lights.h"
#include "result/at.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {
namespace {

using result::CameraPath;
using result::Case;
using result::number;
using result::Result;
using result::Scene;
using result::SceneLights;

constexpr const char* k_dark = "intensity 0, black, or range 0";

// The lights of a scene as seen by one camera; equal for all grids and methods.
struct LightsOfView {
  std::string scene, camera;
  double all = 0.0, lit = 0.0, in_view = 0.0, seen = 0.0;
};

// Null for cases without these counts. Older ones do not record which lights shine; all are assumed to.
std::optional<LightsOfView> lights_of_view(const Case& result_case) {
  const std::optional<double> in_view = number<&Case::lights_in_view, &result::LightsInView::max>(result_case);
  if (!in_view) return std::nullopt;
  const double all = number<&Case::lights>(result_case).value_or(0.0);
  return LightsOfView{shown(result_case.scene),
                      shown(result_case.camera),
                      all,
                      number<&Case::lights_lit>(result_case).value_or(all),
                      *in_view,
                      number<&Case::lights_seen>(result_case).value_or(*in_view)};
}

std::string lights_number(double lights, const char* light = "light") {
  return number_of(static_cast<std::uint64_t>(lights), light);
}

// "of 10 lights 3 are dark"
std::string dark_text(const LightsOfView& lights) {
  const double dark = lights.all - lights.lit;
  return "of " + lights_number(lights.all) + " " + (lights.lit == 0.0 ? "all" : config::budget_number(dark)) +
         (dark == 1.0 && lights.lit > 0.0 ? " is dark" : " are dark");
}

// Why the camera sees no light that a budget could apply to; "" if it sees one. A level with all lights switched off
// has the same number of lights, but none is lit.
std::string why_no_lights(const LightsOfView& lights) {
  const std::string in_camera = lights.scene + ", camera " + lights.camera + ": none of ";
  if (lights.all == 0.0) return lights.scene + ": has no point or spot lights";
  if (lights.lit == 0.0) return lights.scene + ": " + dark_text(lights) + " (" + k_dark + ")";
  if (lights.in_view == 0.0) return in_camera + lights_number(lights.all) + " is ever in view";
  if (lights.seen > 0.0) return "";
  return in_camera + lights_number(lights.lit, "lit light") + " is ever in view (" + dark_text(lights) + ": " + k_dark +
         ")";
}

void add_no_lights(const Result& result, bool are_allowed, LimitFindings& findings) {
  for (const Case& result_case : result.cases) {
    const std::optional<LightsOfView> lights = lights_of_view(result_case);
    if (!lights) continue;
    const std::string why = why_no_lights(*lights);
    if (!why.empty())
      add_once(why + ", so budgets say nothing of it" +
                   (are_allowed ? "" : " (--allow-no-lights, limits.allow_no_lights, if that is meant)"),
               are_allowed ? findings.warnings : findings.broken);
  }
}

bool is_view_measured(const Result& result, const std::string& skipped_name) {
  return std::ranges::any_of(result.cases, [&](const Case& result_case) {
    return skipped_name.starts_with(result_case.scene + "/" + result_case.camera + "/");
  });
}

// "level/camera" of "level/camera/grid/method"; "" if the name is not a case, such as "level/samples visible".
std::string view_of(const std::string& scene, const std::string& skipped_name) {
  if (!skipped_name.starts_with(scene + "/")) return "";
  const std::size_t slash = skipped_name.find('/', scene.size() + 1);
  return slash == std::string::npos ? "" : skipped_name.substr(0, slash);
}

// Scenes and cameras of which all combinations were skipped.
void add_not_measured(const Result& result, bool are_no_lights_allowed, LimitFindings& findings) {
  struct View {
    std::string name, first_reason;
    std::uint64_t combinations = 0;
    bool has_no_lights = false;
  };
  std::vector<View> views;
  for (const Scene& scene : result.scenes)
    for (const result::Skipped& skipped : result.skipped) {
      const std::string view = view_of(scene.name, skipped.name);
      if (view.empty() || is_view_measured(result, skipped.name)) continue;
      const bool has_no_lights = lights_text(scene) == "no lights";
      auto found = std::ranges::find(views, view, &View::name);
      if (found == views.end()) found = views.insert(views.end(), {view, shown(skipped.reason), 0, has_no_lights});
      ++found->combinations;
    }
  for (const View& view : views) {
    const bool is_allowed = view.has_no_lights && are_no_lights_allowed;
    (is_allowed ? findings.warnings : findings.broken)
        .push_back(view.name + ": " + (view.has_no_lights ? "has no point or spot lights, and " : "") + "none of its " +
                   number_of(view.combinations, "combination") +
                   " could be measured, so budgets say nothing of it: " + view.first_reason);
  }
}

// Scenes, cameras and viewports of the base without a case in the result, each once.
void add_gone_views(const Result& result, const LightGate& gate, LimitFindings& findings) {
  const Pattern wanted(gate.filter, "--filter");
  std::vector<std::string> gone;
  for (const Case& base_case : gate.base->cases) {
    if (!is_selected(wanted, base_case)) continue;
    const Scene* then = scene_named(gate.base->scenes, base_case.scene);
    const Scene* now = then == nullptr ? nullptr : scene_before(result, *gate.base, *then);  // its successor
    const auto is_of_camera = [&](const Case& result_case) {
      return result_case.scene == now->name && result_case.camera == base_case.camera;
    };
    const auto is_of_view = [&](const Case& result_case) {
      return is_of_camera(result_case) && result_case.viewport == base_case.viewport;
    };
    const bool is_there = now != nullptr && std::ranges::any_of(result.cases, is_of_view);
    std::string view = shown(base_case.scene);
    if (now != nullptr) view += ", camera " + shown(base_case.camera);
    if (now != nullptr && std::ranges::any_of(result.cases, is_of_camera))
      view += ", " + viewport_text(base_case.viewport);
    if (!is_there && std::ranges::find(gone, view) == gone.end()) gone.push_back(view);
  }
  for (const std::string& view : gone)
    findings.broken.push_back(view + ": was measured in " + gate.base_name +
                              ", and this result has no case of it, so budgets say nothing of it; measure it or the " +
                              "baseline again, or leave it out (--filter)");
}

std::vector<std::string_view> parts_of(std::string_view name) {
  std::vector<std::string_view> parts;
  for (std::size_t slash = name.find('/'); slash != std::string_view::npos; slash = name.find('/')) {
    parts.push_back(name.substr(0, slash));
    name.remove_prefix(slash + 1);
  }
  parts.push_back(name);
  return parts;
}

// Whether a skipped combination has the case. Its name has parts of the case's name in their order, without those that
// all skipped cases do not share: the storage.
bool is_among_skipped(const std::string& case_name, const std::string& skipped) {
  const std::vector<std::string_view> all = parts_of(case_name), some = parts_of(skipped);
  std::size_t found = 0;
  for (const std::string_view part : all) found += found < some.size() && some[found] == part ? 1 : 0;
  constexpr std::size_t k_up_to_method = 4;  // scene, camera, grid and method
  const std::size_t first = std::min(k_up_to_method, some.size());
  return found == some.size() && all.size() >= first && std::equal(some.begin(), some.begin() + first, all.begin());
}

// A structure that has nothing of its grid is measured in one grid, and skipped in the others.
bool is_measured_in_another_grid(const Result& result, const Case& base_case) {
  const assign::AssignerDescriptor* method = assign::find_assigner(base_case.assigner.name);
  if (method == nullptr || !method->own_without_grid || base_case.storage != run::k_own_structure) return false;
  return std::ranges::any_of(result.cases, [&](const Case& one) {
    return one.scene == base_case.scene && one.camera == base_case.camera && one.viewport == base_case.viewport &&
           one.assigner.label == base_case.assigner.label && one.storage == base_case.storage;
  });
}

// Cases of the base that the configuration still has, and that could not be measured: a driver that has gone.
void add_left_out(const Result& result, const LightGate& gate, LimitFindings& findings) {
  const Pattern wanted(gate.filter, "--filter");
  const auto is_measured = [&](const Case& base_case) {
    return std::ranges::find(result.cases, base_case.name, &Case::name) != result.cases.end() ||
           is_measured_in_another_grid(result, base_case);
  };
  for (const result::Skipped& skipped : result.skipped) {
    const auto is_gone = [&](const Case& base_case) {
      return base_case.preset == skipped.preset && is_among_skipped(base_case.name, skipped.name) &&
             is_selected(wanted, base_case) && !is_measured(base_case);
    };
    const auto count = std::ranges::count_if(gate.base->cases, is_gone);
    if (count == 0) continue;
    findings.broken.push_back(shown(skipped.name) + ": was measured in " + gate.base_name + " (" +
                              number_of(static_cast<std::size_t>(count), "case") +
                              ") and not here: " + shown(skipped.reason));
  }
}

void add_changed_lights(const Result& result, const LightGate& gate, LimitFindings& findings) {
  for (const Scene& scene : result.scenes) {
    const Scene* before = scene_before(*gate.base, result, scene);
    const std::string name = shown(scene.name);
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
        (lights_text(*before) == lights_text(scene) ? "still " + lights_text(scene) + ", some of them moved or changed"
                                                    : counts);
    if (gate.allows_changed_lights)
      findings.warnings.push_back(text);
    else
      findings.broken.push_back(text + " (--allow-changed-lights, limits.allow_changed_lights, if that is meant)");
  }
}

PathSpan span_of(const CameraPath& path) {
  return {path.from_s, path.to_s};
}

// Figures of other frames are not comparable with the baseline's, even with the same lights.
void add_changed_paths(const Result& result, const LightGate& gate, LimitFindings& findings) {
  for (const Case& result_case : result.cases) {
    const Scene* scene = scene_named(result.scenes, result_case.scene);
    const Scene* before = scene == nullptr ? nullptr : scene_before(*gate.base, result, *scene);
    const std::optional<CameraPath>& now = result_case.camera_path;
    if (before == nullptr || !now || !now->digest) continue;
    const auto base_case = std::ranges::find_if(gate.base->cases, [&](const Case& candidate) {
      return candidate.scene == before->name && candidate.camera == result_case.camera;
    });
    if (base_case == gate.base->cases.end()) continue;
    const std::optional<CameraPath>& then = base_case->camera_path;
    if (!then || !then->digest || *then->digest == *now->digest) continue;
    add_once(path_change_text(shown(result_case.scene), shown(result_case.camera), span_of(*then), span_of(*now)) +
                 ", so budgets against " + gate.base_name + " compare other views",
             findings.warnings);
  }
}

}  // namespace

std::string path_change_text(const std::string& scene, const std::string& camera, const PathSpan& before,
                             const PathSpan& now) {
  const auto words = [](const PathSpan& span) { return text("%g to ", span.from_s) + text("%g s", span.to_s); };
  const bool is_as_long = before.from_s == now.from_s && before.to_s == now.to_s;
  return "the path of camera " + camera + " in " + scene + " has changed: " +
         (is_as_long ? "as long (" + words(now) + "), and another way or lens" : words(before) + ", now " + words(now));
}

LimitFindings light_findings(const Result& result, const LightGate& gate) {
  LimitFindings findings;
  add_no_lights(result, gate.allows_no_lights, findings);
  add_not_measured(result, gate.allows_no_lights, findings);
  if (gate.base == nullptr) return findings;
  add_changed_lights(result, gate, findings);
  add_changed_paths(result, gate, findings);
  add_gone_views(result, gate, findings);
  add_left_out(result, gate, findings);
  return findings;
}

}  // namespace clusterbench::report
