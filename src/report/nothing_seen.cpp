#include "report/nothing_seen.h"

#include <algorithm>
#include <map>
#include <optional>

#include "report/columns.h"
#include "report/json_values.h"
#include "report/sample_sets.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// They are in lists like others, and samples get them; but of light that is not there nothing can be lost.

// Of all samples that a ranking rests on.
struct SeenAtSamples {
  std::size_t sets = 0;
  double samples = 0.0, needed = 0.0;
  std::optional<double> ground_m;
};

void add_set(const Json& counts, SeenAtSamples& seen) {
  const std::optional<double> samples = number_at(counts, "/samples");
  if (!samples) return;
  ++seen.sets;
  seen.samples += *samples;
  seen.needed += number_at(counts, "/needed").value_or(0.0);
  if (const std::optional<double> ground_m = number_at(counts, "/ground_m")) seen.ground_m = ground_m;
}

void add_case(const Json& result_case, RankedBy by, SeenAtSamples& seen) {
  if (by == RankedBy::no_samples) return;
  const bool is_costed = result_case.contains("cost");
  for (const std::string& set : ranking_set_names(result_case)) {
    const Json& counts = *samples_of_set(result_case, set);
    if (is_costed || set != "volume" || number_at(counts, "/samples").value_or(0.0) > 0.0) add_set(counts, seen);
  }
}

std::string of_samples(const SeenAtSamples& seen) {
  if (seen.samples == 0.0 && seen.ground_m)
    return "no pixel sees the floor at y = " + height_text(*seen.ground_m) + " m (samples.opaque.ground)";
  if (seen.samples == 0.0) return "no pixel sees a surface";
  const std::string on_floor = seen.ground_m ? " on the floor at y = " + height_text(*seen.ground_m) + " m" : "";
  return "no light reaches any of " + text("%.0f", seen.samples) + " samples" + on_floor;
}

}  // namespace

std::uint64_t dark_lights(const Json& scene) {
  const std::optional<double> counted = number_at(scene, "/lights/dark");
  return static_cast<std::uint64_t>(counted ? *counted : number_at(scene, "/range_rule/dark").value_or(0.0));
}

std::string why_nothing_is_seen(const std::vector<const Json*>& cases, RankedBy by) {
  if (cases.empty()) return "";
  const auto has_none = [&](const char* pointer) {
    return std::ranges::all_of(cases, [&](const Json* one) { return number_at(*one, pointer) == 0.0; });
  };
  if (has_none("/lights")) return "the scene has no point or spot lights";
  if (has_none("/lights_in_view/max")) return "no light is in view in any frame";
  if (has_none("/lights_seen")) return k_all_lights_dark;
  SeenAtSamples seen;
  for (const Json* one : cases) {
    SeenAtSamples of_case;
    add_case(*one, by, of_case);
    if (of_case.sets == 0) return "";  // ranked without samples
    if (of_case.needed > 0.0) return "";
    if (of_case.samples >= seen.samples) seen = of_case;
  }
  return of_samples(seen);
}

std::vector<std::string> views_of_dark_lights(const Json& result) {
  std::vector<std::string> views;
  for (const Json& result_case : result["cases"]) {
    const bool has_lights = number_at(result_case, "/lights_in_view/max").value_or(0.0) > 0.0;
    if (!has_lights || number_at(result_case, "/lights_seen") != 0.0) continue;
    const std::string view =
        shown(result_case["scene"]) + ", camera " + shown(result_case["camera"]) + ": " + k_all_lights_dark;
    if (std::ranges::find(views, view) == views.end()) views.push_back(view);
  }
  return views;
}

std::set<std::string> ids_of_nothing_seen(const Json& cases) {
  std::map<std::string, std::vector<const Json*>> views;
  for (const Json& one : cases) views[Json{one["scene"], one["camera"], one["viewport"]}.dump()].push_back(&one);
  std::set<std::string> ids;
  for (const auto& [_, of_view] : views) {
    if (why_nothing_is_seen(of_view, RankedBy::samples).empty()) continue;
    for (const Json* one : of_view) ids.insert((*one)["id"].get<std::string>());
  }
  return ids;
}

}  // namespace clusterbench::report
