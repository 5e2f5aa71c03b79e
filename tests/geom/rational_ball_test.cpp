#include "geom/ball/rational_ball.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace clusterbench::geom {
namespace {

// Slopes and offsets are chosen so that the distances are whole numbers: 3-4-5 and 2-3-6-7.
constexpr FrustumCell k_piece{-0.75f, 0.75f, -0.5f, 0.5f, 8.0f, 32.0f, false};

Placement at(double x, double y, double depth) {
  return {{x, y, -depth}, Vec3d(0.0), Mat3d(1.0)};
}

double just_below(double value) {
  return std::nextafter(value, 0.0);
}

void expect_touches_first_at(const Placement& center, double distance) {
  EXPECT_TRUE(ball_meets_exactly(center, distance, k_piece));
  EXPECT_FALSE(ball_meets_exactly(center, just_below(distance), k_piece));
}

TEST(ExactBall, a_ball_tangent_to_a_tile_plane_touches) {
  // Foot (12, 0, 16) on x = 0.75 depth, five units out along its normal (4, -3) / 5.
  expect_touches_first_at(at(12.0 + 4.0, 0.0, 16.0 - 3.0), 5.0);
  expect_touches_first_at(at(-12.0 - 4.0, 0.0, 16.0 - 3.0), 5.0);
}

TEST(ExactBall, a_ball_tangent_to_a_slice_plane_touches) {
  expect_touches_first_at(at(1.0, 1.0, 5.0), 3.0);
  expect_touches_first_at(at(1.0, 1.0, 39.0), 7.0);
}

TEST(ExactBall, a_ball_that_reaches_just_an_edge_touches) {
  // The edge x = 6, depth = 8: three to the side and four nearer.
  expect_touches_first_at(at(6.0 + 3.0, 1.0, 8.0 - 4.0), 5.0);
}

TEST(ExactBall, a_ball_that_reaches_just_a_corner_touches) {
  expect_touches_first_at(at(6.0 + 2.0, 4.0 + 3.0, 8.0 - 6.0), 7.0);
}

TEST(ExactBall, a_centre_on_a_plane_or_corner_touches_with_any_radius) {
  EXPECT_TRUE(ball_meets_exactly(at(12.0, 0.0, 16.0), 0.0, k_piece));
  EXPECT_TRUE(ball_meets_exactly(at(6.0, 4.0, 8.0), 0.0, k_piece));
  EXPECT_FALSE(ball_meets_exactly(at(6.0, 4.0, just_below(8.0)), 0.0, k_piece));
}

TEST(ExactBall, a_centre_inside_touches_with_any_radius) {
  EXPECT_TRUE(ball_meets_exactly(at(1.0, 1.0, 20.0), 0.0, k_piece));
  EXPECT_TRUE(ball_meets_exactly(at(-11.0, 7.0, 30.0), 1e-300, k_piece));
}

TEST(ExactBall, the_difference_to_the_origin_is_taken_exactly) {
  // Thirteen metres beside an origin at 2^53: the foot on x = 0.75 depth is 0.8 away.
  const Placement beside{{0x1p53, 0.0, -16.0}, {0x1p53 - 13.0, 0.0, 0.0}, Mat3d(1.0)};
  EXPECT_FALSE(ball_meets_exactly(beside, 0.79, k_piece));
  EXPECT_TRUE(ball_meets_exactly(beside, 0.81, k_piece));
  // 12 + 2^-60, which double precision takes for 12, is beside the plane.
  EXPECT_FALSE(ball_meets_exactly({{12.0, 0.0, -16.0}, {-0x1p-60, 0.0, 0.0}, Mat3d(1.0)}, 0.0, k_piece));
  EXPECT_TRUE(ball_meets_exactly({{12.0, 0.0, -16.0}, {0x1p-60, 0.0, 0.0}, Mat3d(1.0)}, 0.0, k_piece));
}

TEST(ExactBall, a_box_is_the_orthographic_piece_of_the_same_extents) {
  SplitMix64 random(7);
  const Box box{{-2.0f, -1.0f, -9.0f}, {3.0f, 4.0f, -5.0f}};
  const FrustumCell frustum{-2.0f, 3.0f, -1.0f, 4.0f, 5.0f, 9.0f, true};
  int touching = 0;
  for (int i = 0; i < 300; ++i) {
    const Placement center = at(random.between(-6, 8), random.between(-6, 8), random.between(0, 14));
    const double radius = random.between(0.0, 3.0);
    const bool touches = ball_meets_exactly(center, radius, box);
    EXPECT_EQ(touches, ball_meets_exactly(center, radius, frustum));
    touching += touches;
  }
  EXPECT_GT(touching, 30);
  EXPECT_LT(touching, 250);
}

TEST(HoldsExactly, shells_take_the_distance_and_not_the_depth) {
  const ShellCell shell{-1.0f, 1.0f, -1.0f, 1.0f, 5.0f, 7.0f};
  EXPECT_TRUE(holds_exactly(shell, at(3.0, 0.0, 4.0)));
  EXPECT_TRUE(holds_exactly(shell, at(2.0, 3.0, 6.0)));
  EXPECT_FALSE(holds_exactly(shell, at(2.0, 3.0, std::nextafter(6.0, 7.0))));
  EXPECT_FALSE(holds_exactly(shell, at(0.0, 0.0, -6.0)));
}

}  // namespace
}  // namespace clusterbench::geom
