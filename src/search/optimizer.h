#pragma once
// Maximises a function over a cube with edges of 0 to 1, within a number of evaluations (NLopt).

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace clusterbench::search {

using Objective = std::function<double(const std::vector<double>& point)>;

// Each calls the objective at most `evaluations` times and returns how often it did; what it finds is the objective's
// to keep. Ends when `stop` becomes true. What the objective throws comes through. The same calls for the same seed.

// CRS2 with local mutation (Kaelo and Ali 2006) from `start` and a random population.
int maximise_globally(std::vector<double> start, int evaluations, std::uint64_t seed, const Objective& objective,
                      const std::atomic<bool>& stop);
// Sbplx (Rowan 1990) from `start`, with steps of that size at first. Less than all evaluations where it converges.
int maximise_locally(std::vector<double> start, double step, int evaluations, const Objective& objective,
                     const std::atomic<bool>& stop);

}  // namespace clusterbench::search
