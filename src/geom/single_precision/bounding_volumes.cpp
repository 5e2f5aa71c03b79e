#include "geom/single_precision/bounding_volumes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geom/numbers/round_to_float.h"

namespace clusterbench::geom {
namespace {

constexpr float k_infinity = std::numeric_limits<float>::infinity();

Plane unit_plane(double nx, double ny, double nz, double offset) {
  const double length = std::sqrt(nx * nx + ny * ny + nz * nz);
  return {{static_cast<float>(nx / length), static_cast<float>(ny / length), static_cast<float>(nz / length)},
          static_cast<float>(offset / length)};
}

// The four corners at one depth, then the four at another.
std::array<Vec3d, 8> corners_of(const FrustumCell& cell) {
  std::array<Vec3d, 8> corners{};
  std::size_t count = 0;
  for (const float depth : {cell.depth0, cell.depth1})
    for (const float x : {cell.x0, cell.x1})
      for (const float y : {cell.y0, cell.y1}) {
        const double scale = cell.orthographic ? 1.0 : static_cast<double>(depth);
        corners[count++] = {x * scale, y * scale, -static_cast<double>(depth)};
      }
  return corners;
}

double farthest(const std::array<Vec3d, 8>& corners, const Vec3d& from, std::size_t first, std::size_t last) {
  double reach = 0.0;
  for (std::size_t i = first; i < last; ++i) reach = std::max(reach, glm::length(corners[i] - from));
  return reach;
}

Ball ball_through_farthest(const std::array<Vec3d, 8>& corners, const Vec3d& near_center) {
  const Vec3f center(near_center);
  return {center, rounded_up(farthest(corners, Vec3d(center), 0, 8) * (1.0 + 1e-12))};
}

// The centre is on the line between the middles of the end faces, where near and far corners are equally far, or in the
// wider end; or it is the middle of the corners' box, if that ball is smaller.
Ball ball_around_frustum(const FrustumCell& cell) {
  const std::array<Vec3d, 8> corners = corners_of(cell);
  const Vec3d near_middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  const Vec3d far_middle = 0.25 * (corners[4] + corners[5] + corners[6] + corners[7]);
  const double near_reach = farthest(corners, near_middle, 0, 4), far_reach = farthest(corners, far_middle, 4, 8);
  const double length = glm::length(far_middle - near_middle);
  const double share = 0.5 + (far_reach - near_reach) * (far_reach + near_reach) / (2.0 * length * length);
  const Vec3d on_line = glm::mix(near_middle, far_middle, std::clamp(share, 0.0, 1.0));
  const Box box = box_around(cell);
  const Ball by_line = ball_through_farthest(corners, on_line);
  const Ball by_box = ball_through_farthest(corners, 0.5 * (Vec3d(box.lo) + Vec3d(box.hi)));
  return by_box.radius < by_line.radius ? by_box : by_line;
}

// A direction in the pyramid has 1 <= distance / depth <= sqrt(1 + x² + y²).
FrustumCell frustum_around(const ShellCell& cell) {
  const double x = std::max(std::fabs(cell.x0), std::fabs(cell.x1));
  const double y = std::max(std::fabs(cell.y0), std::fabs(cell.y1));
  return {cell.x0,        cell.x1, cell.y0, cell.y1, rounded_down(cell.distance0 / std::sqrt(1.0 + x * x + y * y)),
          cell.distance1, false};
}

Ball ball_around_box(const Box& box) {
  const Vec3f center = 0.5f * (box.lo + box.hi);
  const Vec3d reach = glm::max(Vec3d(box.hi) - Vec3d(center), Vec3d(center) - Vec3d(box.lo));
  return {center, rounded_up(glm::length(reach) * (1.0 + 1e-12))};
}

struct BallAround {
  Ball operator()(const FrustumCell& cell) const { return ball_around_frustum(cell); }
  Ball operator()(const ShellCell& cell) const { return ball_around_frustum(frustum_around(cell)); }
  Ball operator()(const Box& cell) const { return ball_around_box(cell); }
};

struct BoxAround {
  Box operator()(const FrustumCell& cell) const { return box_around(cell); }
  Box operator()(const ShellCell& cell) const { return box_around(frustum_around(cell)); }
  Box operator()(const Box& cell) const { return cell; }
};

}  // namespace

void outward_planes(const FrustumCell& cell, Plane (&planes)[6]) {
  const double tilt = cell.orthographic ? 0.0 : 1.0;  // x = slope * depth, or x = metres
  const double shift = cell.orthographic ? 1.0 : 0.0;
  planes[0] = unit_plane(-1.0, 0.0, -cell.x0 * tilt, -cell.x0 * shift);
  planes[1] = unit_plane(1.0, 0.0, cell.x1 * tilt, cell.x1 * shift);
  planes[2] = unit_plane(0.0, -1.0, -cell.y0 * tilt, -cell.y0 * shift);
  planes[3] = unit_plane(0.0, 1.0, cell.y1 * tilt, cell.y1 * shift);
  planes[4] = unit_plane(0.0, 0.0, 1.0, -static_cast<double>(cell.depth0));
  planes[5] = unit_plane(0.0, 0.0, -1.0, static_cast<double>(cell.depth1));
}

Ball bounding_ball(const SphericalCone& cone, float padding) {
  if (std::isinf(cone.range)) return {cone.apex, k_infinity};
  const bool narrow = cone.cos_angle > cone.sin_angle;
  const float along = narrow ? cone.range / (2.0f * cone.cos_angle) : cone.range * cone.cos_angle;
  const float radius = narrow ? along : cone.range * cone.sin_angle;
  // `along` is off by 3 unit roundoffs of the range (a rounded cosine, a product, a quotient), the centre by 3 more and
  // a rounded axis by 1, the radius by 3: 11 of 16.
  constexpr float k_slack = 0x1p-20f;
  return {cone.apex + along * cone.axis, radius + k_slack * (size_of(cone.apex) + cone.range) + padding};
}

Box box_around(const FrustumCell& cell) {
  Vec3d lo(std::numeric_limits<double>::infinity()), hi = -lo;
  for (const Vec3d& corner : corners_of(cell)) {
    lo = glm::min(lo, corner);
    hi = glm::max(hi, corner);
  }
  return {{rounded_down(lo.x), rounded_down(lo.y), rounded_down(lo.z)},
          {rounded_up(hi.x), rounded_up(hi.y), rounded_up(hi.z)}};
}

Box box_around(const Cell& cell) {
  return std::visit(BoxAround{}, cell);
}

Ball ball_around(const Cell& cell) {
  return std::visit(BallAround{}, cell);
}

}  // namespace clusterbench::geom
