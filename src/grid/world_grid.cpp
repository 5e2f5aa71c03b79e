#include "grid/world_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "geom/shapes/domain.h"

namespace clusterbench::grid {
namespace {

// Boundaries relative to the box's middle, where single precision is finest; the outermost enclose the box.
std::vector<float> world_planes(double lo, double hi, double origin, int count) {
  constexpr float k_infinity = std::numeric_limits<float>::infinity();
  std::vector<float> planes;
  for (int i = 0; i <= count; ++i) planes.push_back(static_cast<float>(lo - origin + (hi - lo) * i / count));
  planes.front() = std::nextafter(planes.front(), -k_infinity);
  planes.back() = std::nextafter(planes.back(), k_infinity);
  if (!std::isfinite(planes.front()) || !std::isfinite(planes.back()))
    throw Error("", "bounds", "must be finite in single precision");
  for (int i = 0; i < count; ++i)
    if (!(planes[static_cast<std::size_t>(i)] < planes[static_cast<std::size_t>(i) + 1]))
      throw Error("", "cells", "are too thin: two boundaries coincide in single precision");
  return planes;
}

}  // namespace

std::int64_t WorldGrid::lookup(const Sample& sample, Log2) const {
  const Vec3i cells = counts();
  Vec3i at{0};
  const std::vector<float>* axes[3] = {&x, &y, &z};
  const Vec3f point_in_grid(sample.from(origin));
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<float>& bounds = *axes[axis];
    const float local = point_in_grid[axis];
    const float scale = static_cast<float>(cells[axis]) / (bounds.back() - bounds.front());
    const float index = std::floor((local - bounds.front()) * scale);
    if (!(local >= bounds.front() && local <= bounds.back())) return -1;
    at[axis] = std::clamp(static_cast<int>(index), 0, cells[axis] - 1);
  }
  return cell_index(at, cells);
}

std::unique_ptr<BroadPhase> WorldGrid::broad_phase() const {
  return std::make_unique<BoxBroadPhase>(
      std::vector{BoxBlock{extents_between(x), extents_between(y), extents_between(z), 0}});
}

WorldGrid make_world_grid(const GridSpec& spec, const GridInputs& inputs) {
  Vec3d lo = spec.has_bounds ? spec.bounds_lo_m : inputs.rig_lo_m;
  Vec3d hi = spec.has_bounds ? spec.bounds_hi_m : inputs.rig_hi_m;
  WorldGrid grid;
  std::vector<float>* axes[3] = {&grid.x, &grid.y, &grid.z};
  for (int axis = 0; axis < 3; ++axis) {
    if (spec.cells[axis] < 1) throw Error("", "cells", "must be at least 1 along each axis");
    if (spec.has_bounds && !(lo[axis] < hi[axis]))
      throw Error("", "bounds", "must have its minimum below its maximum on each axis");
    if (spec.has_bounds && !(geom::is_in_domain(lo[axis]) && geom::is_in_domain(hi[axis])))
      throw Error("", "bounds", "must be within 1e15 m from the origin");
    if (!(lo[axis] < hi[axis])) {  // a rig without extent
      lo[axis] -= 0.5;
      hi[axis] += 0.5;
    }
    grid.origin[axis] = std::round((lo[axis] + hi[axis]) / 2.0);
    *axes[axis] = world_planes(lo[axis], hi[axis], grid.origin[axis], spec.cells[axis]);
  }
  return grid;
}

GridInputs world_inputs(const GridSpec& spec, const FrameReach& from) {
  GridInputs inputs;
  if (!spec.has_bounds) {
    inputs.rig_lo_m = from.rig_lo_m;
    inputs.rig_hi_m = from.rig_hi_m;
  }
  return inputs;
}

std::string world_grid_name(const GridSpec& spec) {
  std::string text = "world " + cells_name(spec.cells);
  if (spec.has_bounds)
    for (int axis = 0; axis < 3; ++axis)
      text += " " + number_name(spec.bounds_lo_m[axis]) + ".." + number_name(spec.bounds_hi_m[axis]);
  return text;
}

}  // namespace clusterbench::grid
