#include "measure/lists/lights_beyond_grid.h"

#include <algorithm>
#include <cmath>

#include "grid/lights_in_view.h"

namespace clusterbench::measure {
namespace {

// Upper bound of along(point) over the points of the light. `along`: depth or distance of a point.
template <class Along>
double end_of(const view::Frame& frame, const scene::WorldLight& light, const Along& along) {
  const grid::WorldBall around = grid::ball_around(light);
  const Vec3d apex = grid::in_view_space(frame, light),
              middle = frame.view_space.rotation * (around.center - frame.view_space.origin);
  return std::min(along(apex) + light.range_m, along(middle) + around.radius_m) + grid::slack_of(apex, light.range_m);
}

// The tiles of the picture cover the view up to the last slice; points before the first slice use the first slice.
bool ends_behind(const view::Frame& frame, const grid::ScreenGrid& screen, const scene::WorldLight& light) {
  const float last = screen.slices.boundaries.back();
  if (screen.by_distance)
    return end_of(frame, light, [](const Vec3d& point) { return glm::length(point); }) > static_cast<double>(last);
  const double end = end_of(frame, light, [](const Vec3d& point) { return -point.z; });
  return end > static_cast<double>(last) && static_cast<float>(frame.projection.far_m) > last;
}

// In view space, against the coarsest level; only the part in front of the eye can be in view.
bool leaves_box(const view::Frame& frame, const grid::CascadesGrid& cascades, const scene::WorldLight& light) {
  const double edge = static_cast<double>(cascades.edge_m(cascades.levels - 1)), across = edge * cascades.cells.x / 2.0,
               up = edge * cascades.cells.y / 2.0, deep = edge * cascades.cells.z;
  const Vec3d center = grid::in_view_space(frame, light);
  const double reach = light.range_m + grid::slack_of(center, light.range_m);
  return frame.projection.near_m < 0.0 || std::fabs(center.x) + reach > across || std::fabs(center.y) + reach > up ||
         -center.z + reach > deep;
}

bool leaves_box(const grid::WorldGrid& world, const scene::WorldLight& light) {
  const grid::WorldBox box = grid::box_around(light);
  const auto is_held = [&](int axis, const std::vector<float>& planes) {
    return box.lo[axis] - world.origin[axis] >= static_cast<double>(planes.front()) &&
           box.hi[axis] - world.origin[axis] <= static_cast<double>(planes.back());
  };
  return !(is_held(0, world.x) && is_held(1, world.y) && is_held(2, world.z));
}

struct ReachesBeyond {
  const view::Frame& frame;
  const scene::WorldLight& light;

  bool operator()(const grid::ScreenGrid& screen) const { return ends_behind(frame, screen, light); }
  bool operator()(const grid::CascadesGrid& cascades) const { return leaves_box(frame, cascades, light); }
  bool operator()(const grid::WorldGrid& world) const { return leaves_box(world, light); }
};

// Of a light in view.
bool reaches_beyond(const view::Frame& frame, const grid::Grid& grid, const scene::WorldLight& light) {
  if (!std::isfinite(light.range_m)) {
    const bool ends_with_view = grid.has_tiles() && !grid.screen().by_distance &&
                                static_cast<float>(frame.projection.far_m) <= grid.screen().slices.boundaries.back();
    return !ends_with_view;
  }
  return std::visit(ReachesBeyond{frame, light}, grid.shape);
}

}  // namespace

bool may_reach_beyond(const view::Frame& frame, const grid::Grid& grid, const scene::WorldLight& light) {
  return grid::is_in_view(frame, light) && reaches_beyond(frame, grid, light);
}

void add_frame(LightsBeyondGrid& counts, const view::Frame& frame, const grid::Grid& grid,
               const std::vector<bool>& in_view) {
  std::uint64_t now = 0;
  for (std::size_t i = 0; i < frame.lights.size(); ++i)
    now += in_view[i] && reaches_beyond(frame, grid, frame.lights[i]) ? 1 : 0;
  counts.most = std::max(counts.most, now);
  counts.frames += now > 0 ? 1 : 0;
}

}  // namespace clusterbench::measure
