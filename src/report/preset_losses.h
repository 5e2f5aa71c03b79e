#pragma once
// What a case of a preset loses, by what causes, and whether its samples are enough to say that none of it is seen.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "measure/shading.h"

namespace clusterbench::report {

// Samples that need fewer lights cannot show that at most k_most_unlit of them are lacking: one of them would be more.
inline constexpr double k_least_needed_of_presets = 1.0 / measure::k_most_unlit;

struct PresetLosses {
  bool is_compared = false;  // its lists with the truth, cell by cell
  std::uint64_t true_pairs = 0;
  std::uint64_t by_method = 0;  // true pairs that the method does not find of the lights that it gets
  std::uint64_t by_limit = 0;   // of lights that a limit removes; those beside the view are no loss and not in here
  std::uint64_t dropped = 0;    // pairs that the storage has no room for
  double needed = 0.0;          // lights that reach the samples by which it is ranked
  std::optional<double> unlit;  // share of them that is lacking, or of another set that costs something and lacks more

  std::uint64_t missed() const { return by_method + by_limit; }
  bool has_few_samples() const { return needed < k_least_needed_of_presets; }
  // With few samples only lists without any loss are known to lose nothing.
  bool is_decided() const { return !has_few_samples() || (is_compared && missed() == 0 && dropped == 0); }
};

PresetLosses preset_losses(const nlohmann::ordered_json& result_case);

// The samples by which a case is ranked: on visible surfaces if they are asked for, else points of the whole view; null
// without any.
const nlohmann::ordered_json* ranking_samples(const nlohmann::ordered_json& result_case);

}  // namespace clusterbench::report
