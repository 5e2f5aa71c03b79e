#include "report/results/kept_cases.h"

#include "report/cases/case_filter.h"
#include "report/choosing/conclusion.h"
#include "report/results/result_record.h"

namespace clusterbench::report {

void keep_cases_and_conclude(result::Result& result, const std::string& filter, const std::string& path) {
  if (filter.empty()) return;
  keep_cases(result, filter, path);
  result.pareto_front = fronts(result.scenes, result.cases, result);
  if (result.preset_rankings) {
    result.presets.reset();
    result.preset_rankings.reset();
    add_presets(result, result);
  }
  if (!result.conclusions) return;
  result.conclusions = conclusions_of(result, result);
  conclude_failures(result, {});
}

}  // namespace clusterbench::report
