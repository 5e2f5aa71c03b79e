#include "report/presets/preset_losses.h"

#include <algorithm>

#include "report/cases/case_costs.h"
#include "result/at.h"
#include "result/sample_sets.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {
namespace {

using result::SampleSet;

// Whether no light reaches a point in view outside of its cells, in any frame; unknown for points outside of the view.
bool is_unlit_beyond_cells(const result::Case& result_case) {
  const auto is_beside_view = [](const auto& set) { return set.first == "mirror" || set.first == "anywhere"; };
  const bool is_in_view = !result_case.cost || std::ranges::none_of(result_case.cost->sets, is_beside_view);
  return is_in_view && result_case.lights_beyond_grid && result_case.lights_beyond_grid->max == 0;
}

}  // namespace

PresetLosses preset_losses(const result::Case& result_case) {
  PresetLosses losses;
  losses.dropped = result_case.buffers.overflow.dropped_pairs;
  if (const auto& error = result_case.error) {
    losses.is_compared = true;
    losses.true_pairs = error->true_pairs;
    losses.by_method = error->false_negatives;
  }
  // Lists that the method itself keeps are compared without what they have no room for; a storage's before it drops
  // any.
  if (result_case.storage == run::k_own_structure) losses.by_method -= std::min(losses.by_method, losses.dropped);
  if (const auto& pre_cull = result_case.pre_cull) {
    losses.by_method -= std::min(losses.by_method, pre_cull->lost_pairs);
    if (pre_cull->over_limit) {
      losses.by_limit = pre_cull->over_limit->lost_pairs;
      losses.limited = pre_cull->over_limit->lights.size();
    }
  }
  losses.outside =
      is_unlit_beyond_cells(result_case) ? 0.0 : sum_at_samples(result_case, result::number<&SampleSet::unanswered>);
  losses.needed = sum_at_samples(result_case, result::number<&SampleSet::needed>);
  if (losses.needed > 0.0) losses.unlit = unlit_at_samples(result_case);
  return losses;
}

}  // namespace clusterbench::report
