#pragma once
// The parts of a case's record, and their common helpers.

#include <cstdint>
#include <optional>
#include <vector>

#include "result/rounding.h"
#include "run/records/records.h"

namespace clusterbench::run {

result::Occupancy occupancy_record(const CaseResult& found);
result::Buffers buffers_record(const CaseResult& found);
result::ListError error_record(const CaseResult& found);
result::SampleSet samples_record(const measure::ShadingCounts& counts);
result::SampleSets samples_record(const std::vector<SampleSetResult>& sets);
result::DepthRanges depth_ranges_record(const measure::DepthRanges& ranges);
std::vector<result::Lookup> lookup_record(const std::vector<measure::LookupCounts>& ways);
result::Precision precision_record(const PrecisionResult& precision);
result::PreCull pre_cull_record(const PreCullResult& culled, bool is_timed);
result::Fit fit_record(const FitResult& fit);
result::Reaction reaction_record(const ReactionResult& reaction);
result::Fallback fallback_record(const FallbackResult& fallback);
result::Stability stability_record(const StabilityResult& stability);
std::optional<result::Shadows> shadows_record(const CaseResult& found);
std::vector<result::ShadowCullTimes> shadow_times_record(const std::vector<ShadowCullResult>& culls);
result::Timing timing_record(const TimingResult& timing);
result::DeviceTimes device_record(const DeviceTimes& times);
result::Reading reading_record(const ReadingResult& reading);
result::Time time_record(const measure::TimeStats& stats);
std::optional<result::Time> time_record(const std::optional<measure::TimeStats>& stats);
result::Interval interval_record(const measure::Interval& interval);
result::Count count_record(const CountResult& count);
result::Details details_record(const Details& details);

// [x, y, z] of a cell's index in a frame.
result::CellIndex cell_record(std::uint32_t cell, const CaseResult& of, int frame);

inline result::Counts2 counts_record(Vec2i counts) {
  return {static_cast<std::uint64_t>(counts.x), static_cast<std::uint64_t>(counts.y)};
}

template <class Numbers>
result::MeanMax mean_max(const Numbers& numbers) {
  return {result::counted(numbers.mean), result::counted(numbers.max)};
}

}  // namespace clusterbench::run
