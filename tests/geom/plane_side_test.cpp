#include "geom/shapes/plane_side.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "geom/numbers/rational.h"

namespace clusterbench::geom {
namespace {

RationalPoint in_rationals(const Vec3d& p) {
  return {exact(p.x), exact(p.y), exact(p.z)};
}

int side_in_rationals(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& p) {
  return dot(cross(in_rationals(b) - in_rationals(a), in_rationals(c) - in_rationals(a)),
             in_rationals(p) - in_rationals(a))
      .sign();
}

double moved_by_steps(double value, std::int64_t steps) {
  for (; steps > 0; --steps) value = std::nextafter(value, 1e300);
  for (; steps < 0; ++steps) value = std::nextafter(value, -1e300);
  return value;
}

TEST(SideOfPlane, a_point_sees_the_front_turn_counter_clockwise) {
  EXPECT_EQ(side_of_plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 1e-300}), 1);
  EXPECT_EQ(side_of_plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, -1e-300}), -1);
  EXPECT_EQ(side_of_plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 0}), 0);
  EXPECT_EQ(side_of_plane({0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 1}), 0);
}

// Points that double precision puts into the plane, moved by a few of its steps.
TEST(SideOfPlane, is_that_of_rational_numbers_beside_the_plane) {
  SplitMix64 random(5);
  int in_the_plane = 0, misjudged = 0;
  for (int i = 0; i < 4000; ++i) {
    Vec3d corners[3], p;
    const double scale = i % 2 == 0 ? 1.0 : 0.1, far = i % 3 == 0 ? 1e9 : 0.0;
    for (Vec3d& corner : corners)
      for (int axis = 0; axis < 3; ++axis) corner[axis] = far + scale * (static_cast<double>(random.below(17)) - 8.0);
    const double u = random.between(-3.0, 3.0), v = random.between(-3.0, 3.0);
    p = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = moved_by_steps(p[axis], static_cast<std::int64_t>(random.below(5)) - 2);
    const int wanted = side_in_rationals(corners[0], corners[1], corners[2], p);
    EXPECT_EQ(side_of_plane(corners[0], corners[1], corners[2], p), wanted);
    in_the_plane += wanted == 0 ? 1 : 0;
    const Vec3d a = corners[1] - corners[0], b = corners[2] - corners[0], w = p - corners[0];
    const double rounded =
        (a.y * b.z - a.z * b.y) * w.x + (a.z * b.x - a.x * b.z) * w.y + (a.x * b.y - a.y * b.x) * w.z;
    misjudged += (rounded > 0.0 ? 1 : rounded < 0.0 ? -1 : 0) != wanted ? 1 : 0;
  }
  EXPECT_GT(in_the_plane, 20);
  EXPECT_GT(misjudged, 20);  // else rounding would do
}

}  // namespace
}  // namespace clusterbench::geom
