#include "report/warnings.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/text.h"
#include "measure/shading.h"
#include "report/columns.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string scene_warnings(const Json& scenes) {
  std::string out;
  for (const Json& scene : scenes)
    for (const Json& warning : scene["warnings"])
      out += "warning: " + shown(scene["name"]) + ": " + shown(warning) + "\n";
  return out;
}

std::string overflow_text(const Json& overflow) {
  const auto number = [&](const char* key, const char* word) {
    return number_of(overflow[key].get<std::uint64_t>(), word);
  };
  return number("dropped_pairs", "pair") + " dropped in " + number("cells", "cell") + " of " +
         number("frames", "frame");
}

// What the samples lack, where that is more than rounding at cell boundaries makes of it.
std::string unlit_warning(const Json& shading) {
  const Json share = shading.value("unlit", Json());
  const double unlit = share.is_number() ? share.get<double>() : 0.0;
  if (unlit <= measure::k_most_unlit) return "";
  const auto count = [&](const char* pointer) { return number_text(shading, pointer, "%.0f"); };
  std::string out = text("%.3g %%", 100.0 * unlit) + " of the lights that samples need are unlit, " +
                    number_text(shading, "/lost_irradiance", "%.3g %%", 100.0) +
                    " of the irradiance: " + count("/missed_in_cells") + " in cells, " + count("/missed_outside") +
                    " outside of the grid";
  if (shading.contains("worst_frame"))
    out += "; most in frame " + count("/worst_frame/frame") + ", " + count("/worst_frame/missed") + " of " +
           count("/worst_frame/needed");
  return out;
}

// One line for all cases that lack the same: lists of one grid lack what lies outside of it, whatever made them.
std::string unlit_warnings(const Json& cases) {
  std::vector<std::pair<std::string, std::vector<std::string>>> told;  // what, and of which cases
  for (const Json& one : cases) {
    const std::string what = one.contains("shading") ? unlit_warning(one["shading"]) : "";
    if (what.empty()) continue;
    const auto same = std::find_if(told.begin(), told.end(), [&](const auto& had) { return had.first == what; });
    (same == told.end() ? told.emplace_back(what, std::vector<std::string>{}) : *same)
        .second.push_back(shown(one["name"]));
  }
  std::string out;
  for (const auto& [what, names] : told)
    out += "warning: " + names.front() +
           (names.size() > 1 ? " and " + number_of(names.size() - 1, "more case") : std::string()) + ": " + what + "\n";
  return out;
}

std::string case_warnings(const Json& cases) {
  std::string out;
  for (const Json& one : cases) {
    const Json& overflow = one["buffers"]["overflow"];
    if (overflow["dropped_pairs"] != 0) out += "warning: " + shown(one["name"]) + ": " + overflow_text(overflow) + "\n";
    for (const char* part : {"error", "stability"})
      if (one.contains(part) && one[part]["undecided"] != 0)
        out += "warning: " + shown(one["name"]) + ": " + part + ": " +
               number_of(one[part]["undecided"].get<std::uint64_t>(), "undecided pair") + " counted as true\n";
  }
  return out + unlit_warnings(cases);
}

}  // namespace

std::string notes_text(const Json& result) {
  std::string out;
  for (const Json& scene : result["scenes"]) {
    const Json& rule = scene["range_rule"];
    const auto made = rule["from_intensity"].get<std::uint64_t>() + rule["clamped"].get<std::uint64_t>();
    if (made == 0) continue;
    out += "note: " + shown(scene["name"]) + ": " + number_of(made, "light") +
           (made == 1 ? " has no range; it ends where it falls to " : " have no range; they end where they fall to ") +
           text("%g", rule["cutoff_lux"].get<double>()) + " lux, at most " +
           text("%g", rule["max_range"].get<double>()) + " m (range_rule)\n";
  }
  return out;
}

std::string warnings_text(const Json& result) {
  return scene_warnings(result["scenes"]) + case_warnings(result["cases"]);
}

}  // namespace clusterbench::report
