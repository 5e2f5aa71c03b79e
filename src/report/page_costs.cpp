#include "report/page_costs.h"

#include <optional>

#include "report/contender.h"
#include "report/frame_cost.h"
#include "report/json_values.h"
#include "report/result_json.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json page_costs(const Json& result) {
  Json costs = Json::array();
  for (const Json& result_case : result["cases"]) {
    if (!loses_nothing_seen(result_case)) continue;
    const std::optional<WholeFrame> frame = whole_frame(result_case, result["config"]);
    const bool is_timed = result_case.contains("timing");
    if (!frame || (is_timed && makes_lists_on_gpu(result_case))) continue;
    const std::optional<double> assign_ns = number_at(result_case, "/timing/frame_ns/median");
    if (is_timed && !assign_ns) continue;
    const double gpu_ns = frame->cost.gpu_ns();
    costs.push_back({{"id", result_case["id"]},
                     {"ns", six_digits(assign_ns.value_or(0.0) + gpu_ns)},
                     {"gpu_ns", six_digits(gpu_ns)}});
  }
  return costs;
}

}  // namespace clusterbench::report
