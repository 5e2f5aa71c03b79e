#include "report/preset_losses.h"

#include <algorithm>

#include "report/frame_cost.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// Whether no light reaches a point in view beyond its cells, in any frame; of points beside the view nothing is known.
bool is_unlit_beyond_cells(const Json& result_case) {
  const Json* sets = value_at(result_case, "/cost/sets");
  const bool is_in_view = sets == nullptr || !(sets->contains("mirror") || sets->contains("anywhere"));
  return is_in_view && number_at(result_case, "/lights_beyond_grid/max") == 0.0;
}

std::uint64_t loss_at(const Json& from, const char* pointer) {
  return static_cast<std::uint64_t>(number_at(from, pointer).value_or(0.0));
}

}  // namespace

PresetLosses preset_losses(const Json& result_case) {
  PresetLosses losses;
  losses.is_compared = value_at(result_case, "/error") != nullptr;
  losses.true_pairs = loss_at(result_case, "/error/true_pairs");
  const std::uint64_t missed = loss_at(result_case, "/error/false_negatives");
  losses.by_method = missed - std::min(missed, loss_at(result_case, "/pre_cull/lost_pairs"));
  losses.by_limit = loss_at(result_case, "/pre_cull/over_limit/lost_pairs");
  losses.dropped = loss_at(result_case, "/buffers/overflow/dropped_pairs");
  if (const Json* limited = value_at(result_case, "/pre_cull/over_limit/lights")) losses.limited = limited->size();
  losses.outside = is_unlit_beyond_cells(result_case) ? 0.0 : sum_at_samples(result_case, "unanswered");
  losses.needed = sum_at_samples(result_case, "needed");
  if (losses.needed > 0.0) losses.unlit = unlit_at_samples(result_case);
  return losses;
}

}  // namespace clusterbench::report
