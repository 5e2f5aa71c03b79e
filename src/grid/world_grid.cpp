#include "grid/world_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "geom/shapes/domain.h"
#include "grid/lights_in_view.h"

namespace clusterbench::grid {
namespace {

void check_planes(const std::vector<float>& planes) {
  if (!std::isfinite(planes.front()) || !std::isfinite(planes.back()))
    throw Error("", "bounds", "must be finite in single precision");
  for (std::size_t i = 0; i + 1 < planes.size(); ++i)
    if (!(planes[i] < planes[i + 1]))
      throw Error("", "cells", "are too thin: two boundaries coincide in single precision");
}

// Boundaries relative to the box's middle, where single precision is finest; the outermost enclose the box.
std::vector<float> world_planes(double lo, double hi, double origin, int count) {
  constexpr float k_infinity = std::numeric_limits<float>::infinity();
  std::vector<float> planes;
  for (int i = 0; i <= count; ++i) planes.push_back(static_cast<float>(lo - origin + (hi - lo) * i / count));
  planes.front() = std::nextafter(planes.front(), -k_infinity);
  planes.back() = std::nextafter(planes.back(), k_infinity);
  check_planes(planes);
  return planes;
}

// Boundaries relative to the lower one of the eye's cell, which is the middle cell or the one after the middle.
std::vector<float> planes_around_camera(double size_m, int count) {
  std::vector<float> planes;
  const int below = count / 2;
  for (int i = 0; i <= count; ++i) planes.push_back(static_cast<float>((i - below) * size_m));
  check_planes(planes);
  return planes;
}

// One axis of the grid, and the origin of its boundaries.
struct Axis {
  double origin;
  std::vector<float> planes;
};

Axis axis_around_camera(double size_m, double camera_cell, int count) {
  Axis axis{camera_cell * size_m, planes_around_camera(size_m, count)};
  for (const float end : {axis.planes.front(), axis.planes.back()})
    if (!geom::is_in_domain(axis.origin + static_cast<double>(end)))
      throw Error("", "cell_size", "takes the grid beyond 1e15 m from the origin");
  return axis;
}

Axis axis_between(int axis, double lo, double hi, int count, bool is_given) {
  if (is_given && !(lo < hi && geom::is_in_domain(lo) && geom::is_in_domain(hi)))
    throw Error("", "bounds",
                "are from " + metres(lo) + " to " + metres(hi) + " along " + "xyz"[axis] +
                    "; allowed: the first below the second, both within 1e15 m from the origin");
  if (!(lo < hi)) {  // a rig without extent
    lo -= 0.5;
    hi += 0.5;
  }
  const double origin = std::round((lo + hi) / 2.0);
  return {origin, world_planes(lo, hi, origin, count)};
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
  const Vec3d& lo = spec.has_bounds ? spec.bounds_lo_m : inputs.rig_lo_m;
  const Vec3d& hi = spec.has_bounds ? spec.bounds_hi_m : inputs.rig_hi_m;
  WorldGrid grid;
  std::vector<float>* axes[3] = {&grid.x, &grid.y, &grid.z};
  for (int i = 0; i < 3; ++i) {
    if (spec.cells[i] < 1)
      throw Error("", "cells", "are " + cells_name(spec.cells) + "; allowed: at least 1 along each axis");
    Axis axis = spec.follows_camera(i) ? axis_around_camera(spec.cell_size_m[i], inputs.camera_cell[i], spec.cells[i])
                                       : axis_between(i, lo[i], hi[i], spec.cells[i], spec.has_bounds);
    grid.origin[i] = axis.origin;
    *axes[i] = std::move(axis.planes);
  }
  return grid;
}

GridInputs world_inputs(const GridSpec& spec, const FrameReach& from) {
  GridInputs inputs;
  WorldBox box{from.rig_lo_m, from.rig_hi_m};
  if (spec.follow == Follow::lights) box = box_around_lights_in_view(from.frame).value_or(box);
  for (int axis = 0; axis < 3; ++axis) {
    if (spec.follows_camera(axis)) {
      inputs.camera_cell[axis] = std::floor(from.frame.view_space.origin[axis] / spec.cell_size_m[axis]);
    } else if (!spec.has_bounds) {
      inputs.rig_lo_m[axis] = box.lo[axis];
      inputs.rig_hi_m[axis] = box.hi[axis];
    }
  }
  return inputs;
}

}  // namespace clusterbench::grid
