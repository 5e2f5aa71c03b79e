#pragma once
// A run in parts, for several machines: each takes some of the plan's groups, and `clusterbench merge` makes one result
// of them.

#include <cstdint>
#include <span>
#include <vector>

#include "run/cases/plan.h"

namespace clusterbench::run {

// As many as a run may have cases: more would all be empty.
inline constexpr std::uint64_t k_most_shards = k_most_cases;

// Predicted work of each group of the plan, in about nanoseconds of one thread; at least 1. It follows from counts
// alone (frames, cells, lights that reach a point, samples, rounds), never from times, so that all machines of a run
// divide it alike. run/estimate.h has the time that this machine would take.
std::vector<std::uint64_t> predicted_work(const config::Config& config, const Plan& plan);

// The part of it that is counting.
std::vector<double> predicted_counting(const config::Config& config, const Plan& plan);

// The shards that take the work in its order: shard i (from 0) takes the groups from ends[i - 1], or 0, to before
// ends[i]. The largest sum of a shard is the smallest that is possible. Shards at the end are empty if there are more
// than groups.
std::vector<std::size_t> shard_ends(std::span<const std::uint64_t> work, std::uint64_t shards);

// The plan with the groups from `begin` to before `end`; all scenes and all that is skipped stay.
Plan part_of(Plan plan, std::size_t begin, std::size_t end);

}  // namespace clusterbench::run
