#pragma once
// Maximises a function over a cube with edges of 0 to 1, within a number of evaluations (NLopt).

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace clusterbench::search {

using Objective = std::function<double(const std::vector<double>& point)>;

// Each calls the objective at most `evaluations` times and returns the number of calls; the objective must record the
// best point itself. Ends when `stop` becomes true. Exceptions of the objective are passed on. The same seed gives the
// same calls.

// CRS2 with local mutation (Kaelo and Ali 2006) from `start` and a random population.
int maximise_globally(std::vector<double> start, int evaluations, std::uint64_t seed, const Objective& objective,
                      const std::atomic<bool>& stop);
// Sbplx (Rowan 1990) from `start`, with steps of that size at first. Uses fewer evaluations if it converges.
int maximise_locally(std::vector<double> start, double step, int evaluations, const Objective& objective,
                     const std::atomic<bool>& stop);

}  // namespace clusterbench::search
