// Lists, their storage and their errors.

#include <algorithm>
#include <cmath>

#include "run/records/parts.h"

namespace clusterbench::run {
namespace {

using result::counted;

result::Spread spread_record(const measure::Spread& spread) {
  return {counted(spread.mean), counted(spread.p50), counted(spread.p95), counted(spread.p99), counted(spread.max)};
}

result::HighWater high_water_record(const measure::HighWater& mark) {
  return {mark.high_water, mark.theoretical_max, mark.recommended};
}

// Numbers along the path only if frames differ; otherwise high_water is enough.
result::Buffer buffer_record(const measure::BufferHighWater& mark, const CaseResult& of) {
  result::Buffer out{.name = mark.name,
                     .element_bytes = mark.element_bytes,
                     .step = mark.step,
                     .high_water = mark.high_water,
                     .theoretical_max = mark.theoretical_max,
                     .worst_frame = static_cast<std::uint64_t>(mark.worst_frame)};
  if (mark.worst_cell) out.worst_cell = cell_record(*mark.worst_cell, of, mark.worst_frame);
  const std::vector<std::uint64_t>& along = mark.along_path.entries();
  if (std::ranges::any_of(along, [&](std::uint64_t elements) { return elements != mark.high_water; }))
    out.along_path = {static_cast<std::uint64_t>(mark.along_path.frames_per_entry()), along};
  return out;
}

template <class To, class From>
std::vector<To> converted(const From& from) {
  return {from.begin(), from.end()};
}

}  // namespace

result::CellIndex cell_record(std::uint32_t cell, const CaseResult& of, int frame) {
  const Vec3i cells = cells_in(of, frame);
  const auto nx = static_cast<std::uint32_t>(cells.x), ny = static_cast<std::uint32_t>(cells.y);
  return {{cell % nx, cell / nx % ny, cell / nx / ny}};
}

result::Occupancy occupancy_record(const CaseResult& found) {
  const measure::Occupancy& o = *found.occupancy;
  const measure::Histogram histogram = measure::short_histogram(o.histogram);
  const result::Spread lengths = spread_record(o.lights_per_cell);
  result::Occupancy out;
  out.pairs = spread_record(o.pairs);
  out.lights_per_cell = {
      lengths.mean,
      lengths.p50,
      lengths.p95,
      lengths.p99,
      lengths.max,
      {static_cast<std::uint64_t>(histogram.lights_per_entry), converted<std::uint64_t>(histogram.cells)}};
  out.occupied_fraction = spread_record(o.occupied_fraction);
  out.worst_frame = static_cast<std::uint64_t>(o.worst_frame);
  out.worst_cell = cell_record(o.worst_cell, found, o.worst_frame);
  out.along_path = {static_cast<std::uint64_t>(o.pairs_along_path.frames_per_entry()),
                    converted<std::uint64_t>(o.pairs_along_path.entries()),
                    converted<std::uint64_t>(o.longest_along_path.entries())};
  if (!o.longest_by_slice.empty()) out.longest_by_slice = converted<std::uint64_t>(o.longest_by_slice);
  return out;
}

result::Buffers buffers_record(const CaseResult& found) {
  const measure::Buffers& b = found.buffers;
  result::Buffers out;
  out.index_entries = high_water_record(b.index_entries);
  out.bytes = high_water_record(b.bytes);
  out.index_bits = static_cast<std::uint64_t>(b.index_bits);
  out.header_bytes = b.header_bytes;
  out.upload_bytes = {counted(b.upload_bytes_mean), b.upload_bytes_max};
  out.used_share = {counted(b.in_use_mean), counted(b.in_use_max)};
  out.overflow = {b.dropped_pairs, static_cast<std::uint64_t>(b.overflowing_cells),
                  static_cast<std::uint64_t>(b.overflowing_frames), converted<std::uint64_t>(b.dropped_lights)};
  if (b.repeated_pairs > 0) out.repeated_pairs = b.repeated_pairs;
  out.scratch_bytes = b.scratch_bytes;
  out.worst_frame = static_cast<std::uint64_t>(b.worst_frame);
  if (b.traffic_bytes_max > 0) out.traffic_bytes = {counted(b.traffic_bytes_mean), b.traffic_bytes_max};
  if (b.worst_cell) out.worst_cell = cell_record(*b.worst_cell, found, b.worst_frame);
  out.along_path = {static_cast<std::uint64_t>(b.bytes_along_path.frames_per_entry()),
                    converted<std::uint64_t>(b.bytes_along_path.entries())};
  out.each.emplace();
  for (const measure::BufferHighWater& mark : b.each) out.each->push_back(buffer_record(mark, found));
  return out;
}

result::ListError error_record(const CaseResult& found) {
  const measure::ErrorCounts& e = *found.error;
  result::ListError out;
  out.true_pairs = e.true_pairs;
  out.reported_pairs = e.reported_pairs;
  out.false_positives = e.false_positives;
  out.false_negatives = e.false_negatives;
  out.excess_ratio = counted(e.excess_ratio());
  out.miss_ratio = counted(e.miss_ratio());
  out.deepest_miss = counted(e.deepest_miss);
  out.undecided = e.undecided;
  out.frames_checked = static_cast<std::uint64_t>(e.frames_checked);
  out.decided = {e.filter_decided, e.exact_decided};
  if (e.deepest)
    out.deepest = {static_cast<std::uint64_t>(e.deepest->frame), cell_record(e.deepest->cell, found, e.deepest->frame),
                   e.deepest->light, static_cast<std::uint64_t>(e.deepest->rig_index), found.deepest_miss_light};
  return out;
}

result::Precision precision_record(const PrecisionResult& precision) {
  const measure::PackingLoss& loss = precision.loss;
  result::Precision out;
  out.packing = precision.packing;
  out.inflate = precision.inflate;
  out.label = precision.label;
  out.position_error_m = mean_max(loss.position_error_m);
  out.range_error_m = mean_max(loss.range_error_m);
  out.axis_error_rad = mean_max(loss.axis_error_rad);
  out.angle_error_rad = mean_max(loss.angle_error_rad);
  out.safe_inflation_m = mean_max(loss.safe_inflation_m);
  out.unrepresentable = {static_cast<std::uint64_t>(loss.unrepresentable_lights),
                         static_cast<std::uint64_t>(loss.unrepresentable_frames)};
  return out;
}

// `is_timed`: without it, untimed figures are the same in every run.
result::PreCull pre_cull_record(const PreCullResult& culled, bool is_timed) {
  const PreCullCounts& counts = culled.counts;
  result::PreCull out;
  out.label = culled.label;
  out.conservative = counts.conservative;
  out.kept = mean_max(counts.kept);
  out.removed = mean_max(counts.removed);
  out.distant = mean_max(counts.distant);
  for (const PreCullCounts::Step& step : counts.steps)
    out.steps.push_back({step.label, mean_max(step.removed), static_cast<std::uint64_t>(step.frames)});
  out.lost_pairs = counts.lost_pairs;
  for (const LostAtSamples& set : counts.samples)
    if (set.has_samples) out.lost_at_samples.push_back({measure::name_of(set.set), {set.needed, set.lost}});
  const bool has_limit = std::ranges::any_of(counts.steps, [](const auto& step) { return step.limit.has_value(); });
  if (has_limit) out.over_limit = {converted<std::uint64_t>(counts.dropped), counts.lost_to_limits};
  out.view_cells = static_cast<std::uint64_t>(counts.view_cells);
  out.bytes = counts.bytes;
  if (is_timed) out.build_ns = result::measured(counts.build_ns);
  return out;
}

}  // namespace clusterbench::run
