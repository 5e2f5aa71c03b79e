#include "report/sizing/sized_buffers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assign/contract/assigner.h"
#include "report/sizing/counts.h"
#include "report/sizing/searched_needs.h"

namespace clusterbench::report {
namespace {

std::uint64_t rounded_bytes(std::uint64_t bytes, Rounding rounding) {
  constexpr std::uint64_t k_page = 4096, k_largest_power = std::uint64_t{1} << 63;
  if (bytes == 0 || rounding == Rounding::none) return bytes;
  if (rounding == Rounding::page) return up_to_multiple(bytes, k_page);
  std::uint64_t power = 1;
  while (power < bytes && power < k_largest_power) power *= 2;
  return std::max(power, bytes);
}

void allocate(SizedBuffer& buffer, std::uint64_t step, const AllocationRules& rules) {
  const double wanted = std::ceil(static_cast<double>(buffer.mark()) * rules.margin);
  const std::uint64_t whole = up_to_multiple(std::max(buffer.mark(), as_count(wanted)), step);
  const std::uint64_t most =
      buffer.is_bounded ? std::max(buffer.theoretical_max, buffer.mark()) : std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t capacity = std::min(whole, most);
  buffer.bytes = rounded_bytes(product_of_counts(capacity, buffer.element_bytes), rules.rounding);
  const std::uint64_t fitting = buffer.bytes / buffer.element_bytes / step * step;
  buffer.capacity = std::max(capacity, std::min(fitting, most));
  buffer.warn_above =
      buffer.is_all() ? buffer.capacity : as_count(std::floor(static_cast<double>(buffer.capacity) * rules.warn_at));
}

// Adds another camera's need to that of the earlier ones.
void add(SizedBuffer& buffer, std::uint64_t& step, const CaseBuffer& next) {
  if (buffer.paths.empty() || next.high_water > buffer.high_water) {
    buffer.high_water = next.high_water;
    buffer.worst_camera = next.path.camera;
    buffer.worst_frame = next.worst_frame;
    buffer.worst_cell = next.worst_cell;
    buffer.why_sum = next.why_sum;
    buffer.has_times = next.has_times;
    step = next.step;
  }
  buffer.apart = std::max(buffer.apart, next.apart);
  buffer.theoretical_max = std::max(buffer.theoretical_max, next.theoretical_max);
  buffer.element_bytes = std::max(buffer.element_bytes, next.element_bytes);
  buffer.paths.push_back(next.path);
}

FrameGroup group_of(const FrameCameras& cameras, const CaseBuffer& needs) {
  FrameGroup group;
  for (const std::vector<const result::Case*>& of_camera : cameras) group.cameras.push_back(of_camera.front()->camera);
  group.frames = frames_of_group(cameras);
  group.high_water = needs.high_water;
  group.spread = spread_of({needs.path});
  return group;
}

// The cameras together, viewport by viewport, and then the largest viewport.
std::vector<CaseBuffer> buffers_of_frame(const FrameCameras& cameras) {
  const std::size_t viewports = cameras.front().size();
  std::vector<std::vector<CaseBuffer>> by_buffer;
  for (std::size_t viewport = 0; viewport < viewports; ++viewport) {
    std::vector<std::vector<CaseBuffer>> of_cameras;
    for (const std::vector<const result::Case*>& cases : cameras)
      of_cameras.push_back(buffers_of(*cases[std::min(viewport, cases.size() - 1)]));
    by_buffer.resize(std::max(by_buffer.size(), of_cameras.front().size()));
    for (std::size_t i = 0; i < of_cameras.front().size(); ++i) {
      std::vector<CaseBuffer> same;
      for (const std::vector<CaseBuffer>& all : of_cameras)
        if (i < all.size()) same.push_back(all[i]);
      by_buffer[i].push_back(in_one_frame(same));
    }
  }
  std::vector<CaseBuffer> out;
  for (const std::vector<CaseBuffer>& same : by_buffer) out.push_back(over_viewports(same));
  return out;
}

// False for cells at fixed places in the world: their lists hold the same lights for every view.
bool follows_view(const result::Case& result_case) {
  return result_case.grid.kind != "world" || result_case.grid.follow;
}

// If other frames can have more lights or cells than the counted ones, these give the maximum.
bool has_bound(const result::Case& result_case) {
  return !result_case.pre_cull && !result_case.react && !follows_surfaces(result_case);
}

}  // namespace

bool follows_surfaces(const result::Case& result_case) {
  const assign::AssignerDescriptor* method = assign::find_assigner(result_case.assigner.name);
  return method != nullptr && (method->needs.depth || method->at_surfaces);
}

void size_buffers(SizedStructure& structure, const AllocationRules& rules) {
  std::vector<std::uint64_t> steps;
  for (const FrameCameras& cameras : cameras_by_frame(structure))
    for (const CaseBuffer& next : buffers_of_frame(cameras)) {
      auto known = std::ranges::find(structure.buffers, next.name, &SizedBuffer::name);
      if (known == structure.buffers.end()) {
        known = structure.buffers.insert(known, SizedBuffer{});
        known->name = next.name;
        known->element_bytes = next.element_bytes;
        steps.push_back(1);
      }
      add(*known, steps[static_cast<std::size_t>(known - structure.buffers.begin())], next);
      if (!structure.views.empty()) known->groups.push_back(group_of(cameras, next));
    }
  for (SizedBuffer& buffer : structure.buffers)
    if (!buffer.groups.empty())
      std::erase_if(buffer.paths, [&](const PathNeed& path) { return path.camera != buffer.worst_camera; });
  add_searches(structure);
  for (std::size_t i = 0; i < structure.buffers.size(); ++i) {
    SizedBuffer& buffer = structure.buffers[i];
    buffer.depends_on_view =
        std::ranges::any_of(structure.cases, [](const result::Case* one) { return follows_view(*one); });
    buffer.is_bounded = std::ranges::all_of(structure.cases, [](const result::Case* one) { return has_bound(*one); });
    buffer.spread = spread_of(buffer.paths);
    // A need that is equal in all frames is exact for other frames, too.
    if (buffer.spread && buffer.spread->min == buffer.theoretical_max) buffer.is_bounded = true;
    buffer.growth = growth_of(buffer.paths);
    allocate(buffer, steps[i], rules);
  }
}

}  // namespace clusterbench::report
