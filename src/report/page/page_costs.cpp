#include "report/page/page_costs.h"

#include <optional>

#include "report/cases/case_costs.h"
#include "report/cases/contender.h"
#include "result/at.h"
#include "result/rounding.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::Time;
using result::Timing;

}  // namespace

std::vector<result::FrameCost> page_costs(const result::Result& result) {
  std::vector<result::FrameCost> costs;
  for (const Case& result_case : result.cases) {
    if (!loses_nothing_seen(result_case) || runs_on_device(result_case)) continue;
    const std::optional<WholeFrame> frame = whole_frame(result_case, result.config);
    const bool is_timed = result_case.timing.has_value();
    if (!frame || (is_timed && makes_lists_on_gpu(result_case))) continue;
    const auto assign_ns = result::number<&Case::timing, &Timing::frame_ns, &Time::median>(result_case);
    if (is_timed && !assign_ns) continue;
    const double gpu_ns = frame->cost.gpu_ns();
    costs.push_back({result_case.id, result::measured(assign_ns.value_or(0.0) + gpu_ns), result::measured(gpu_ns)});
  }
  return costs;
}

}  // namespace clusterbench::report
