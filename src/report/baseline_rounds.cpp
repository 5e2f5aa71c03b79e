#include "report/baseline_rounds.h"

#include <algorithm>

#include "measure/time_change.h"
#include "report/result_json.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

double median_of_all(const std::vector<run::PairedLaunch>& launches, std::vector<double> run::PairedLaunch::*side) {
  std::vector<double> all;
  for (const run::PairedLaunch& launch : launches) all.insert(all.end(), (launch.*side).begin(), (launch.*side).end());
  return measure::time_stats(all, 1).median;
}

Json to_json(const run::ListsDiffer& lists) {
  return {{"frames", lists.frames},
          {"frame", lists.frame},
          {"cell", {lists.cell.x, lists.cell.y, lists.cell.z}},
          {"light", lists.light},
          {"in", lists.is_only_in_new ? "new" : "base"},
          {"base_pairs", lists.base_pairs},
          {"new_pairs", lists.next_pairs}};
}

Json to_json(const run::PairedCase& measured) {
  Json launches = Json::array();
  for (const run::PairedLaunch& launch : measured.launches)
    launches.push_back({{"base_ns", launch.base_ns}, {"new_ns", launch.next_ns}});
  const measure::Ratio ratio = measure::ratio_of(measured.change());
  Json out{{"launches", launches},
           {"base_ns", number_or_null(median_of_all(measured.launches, &run::PairedLaunch::base_ns))},
           {"new_ns", number_or_null(median_of_all(measured.launches, &run::PairedLaunch::next_ns))},
           {"ratio", number_or_null(ratio.ratio)},
           {"ci95", {number_or_null(ratio.ci95.low), number_or_null(ratio.ci95.high)}}};
  if (measured.lists_differ) out["lists_differ"] = to_json(*measured.lists_differ);
  return out;
}

}  // namespace

void add_baseline(Json& result, const Json& tool, const std::map<std::string, run::PairedCase>& measured) {
  result["baseline"]["tool"] = tool;
  for (Json& result_case : result["cases"])
    if (const auto found = measured.find(result_case["id"].get<std::string>()); found != measured.end())
      result_case["timing"]["baseline"] = to_json(found->second);
}

}  // namespace clusterbench::report
