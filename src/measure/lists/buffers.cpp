#include "measure/lists/buffers.h"

#include <algorithm>
#include <cmath>

namespace clusterbench::measure {
namespace {

std::uint64_t with_margin(std::uint64_t high_water, double margin, std::uint64_t most) {
  return std::min(most, static_cast<std::uint64_t>(std::ceil(static_cast<double>(high_water) * margin)));
}

}  // namespace

void BufferMeter::add_frame(int frame, const assign::LightStructure& structure, const assign::Lists* lists,
                            std::size_t scratch_bytes) {
  const assign::StructureUse use = structure.use();
  const assign::StructureLimit limit = structure.limit();
  if (frames_ == 0 || use.index_entries > sum_.index_entries.high_water) {
    sum_.worst_frame = frame;
    if (lists != nullptr) sum_.worst_cell = lists->fullest_cell();
  }
  const auto raise = [](std::uint64_t& mark, std::uint64_t value) { mark = std::max(mark, value); };
  raise(sum_.index_entries.high_water, use.index_entries);
  raise(sum_.bytes.high_water, use.index_bytes + use.header_bytes);
  raise(sum_.header_bytes, use.header_bytes);
  raise(sum_.upload_bytes_max, use.upload_bytes);
  raise(sum_.traffic_bytes_max, use.traffic_bytes);
  raise(sum_.scratch_bytes, scratch_bytes);
  raise(sum_.index_entries.theoretical_max, limit.index_entries);
  raise(sum_.bytes.theoretical_max, limit.bytes);
  sum_.bytes_along_path.add_frame(use.index_bytes + use.header_bytes);
  add_to_each(frame, structure.buffers(), lists);
  // Depends on the lights that a cull leaves in each frame.
  sum_.index_bits = std::max(sum_.index_bits, structure.index_bits());
  raise(laid_out_entries_, use.index_bytes * 8 / structure.index_bits());
  sum_.dropped_pairs += use.dropped_pairs;
  sum_.overflowing_cells += use.overflowing_cells;
  sum_.repeated_pairs += use.repeated_pairs;
  if (use.dropped_pairs > 0) ++sum_.overflowing_frames;
  sum_.fallback_cells += use.fallback_cells;
  if (use.fallback_cells > 0) ++sum_.fallback_frames;
  sum_.dropped_lights.insert(use.dropped_lights.begin(), use.dropped_lights.end());
  entries_total_ += use.index_entries;
  upload_total_ += use.upload_bytes;
  traffic_total_ += use.traffic_bytes;
  ++frames_;
}

void BufferMeter::add_to_each(int frame, const std::vector<assign::BufferNeed>& needs, const assign::Lists* lists) {
  sum_.each.resize(needs.size());
  for (std::size_t i = 0; i < needs.size(); ++i) {
    const assign::BufferNeed& need = needs[i];
    BufferHighWater& mark = sum_.each[i];
    if (frames_ == 0 || need.elements > mark.high_water) {
      mark.name = need.name;
      mark.element_bytes = need.element_bytes;
      mark.step = need.step;
      mark.high_water = need.elements;
      mark.worst_frame = frame;
      if (lists != nullptr) mark.worst_cell = lists->fullest_cell();
    }
    mark.theoretical_max = std::max(mark.theoretical_max, need.most);
    mark.along_path.add_frame(need.elements);
  }
}

Buffers BufferMeter::result() const {
  Buffers out = sum_;
  if (frames_ == 0) return out;
  out.index_entries.recommended = std::max(
      laid_out_entries_, with_margin(out.index_entries.high_water, rule_.margin, out.index_entries.theoretical_max));
  const std::uint64_t index_bytes = out.index_entries.recommended * (out.index_bits / 8);
  out.bytes.recommended =
      std::min(out.bytes.theoretical_max, std::max(out.bytes.high_water, out.header_bytes + index_bytes));
  out.upload_bytes_mean = static_cast<double>(upload_total_) / frames_;
  out.traffic_bytes_mean = static_cast<double>(traffic_total_) / frames_;
  if (out.index_entries.recommended > 0) {
    const auto room = static_cast<double>(out.index_entries.recommended);
    out.in_use_mean = static_cast<double>(entries_total_) / frames_ / room;
    out.in_use_max = static_cast<double>(out.index_entries.high_water) / room;
  }
  return out;
}

}  // namespace clusterbench::measure
