#include "report/tables/lookup_table.h"

#include "report/cases/columns.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::Lookup;

Json ways_of(const result::Case& result_case) {
  if (!result_case.lookup) return nullptr;
  Json ways = Json::array();
  for (const Lookup& way : *result_case.lookup) ways.push_back(result::to_json(way));
  return ways;
}

std::string missed_text(const Lookup& way) {
  return way.needed == 0 ? "-"
                         : text("%.4f %%", 100.0 * static_cast<double>(way.missed) / static_cast<double>(way.needed));
}

// Assigners are lines, ways are columns.
std::string lookup_block(const std::string& block, const std::vector<NamedCase>& cases) {
  Cells headings{"", "assigner"}, padding{"", "(safe padding, ulps)"};
  for (const Lookup& way : *cases.front().result_case->lookup) {
    headings.push_back(way.logarithm + "/" + way.depth);
    padding.push_back(std::to_string(way.safe_padding_ulps));
  }
  std::vector<Cells> rows{headings};
  for (const NamedCase& named : cases) {
    Cells row{"", named.name};
    for (const Lookup& way : *named.result_case->lookup) row.push_back(missed_text(way));
    rows.push_back(row);
  }
  rows.push_back(padding);
  return " " + block + "\n" + aligned_rows(rows);
}

}  // namespace

std::string lookup_table(const result::Result& result) {
  std::string out;
  for (const result::Scene& scene : result.scenes) {
    std::string blocks;
    for (const CaseBlock& block : blocks_of(result.cases, scene)) {
      const std::vector<NamedCase> cases = distinct_cases(block.cases, ways_of);
      if (!cases.empty()) blocks += lookup_block(block.name, cases);
    }
    if (!blocks.empty()) out += "lookup on " + shown(scene.name) + "\n" + blocks + "\n";
  }
  if (out.empty()) return "";
  return "\n" + out +
         "lights missed in % of those that reach the samples, by logarithm and depth of the lookup.\nsafe padding: by "
         "so "
         "many ulps slices must reach over their boundaries.\n";
}

}  // namespace clusterbench::report
