#pragma once
// How much longer the frames of one case take than those of another that was measured beside it. What disturbs a
// machine disturbs both, so that their ratio is far steadier than their times.

#include <cstdint>
#include <optional>
#include <span>

#include "measure/statistics/time_statistics.h"

namespace clusterbench::measure {

// What the frames of a case took.
struct FrameTimes {
  std::span<const double> rounds_ns;  // launch after launch, equally many of each
  int launches = 1;
  bool is_cold = false;
};

// `numerator` / `denominator`, round by round, of cases that were measured in the same rounds. nullopt where they were
// not: their rounds, launches or caches differ.
std::optional<Ratio> ratio_of_rounds(const FrameTimes& numerator, const FrameTimes& denominator, std::uint64_t seed);

// `numerator` / `denominator`, launch by launch, of cases that the same launches measured, each in rounds of its own.
// nullopt of fewer than two launches: nothing says how one launch would differ from the next.
std::optional<Ratio> ratio_of_launches(const FrameTimes& numerator, const FrameTimes& denominator, std::uint64_t seed);

// False unless the ratio's 95 % interval says that the first takes longer.
bool takes_longer(const std::optional<Ratio>& ratio);

}  // namespace clusterbench::measure
