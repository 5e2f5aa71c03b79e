#pragma once
// The ratio of the frame times of two cases that were measured side by side. A disturbance of the machine affects both,
// so the ratio is far more stable than the times.

#include <cstdint>
#include <optional>
#include <span>

#include "measure/statistics/time_statistics.h"

namespace clusterbench::measure {

// The frame times of a case.
struct FrameTimes {
  std::span<const double> rounds_ns;  // launch after launch, the same number in each
  int launches = 1;
  bool is_cold = false;
};

// `numerator` / `denominator`, round by round, of cases measured in the same rounds. nullopt if they were not: rounds,
// launches or caches differ.
std::optional<Ratio> ratio_of_rounds(const FrameTimes& numerator, const FrameTimes& denominator, std::uint64_t seed);

// `numerator` / `denominator`, launch by launch, of cases measured by the same launches, each in its own rounds.
// nullopt with fewer than two launches: the variation between launches is unknown.
std::optional<Ratio> ratio_of_launches(const FrameTimes& numerator, const FrameTimes& denominator, std::uint64_t seed);

// True only if the ratio's whole 95 % interval is above 1.
bool takes_longer(const std::optional<Ratio>& ratio);

}  // namespace clusterbench::measure
