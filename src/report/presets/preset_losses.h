#pragma once
// The losses of a preset's case by cause, and whether its samples are enough to conclude that none is visible.

#include <cstdint>
#include <optional>

#include "report/cases/case_costs.h"
#include "result/case.h"

namespace clusterbench::report {

struct PresetLosses {
  bool is_compared = false;  // its lists were compared with the truth, cell by cell
  std::uint64_t true_pairs = 0;
  std::uint64_t by_method = 0;  // true pairs of the lights it gets that the method does not find
  std::uint64_t by_limit = 0;   // pairs of lights in view that a limit removes
  std::uint64_t dropped = 0;    // pairs that do not fit into the storage
  std::uint64_t limited = 0;    // lights that a limit removes in some frame
  double outside = 0.0;         // samples outside of its cells that a light may reach
  double needed = 0.0;          // lights that reach the samples that rank it
  std::optional<double> unlit;  // missed share of them, in the set with the largest share

  std::uint64_t missed() const { return by_method + by_limit; }
  bool has_few_samples() const { return needed < k_least_needed_to_choose; }
  // With few samples only complete lists (no losses, all of the view) prove that no light is lost.
  bool is_decided() const { return !has_few_samples() || (is_compared && !loses_pairs() && outside == 0.0); }
  bool loses_pairs() const { return missed() > 0 || dropped > 0 || limited > 0; }
};

PresetLosses preset_losses(const result::Case& result_case);

}  // namespace clusterbench::report
