#include "report/tables/samples_table.h"

#include <algorithm>

#include "measure/samples/samples.h"
#include "report/cases/case_samples.h"
#include "report/cases/columns.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::SampleSet;

Json sets_of(const result::Case& result_case) {
  return result_case.samples ? result::to_json(*result_case.samples) : Json();
}

double per_sample(const SampleSet& set, std::uint64_t lights) {
  return static_cast<double>(lights) / static_cast<double>(set.samples);
}

// Lights returned per sample, with the unlit share; "no answer" if the structure has none.
std::string given_text(const SampleSet& set) {
  if (set.samples == 0) return "none";
  if (set.unanswered == set.samples) return "no answer";
  return text("%.2f", per_sample(set, set.evaluated)) +
         (set.unlit > 0.0 ? text(", %.3g %% unlit", 100.0 * set.unlit) : "");
}

// The sets of any case: methods that need depth have no points of the whole view.
std::vector<std::string> set_names(const std::vector<NamedCase>& cases) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < measure::k_sample_set_count; ++i) {
    const std::string name = measure::name_of(static_cast<measure::SampleSet>(i));
    const auto has = [&](const NamedCase& named) { return samples_of_set(*named.result_case, name) != nullptr; };
    if (std::ranges::any_of(cases, has)) names.push_back(name);
  }
  return names;
}

// Lights that reach a sample: equal for all cases that have the set.
std::string needed_text(const std::string& name, const std::vector<NamedCase>& cases) {
  for (const NamedCase& named : cases)
    if (const SampleSet* set = samples_of_set(*named.result_case, name); set != nullptr && set->samples != 0)
      return text("%.2f", per_sample(*set, set->needed));
  return "-";
}

// Methods are lines, sets are columns.
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
      const SampleSet* set = samples_of_set(*named.result_case, name);
      row.push_back(set == nullptr ? "-" : given_text(*set));
    }
    rows.push_back(row);
  }
  return " " + block + "\n" + aligned_rows(rows);
}

}  // namespace

std::string samples_table(const result::Result& result) {
  std::string out;
  for (const result::Scene& scene : result.scenes) {
    std::string blocks;
    for (const CaseBlock& block : blocks_of(result.cases, scene)) {
      const std::vector<NamedCase> cases = distinct_cases(block.cases, sets_of);
      if (!cases.empty()) blocks += samples_block(block.name, cases);
    }
    if (!blocks.empty()) out += "lights per sample of " + shown(scene.name) + "\n" + blocks + "\n";
  }
  if (out.empty()) return "";
  return "\n" + out +
         "lights that a sample is given, by set, and those that reach it (needed). volume: random points in the view.\n"
         "unlit: share of the needed ones that are not given. no answer: all samples lie outside of the cells.\n";
}

}  // namespace clusterbench::report
