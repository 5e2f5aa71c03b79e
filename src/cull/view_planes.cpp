#include "cull/view_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clusterbench::cull {
namespace {

struct Sides {
  double left, right, bottom, top;
};

// Of the picture and of the grid's tiles, whose planes are rounded to single precision.
Sides sides_of(const view::Projection& projection, const grid::Grid& grid) {
  Sides sides{projection.left, projection.right, projection.bottom, projection.top};
  if (!grid.has_tiles()) return sides;
  const grid::Tiles& tiles = grid.screen().tiles;
  return {std::min<double>(sides.left, tiles.x.front()), std::max<double>(sides.right, tiles.x.back()),
          std::min<double>(sides.bottom, tiles.y.back()), std::max<double>(sides.top, tiles.y.front())};
}

}  // namespace

ViewPlanes::ViewPlanes(const view::Frame& frame, const grid::Grid& grid, Depths depths) {
  const view::Projection& projection = frame.projection;
  const Sides sides = sides_of(projection, grid);
  double near = projection.near_m, far = projection.far_m;
  if (depths == Depths::cells && grid.has_tiles()) {
    const grid::ScreenGrid& screen = grid.screen();
    // Away from the view axis a shell begins at a depth smaller than its distance.
    near = std::min<double>(near, screen.by_distance ? 0.0f : screen.slices.boundaries.front());
    far = std::max<double>(far, screen.slices.boundaries.back());
  }
  const bool is_flat = projection.orthographic;
  // `across`: outward, to the right or up; the plane contains the eye, or is parallel to the view axis.
  const auto side = [&](const Vec3d& across, double at) {
    if (is_flat) return Plane{across, -at};
    return Plane{(across + Vec3d(0.0, 0.0, at)) / std::sqrt(1.0 + at * at), 0.0};
  };
  planes_ = {side({1.0, 0.0, 0.0}, sides.right), side({-1.0, 0.0, 0.0}, -sides.left),
             side({0.0, 1.0, 0.0}, sides.top),   side({0.0, -1.0, 0.0}, -sides.bottom),
             Plane{{0.0, 0.0, 1.0}, near},       Plane{{0.0, 0.0, -1.0}, -far}};
  const view::Space space = grid::space_of(grid, frame);
  if (space.origin == frame.view_space.origin && space.rotation == frame.view_space.rotation) return;
  const Vec3d from_eye = frame.view_space.rotation * (space.origin - frame.view_space.origin);
  const Mat3d turn = space.rotation * glm::transpose(frame.view_space.rotation);
  for (Plane& plane : planes_) {
    plane.offset += glm::dot(plane.normal, from_eye);
    plane.normal = turn * plane.normal;
  }
}

bool ViewPlanes::are_missed_by(const geom::Ball& ball) const {
  const Vec3d center(ball.center);
  const double reach = static_cast<double>(ball.radius) + k_cull_least_m;
  return std::ranges::any_of(planes_,
                             [&](const Plane& plane) { return glm::dot(plane.normal, center) + plane.offset > reach; });
}

double farthest_of_cells(const grid::Grid& grid) {
  if (!grid.has_tiles()) return std::numeric_limits<double>::infinity();
  const grid::ScreenGrid& screen = grid.screen();
  const double near = screen.slices.boundaries.front(), far = screen.slices.boundaries.back();
  if (screen.by_distance) return far;
  const auto widest = [](const std::vector<float>& planes) {
    return static_cast<double>(std::max(std::fabs(planes.front()), std::fabs(planes.back())));
  };
  const double x = widest(screen.tiles.x), y = widest(screen.tiles.y), beside = x * x + y * y;
  constexpr double k_rounded_up = 1.0 + 1e-12;
  if (!screen.tiles.orthographic) return far * std::sqrt(1.0 + beside) * k_rounded_up;
  const double deep = std::max(std::fabs(near), std::fabs(far));  // slices can begin behind the eye
  return std::sqrt(deep * deep + beside) * k_rounded_up;
}

}  // namespace clusterbench::cull
