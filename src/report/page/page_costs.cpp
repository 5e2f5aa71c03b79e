#include "report/page/page_costs.h"

#include <optional>

#include "report/cases/case_costs.h"
#include "report/cases/contender.h"
#include "report/cases/json_values.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::Case;
using result::Time;
using result::Timing;

}  // namespace

Json page_costs(const result::Result& result) {
  Json costs = Json::array();
  for (const Case& result_case : result.cases) {
    if (!loses_nothing_seen(result_case)) continue;
    const std::optional<WholeFrame> frame = whole_frame(result_case, result.config);
    const bool is_timed = result_case.timing.has_value();
    if (!frame || (is_timed && makes_lists_on_gpu(result_case))) continue;
    const auto assign_ns = result::number<&Case::timing, &Timing::frame_ns, &Time::median>(result_case);
    if (is_timed && !assign_ns) continue;
    const double gpu_ns = frame->cost.gpu_ns();
    costs.push_back(
        {{"id", result_case.id}, {"ns", six_digits(assign_ns.value_or(0.0) + gpu_ns)}, {"gpu_ns", six_digits(gpu_ns)}});
  }
  return costs;
}

}  // namespace clusterbench::report
