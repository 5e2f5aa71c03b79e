#include "report/results/baseline_rounds.h"

#include "measure/statistics/time_change.h"
#include "result/rounding.h"

namespace clusterbench::report {
namespace {

using result::counted;

double median_of_all(const std::vector<run::PairedLaunch>& launches, std::vector<double> run::PairedLaunch::*side) {
  std::vector<double> all;
  for (const run::PairedLaunch& launch : launches) all.insert(all.end(), (launch.*side).begin(), (launch.*side).end());
  return measure::time_stats(all, 1).median;
}

result::ListsDiffer record_of(const run::ListsDiffer& lists) {
  const auto count = [](int number) { return static_cast<std::uint64_t>(number); };
  return {count(lists.frames),
          count(lists.frame),
          {{count(lists.cell.x), count(lists.cell.y), count(lists.cell.z)}},
          lists.light,
          lists.is_only_in_new ? "new" : "base",
          lists.base_pairs,
          lists.next_pairs};
}

result::BaselineTimes record_of(const run::PairedCase& measured) {
  result::BaselineTimes out;
  for (const run::PairedLaunch& launch : measured.launches) out.launches.push_back({launch.base_ns, launch.next_ns});
  out.base_ns = counted(median_of_all(measured.launches, &run::PairedLaunch::base_ns));
  out.new_ns = counted(median_of_all(measured.launches, &run::PairedLaunch::next_ns));
  const measure::Ratio ratio = measure::ratio_of(measured.change());
  out.ratio = counted(ratio.ratio);
  out.ci95 = {{counted(ratio.ci95.low), counted(ratio.ci95.high)}};
  if (measured.lists_differ) out.lists_differ = record_of(*measured.lists_differ);
  return out;
}

}  // namespace

void add_baseline(result::Result& result, const result::Tool& tool,
                  const std::map<std::string, run::PairedCase>& measured) {
  result.baseline.emplace().tool = tool;
  for (result::Case& result_case : result.cases)
    if (const auto found = measured.find(result_case.id); found != measured.end() && result_case.timing)
      result_case.timing->baseline = record_of(found->second);
}

}  // namespace clusterbench::report
