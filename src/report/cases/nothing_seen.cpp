#include "report/cases/nothing_seen.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "report/cases/case_samples.h"
#include "report/cases/columns.h"
#include "result/at.h"
#include "result/figures/case_figure.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::LightsInView;
using result::SampleSet;

constexpr const char* k_ground_key = "samples.opaque.ground=lowest";

// Sums over the samples that rank cases.
struct SeenAtSamples {
  std::size_t sets = 0;
  double samples = 0.0, needed = 0.0;
  std::optional<double> ground_m;
};

void add_set(const SampleSet& counts, SeenAtSamples& seen) {
  ++seen.sets;
  seen.samples += static_cast<double>(counts.samples);
  seen.needed += static_cast<double>(counts.needed);
  if (counts.ground_m) seen.ground_m = counts.ground_m;
}

void add_case(const Case& result_case, RankedBy by, SeenAtSamples& seen) {
  if (by == RankedBy::no_samples) return;
  for (const std::string& set : ranking_set_names(result_case)) {
    const SampleSet& counts = *samples_of_set(result_case, set);
    if (result_case.cost || set != "volume" || counts.samples > 0) add_set(counts, seen);
  }
}

// Over the samples of a figure: "opaque.unlit" is of one set, "unlit" of those that rank.
SeenAtSamples seen_at_samples_of(const std::string& figure, const std::vector<const Case*>& cases) {
  const std::string set = result::figure_at_samples(figure).set;
  SeenAtSamples seen;
  for (const Case* one : cases)
    for (const std::string& name : set.empty() ? ranking_set_names(*one) : std::vector<std::string>{set})
      if (const SampleSet* counts = samples_of_set(*one, name); counts != nullptr) add_set(*counts, seen);
  return seen;
}

std::string of_samples(const SeenAtSamples& seen) {
  if (seen.samples == 0.0 && seen.ground_m)
    return "no pixel sees the floor at y = " + height_text(*seen.ground_m) + " m (samples.opaque.ground)";
  if (seen.samples == 0.0) return "no pixel sees a surface";
  const std::string on_floor = seen.ground_m ? " on the floor at y = " + height_text(*seen.ground_m) + " m" : "";
  return "no light reaches any of " + text("%.0f", seen.samples) + " samples" + on_floor;
}

}  // namespace

std::uint64_t dark_lights(const result::Scene& scene) {
  return scene.lights.dark ? *scene.lights.dark : scene.range_rule.dark.value_or(0);
}

std::string why_nothing_is_seen(const std::vector<const Case*>& cases, RankedBy by) {
  if (cases.empty()) return "";
  const auto has_none = [&](std::optional<double> (*lights)(const Case&)) {
    return std::ranges::all_of(cases, [&](const Case* one) { return lights(*one) == 0.0; });
  };
  if (has_none(result::number<&Case::lights>)) return "the scene has no point or spot lights";
  if (has_none(result::number<&Case::lights_in_view, &LightsInView::max>)) return "no light is in view in any frame";
  if (has_none(result::number<&Case::lights_seen>)) return k_all_lights_dark;
  SeenAtSamples seen;
  for (const Case* one : cases) {
    SeenAtSamples of_case;
    add_case(*one, by, of_case);
    if (of_case.sets == 0) return "";  // ranked without samples
    if (of_case.needed > 0.0) return "";
    if (of_case.samples >= seen.samples) seen = of_case;
  }
  return of_samples(seen);
}

std::string why_no_samples(const std::vector<const Case*>& cases, const std::string& figure) {
  const SeenAtSamples seen = seen_at_samples_of(figure, cases);
  if (cases.empty() || !result::is_at_samples(figure) || seen.samples > 0.0) return "";
  const std::string set = result::figure_at_samples(figure).set;
  if (seen.sets == 0) return why_no_sets(cases, figure);
  return set.empty() || set == "opaque" ? of_samples(seen) : "there are no samples of " + result::words_of_set(set);
}

std::string why_no_sets(const std::vector<const Case*>& cases, const std::string& figure) {
  if (cases.empty() || !result::is_at_samples(figure) || seen_at_samples_of(figure, cases).sets > 0) return "";
  const std::string set = result::figure_at_samples(figure).set;
  const auto no_samples = [](const std::string& whose, const std::string& remedy) {
    return "there are no samples" + whose + " (" + remedy + ")";
  };
  if (set.empty())
    return no_samples(
        "", "keys samples and shading.samples; surfaces need triangles, or a floor: " + std::string(k_ground_key));
  const std::string of_set = " of " + result::words_of_set(set);
  if (set == "volume") return no_samples(of_set, "key shading.samples");
  if (set == "opaque")
    return no_samples(of_set,
                      "key samples.opaque; a scene without triangles needs a floor: " + std::string(k_ground_key));
  return no_samples(of_set,
                    "key samples." + set + (set == "transparent" ? "; the scene needs triangles that blend" : ""));
}

std::vector<std::string> views_of_dark_lights(const result::Result& result) {
  std::vector<std::string> views;
  for (const Case& result_case : result.cases) {
    const bool has_lights = result_case.lights_in_view && result_case.lights_in_view->max > 0;
    if (!has_lights || result_case.lights_seen != 0u) continue;
    const std::string view =
        shown(result_case.scene) + ", camera " + shown(result_case.camera) + ": " + k_all_lights_dark;
    if (std::ranges::find(views, view) == views.end()) views.push_back(view);
  }
  return views;
}

std::set<std::string> ids_of_nothing_seen(const std::vector<Case>& cases) {
  std::map<std::tuple<std::string, std::string, result::Counts2>, std::vector<const Case*>> views;
  for (const Case& one : cases) views[{one.scene, one.camera, one.viewport}].push_back(&one);
  std::set<std::string> ids;
  for (const auto& [_, of_view] : views) {
    if (why_nothing_is_seen(of_view, RankedBy::samples).empty()) continue;
    for (const Case* one : of_view) ids.insert(one->id);
  }
  return ids;
}

}  // namespace clusterbench::report
