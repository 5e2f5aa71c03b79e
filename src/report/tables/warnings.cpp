#include "report/tables/warnings.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/text.h"
#include "report/cases/case_samples.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "report/documents/machine_name.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::Scene;

std::string scene_warnings(const std::vector<Scene>& scenes) {
  std::string out;
  for (const Scene& scene : scenes)
    for (const std::string& warning : scene.warnings)
      out += "warning: " + shown(scene.name) + ": " + shown(warning) + "\n";
  return out;
}

constexpr const char* k_no_promise = "; it fails nothing, since the shader's JSON has no \"conservative\": true";

// One line per message for all its cases: all lists of one grid miss the same lights outside of it. Without lost pairs
// of the program's own methods, which have a column, and unchecked cases, which the configuration requested.
std::string case_warnings(const std::vector<Case>& cases) {
  std::vector<std::pair<std::string, std::vector<std::string>>> messages;  // message, names of its cases
  for (const Case& result_case : cases)
    for (const result::Warning& warning : result_case.warnings) {
      const bool is_of_shader = runs_on_device(result_case) && result_case.assigner.file;  // a user's
      if (warning.kind == "unchecked" || (warning.kind == "lost_pairs" && !is_of_shader)) continue;
      const bool fails_nothing = warning.kind == "lost_pairs" && result_case.failures.empty();
      const std::string message = shown(warning.text) + (fails_nothing ? k_no_promise : "");
      const auto same =
          std::find_if(messages.begin(), messages.end(), [&](const auto& had) { return had.first == message; });
      (same == messages.end() ? messages.emplace_back(message, std::vector<std::string>{}) : *same)
          .second.push_back(shown(result_case.name));
    }
  std::string out;
  for (const auto& [message, names] : messages)
    out += "warning: " + names.front() +
           (names.size() > 1 ? " and " + number_of(names.size() - 1, "more case") : std::string()) + ": " + message +
           "\n";
  return out;
}

// Lists that miss lights are short, and therefore cheap.
std::string cost_warning(const std::vector<Case>& cases) {
  const Case* first = nullptr;
  std::size_t count = 0;
  double most = 0.0;
  std::string where;
  for (const Case& result_case : cases) {
    if (!result_case.cost || result_case.cost->lit) continue;
    if (count++ == 0) first = &result_case;
    for (const auto& [set, paid] : result_case.cost->sets) {
      const result::SampleSet* counts = samples_of_set(result_case, set);
      if (counts == nullptr || !(counts->unlit > most)) continue;
      most = counts->unlit;
      where = set;
    }
  }
  if (first == nullptr) return "";
  return "warning: " + shown(first->name) +
         (count > 1 ? " and " + number_of(count - 1, "more case") + " lack" : std::string(" lacks")) + " up to " +
         text("%.3g %%", 100.0 * most) + " of the lights that " + where +
         " samples need: what they cost is not the cost of the same picture (--set cost.weights." + where +
         "=0 leaves that set out)\n";
}

// The ranges of all lights with a finite range, given or computed.
std::string ranges_text(const result::RangeRule& rule) {
  if (!rule.ranges) return "";
  return "; the scene's ranges: least " + text("%.3g m", rule.ranges->least) +
         text(", median %.3g m", rule.ranges->median) + text(", greatest %.3g m", rule.ranges->greatest);
}

// Of structures that a device was to read.
std::string unread_warnings(const std::vector<Case>& cases) {
  std::map<std::string, std::size_t> reasons;
  for (const Case& result_case : cases)
    if (result_case.unread) ++reasons[*result_case.unread];
  std::string out;
  for (const auto& [reason, count] : reasons)
    out += "warning: not read on a device: " + number_of(count, "case") + ": " + shown(reason) + "\n";
  return out;
}

// Notes on grids, each once with its grids.
std::string grid_notes(const std::vector<Case>& cases) {
  std::map<std::string, std::set<std::string>> cameras_of;  // by scene
  for (const Case& result_case : cases) cameras_of[result_case.scene].insert(result_case.camera);
  std::vector<std::pair<std::string, std::vector<std::string>>> notes;  // note, its grids
  for (const Case& result_case : cases) {
    if (!result_case.grid.note) continue;
    const std::string note = shown(*result_case.grid.note),
                      camera = cameras_of[result_case.scene].size() > 1 ? ", camera " + shown(result_case.camera)
                                                                        : std::string(),
                      grid = shown(result_case.scene) + camera + ", " + shown(result_case.grid.name);
    auto same = std::ranges::find_if(notes, [&](const auto& had) { return had.first == note; });
    if (same == notes.end()) same = notes.insert(notes.end(), {note, {}});
    if (std::ranges::find(same->second, grid) == same->second.end()) same->second.push_back(grid);
  }
  std::string out;
  for (const auto& [note, grids] : notes)
    out += "note: " + grids.front() +
           (grids.size() > 1 ? " and " + number_of(grids.size() - 1, "more grid") : std::string()) + ": " + note + "\n";
  return out;
}

std::string shard_note(const result::Result& result) {
  if (!result.shard) return "";
  return "note: shard " + std::to_string(result.shard->index) + " of " + std::to_string(result.shard->count) +
         " of a run: stars, ranks, budgets and conclusions are those of all, which `clusterbench merge` makes one "
         "result of\n";
}

std::string machines_note(const result::Result& result) {
  if (!result.machines) return "";
  std::vector<std::string> machines;
  for (const result::MeasuredMachine& one : *result.machines)
    machines.push_back(shown(one.name) + ": " + shown(machine_name(one.machine)) + ", " +
                       number_of(one.machine.cores, "core"));
  return "note: times of several machines, each with stars, ranks and conclusions of its own. " +
         joined(machines, "; ") + "\n";
}

}  // namespace

std::string unable_text(const std::vector<result::Skipped>& skipped) {
  std::vector<std::pair<std::string, std::size_t>> reasons;
  for (const result::Skipped& one : skipped) {
    if (one.reason.find(" cannot run here: ") == std::string::npos) continue;
    const auto had = std::ranges::find(reasons, one.reason, &std::pair<std::string, std::size_t>::first);
    ++(had == reasons.end() ? reasons.emplace_back(one.reason, 0) : *had).second;
  }
  std::string out;
  for (const auto& [reason, count] : reasons)
    out += "warning: " + shown(reason) + " (" + number_of(count, "combination") + ")\n";
  return out;
}

std::string notes_text(const result::Result& result) {
  std::string out = shard_note(result) + machines_note(result);
  for (const Scene& scene : result.scenes) {
    const result::RangeRule& rule = scene.range_rule;
    const std::uint64_t made = rule.from_intensity + rule.clamped;
    // If the longest allowed range cuts off most lights, the scene's own warning reports that.
    if (made == 0 || 2 * rule.clamped > made + rule.given) continue;
    out += "note: " + shown(scene.name) + ": " + number_of(made, "light") +
           (made == 1 ? " has no range; it ends where it falls to " : " have no range; they end where they fall to ") +
           text("%g", rule.cutoff_lux) + " lux, at most " + text("%g", rule.max_range) + " m (range_rule)" +
           ranges_text(rule) + "\n";
  }
  return out + grid_notes(result.cases);
}

std::string warnings_text(const result::Result& result) {
  return scene_warnings(result.scenes) + case_warnings(result.cases) + unread_warnings(result.cases) +
         cost_warning(result.cases);
}

}  // namespace clusterbench::report
