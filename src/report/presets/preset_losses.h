#pragma once
// What a case of a preset loses, by what causes, and whether its samples are enough to say that none of it is seen.

#include <cstdint>
#include <optional>

#include "report/cases/case_costs.h"
#include "result/case.h"

namespace clusterbench::report {

struct PresetLosses {
  bool is_compared = false;  // its lists with the truth, cell by cell
  std::uint64_t true_pairs = 0;
  std::uint64_t by_method = 0;  // true pairs that the method does not find of the lights that it gets
  std::uint64_t by_limit = 0;   // of lights that a limit removes; those beside the view are no loss and not in here
  std::uint64_t dropped = 0;    // pairs that the storage has no room for
  std::uint64_t limited = 0;    // lights that a limit removes in some frame
  double outside = 0.0;         // samples that lie beyond its cells, where a light may be
  double needed = 0.0;          // lights that reach the samples by which it is ranked
  std::optional<double> unlit;  // share of them that is lacking, of the set of samples that lacks most

  std::uint64_t missed() const { return by_method + by_limit; }
  bool has_few_samples() const { return needed < k_least_needed_to_choose; }
  // With few samples only lists without any loss, of all lights and all that is seen, are known to lose nothing.
  bool is_decided() const { return !has_few_samples() || (is_compared && !loses_pairs() && outside == 0.0); }
  bool loses_pairs() const { return missed() > 0 || dropped > 0 || limited > 0; }
};

PresetLosses preset_losses(const result::Case& result_case);

}  // namespace clusterbench::report
