#include "report/samples_table.h"

#include <algorithm>

#include "report/columns.h"
#include "report/sample_sets.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

double set_per_sample(const Json& set, const char* key) {
  return set[key].get<double>() / set["samples"].get<double>();
}

// Lights given per sample, and key is unlit or has no answer.
std::string given_text(const Json& set) {
  if (set["samples"] == 0) return "none";
  if (set["unanswered"] == set["samples"]) return "no answer";
  const double unlit = set["unlit"].is_number() ? set["unlit"].get<double>() : 0.0;
  return text("%.2f", set_per_sample(set, "evaluated")) + (unlit > 0.0 ? text(", %.3g %% unlit", 100.0 * unlit) : "");
}

// All of a case by name, points of the whole view first.
std::vector<std::pair<std::string, const Json*>> all_sets_of(const Json& result_case) {
  std::vector<std::pair<std::string, const Json*>> sets;
  if (const Json* volume = samples_of_set(result_case, "volume")) sets.emplace_back("volume", volume);
  for (const auto& [name, set] : result_case["samples"].items()) sets.emplace_back(shown(name), &set);
  return sets;
}

// Nothing where a case does not have the set, as methods that need depth have no points of the whole view.
const Json* set_of(const Json& result_case, const std::string& name) {
  for (const auto& [own, set] : all_sets_of(result_case))
    if (own == name) return set;
  return nullptr;
}

// Of all cases, points of the whole view first.
std::vector<std::string> set_names(const std::vector<NamedCase>& cases) {
  std::vector<std::string> names;
  for (const NamedCase& named : cases)
    for (const auto& [name, set] : all_sets_of(*named.result_case))
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  std::stable_partition(names.begin(), names.end(), [](const std::string& name) { return name == "volume"; });
  return names;
}

// Lights that reach a sample: the same for all cases that have the set.
std::string needed_text(const std::string& name, const std::vector<NamedCase>& cases) {
  for (const NamedCase& named : cases)
    if (const Json* set = set_of(*named.result_case, name); set != nullptr && (*set)["samples"] != 0)
      return text("%.2f", set_per_sample(*set, "needed"));
  return "-";
}

// Methods as lines, sets as columns.
std::string samples_block(const std::string& block, const std::vector<NamedCase>& cases) {
  const std::vector<std::string> names = set_names(cases);
  Cells headings{"", "assigner"}, needed{"", "(needed)"};
  for (const std::string& name : names) {
    headings.push_back(name);
    needed.push_back(needed_text(name, cases));
  }
  std::vector<Cells> rows{headings, needed};
  for (const NamedCase& named : cases) {
    Cells row{"", named.name};
    for (const std::string& name : names) {
      const Json* set = set_of(*named.result_case, name);
      row.push_back(set == nullptr ? "-" : given_text(*set));
    }
    rows.push_back(row);
  }
  const std::vector<std::size_t> widths = widths_of(rows);
  std::string out = " " + block + "\n";
  for (const Cells& row : rows) out += aligned(row, widths);
  return out;
}

}  // namespace

std::string samples_table(const Json& result) {
  std::string out;
  for (const Json& scene : result["scenes"]) {
    std::string blocks;
    for (const std::string& block : blocks_of(result["cases"], scene)) {
      const std::vector<NamedCase> cases = distinct_cases(result["cases"], scene, block, {"samples"});
      if (!cases.empty()) blocks += samples_block(block, cases);
    }
    if (!blocks.empty()) out += "lights per sample of " + shown(scene["name"]) + "\n" + blocks + "\n";
  }
  if (out.empty()) return "";
  return "\n" + out +
         "lights that a sample is given, by set, and those that reach it (needed). volume: random points in the view.\n"
         "unlit: share of the needed ones that are not given. no answer: all samples lie outside of the cells.\n";
}

}  // namespace clusterbench::report
