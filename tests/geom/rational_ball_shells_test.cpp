#include "geom/ball/rational_ball.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace clusterbench::geom {
namespace {

Placement placed_at(double x, double y, double depth) {
  return {{x, y, -depth}, Vec3d(0.0), Mat3d(1.0)};
}

double an_ulp_less(double value) {
  return std::nextafter(value, 0.0);
}

// The distance from the centre to the cell is exactly this: an ulp less does not reach, and neither does a centre that
// is moved by an ulp along x, y or z in the direction given by the signs (away from the cell).
void expect_touches_first_at(const ShellCell& cell, const Vec3d& center, double distance, const Vec3d& away) {
  const Placement placed{center * Vec3d(1.0, 1.0, -1.0), Vec3d(0.0), Mat3d(1.0)};
  EXPECT_TRUE(ball_meets_exactly(placed, distance, cell));
  EXPECT_TRUE(ball_meets_exactly(placed, std::nextafter(distance, 1e9), cell));
  EXPECT_FALSE(ball_meets_exactly(placed, an_ulp_less(distance), cell));
  for (int axis = 0; axis < 3; ++axis) {
    if (away[axis] == 0.0) continue;
    for (const double sign : {-1.0, 1.0}) {
      Vec3d moved = center;
      moved[axis] = std::nextafter(moved[axis], sign * away[axis] * 1e9);
      const Placement nudged{moved * Vec3d(1.0, 1.0, -1.0), Vec3d(0.0), Mat3d(1.0)};
      EXPECT_EQ(ball_meets_exactly(nudged, distance, cell), sign < 0.0) << "axis " << axis << " sign " << sign;
    }
  }
}

// Slopes are chosen so that distances are whole numbers: 3-4-5 along x, 1-2-2-3 along the edge x = y / 2 = depth / 2.
ShellCell between(float near, float far) {
  return {-0.75f, 0.75f, -0.5f, 0.5f, near, far};
}
ShellCell corner_between(float near, float far) {
  return {-0.25f, 0.5f, -0.125f, 1.0f, near, far};
}

TEST(ExactShell, a_ball_tangent_to_the_far_shell_from_outside_touches) {
  expect_touches_first_at(between(8, 20), {0, 0, 25}, 5.0, {0, 0, 1});
  expect_touches_first_at({-1, 1, -1, 1, 7, 14}, {6, 9, 18}, 7.0, {1, 1, 1});
}

TEST(ExactShell, a_ball_tangent_to_the_near_shell_from_inside_touches) {
  expect_touches_first_at(between(8, 20), {0, 0, 5}, 3.0, {0, 0, -1});
  expect_touches_first_at({-1, 1, -1, 1, 14, 20}, {2, 3, 6}, 7.0, {-1, -1, -1});
}

TEST(ExactShell, a_ball_around_the_eye_touches_the_near_shell_with_its_radius) {
  expect_touches_first_at(between(8, 20), {0, 0, 0}, 8.0, {0, 0, -1});
  EXPECT_TRUE(ball_meets_exactly(placed_at(0, 0, 0), 0.0, between(0, 20)));
}

TEST(ExactShell, a_ball_tangent_to_a_tile_plane_touches_between_the_shells) {
  // Foot (12, 0, 16) on x = 0.75 depth, 20 from the eye; five units out along the normal (4, 0, -3) / 5.
  for (const ShellCell& cell : {between(8, 32), between(8, 20), between(20, 32)})
    expect_touches_first_at(cell, {16, 0, 13}, 5.0, {1, 0, -1});
  EXPECT_FALSE(ball_meets_exactly(placed_at(16, 0, 13), 5.0, between(8, 19.99f)));
  EXPECT_FALSE(ball_meets_exactly(placed_at(16, 0, 13), 5.0, between(20.01f, 32)));
}

TEST(ExactShell, a_ball_that_reaches_just_the_edge_of_a_tile_plane_and_a_shell_touches) {
  // Foot (24, 0, 32), 40 from the eye: 20 beyond the far shell, the centre 15 to the side.
  expect_touches_first_at(between(8, 20), {36, 0, 23}, 25.0, {1, 0, 1});
  // Foot (12, 0, 16), 20 from the eye: 20 nearer than the near shell.
  expect_touches_first_at(between(40, 50), {24, 0, 7}, 25.0, {0, 0, -1});
}

TEST(ExactShell, a_ball_tangent_to_the_edge_of_two_tile_planes_touches) {
  // Foot (4, 8, 8), 12 from the eye; (2, 1, -2) points away from both planes.
  for (const ShellCell& cell : {corner_between(8, 20), corner_between(8, 12), corner_between(12, 20)})
    expect_touches_first_at(cell, {8, 10, 4}, 6.0, {1, 1, -1});
}

TEST(ExactShell, a_ball_that_reaches_just_a_corner_touches) {
  // Foot (4, 8, 8), 12 from the eye; the corner is 4 nearer or farther, the centre 3 to the side.
  expect_touches_first_at(corner_between(2, 8), {6, 9, 6}, 5.0, {1, 1, 0});
  expect_touches_first_at(corner_between(16, 20), {6, 9, 6}, 5.0, {0, -1, -1});
}

TEST(ExactShell, a_ball_behind_the_eye_reaches_the_corner_that_leans_towards_it_most) {
  // The corner (4, 8, 8) from (0, 0, -11): 4, 8, 19 make 21.
  expect_touches_first_at(corner_between(12, 20), {0, 0, -11}, 21.0, {-1, -1, -1});
  expect_touches_first_at(corner_between(0, 20), {0, 0, -11}, 11.0, {0, 0, -1});
}

TEST(ExactShell, a_pyramid_without_width_is_a_sheet_that_can_be_touched) {
  expect_touches_first_at({0.75f, 0.75f, -0.5f, 0.5f, 8, 32}, {16, 0, 13}, 5.0, {1, 0, -1});
}

// The distance to the nearest of a net of points on the cell, made finer and finer around the nearest one.
double sampled_distance(const ShellCell& cell, const Vec3d& center) {
  constexpr int k_steps = 12, k_rounds = 16;
  const auto clamped = [](double value, double lo, double hi) { return std::min(std::max(value, lo), hi); };
  double nearest = 1e300, x = 0.5 * (cell.x0 + cell.x1), y = 0.5 * (cell.y0 + cell.y1);
  double width = 0.5 * (cell.x1 - cell.x0), height = 0.5 * (cell.y1 - cell.y0);
  for (int round = 0; round < k_rounds; ++round) {
    double best_x = x, best_y = y;
    for (int i = -k_steps; i <= k_steps; ++i)
      for (int j = -k_steps; j <= k_steps; ++j) {
        const double slope_x = clamped(x + width * i / k_steps, cell.x0, cell.x1);
        const double slope_y = clamped(y + height * j / k_steps, cell.y0, cell.y1);
        const Vec3d ray = glm::normalize(Vec3d(slope_x, slope_y, -1.0));
        const Vec3d p = clamped(glm::dot(ray, center), cell.distance0, cell.distance1) * ray;
        if (glm::length(p - center) >= nearest) continue;
        nearest = glm::length(p - center);
        best_x = slope_x;
        best_y = slope_y;
      }
    x = best_x;
    y = best_y;
    width *= 0.25;
    height *= 0.25;
  }
  return nearest;
}

TEST(ExactShell, the_radius_that_first_touches_is_the_distance_of_the_nearest_sample) {
  SplitMix64 random(41);
  for (int i = 0; i < 400; ++i) {
    const auto f = [&](double lo, double hi) { return static_cast<float>(random.between(lo, hi)); };
    ShellCell cell{f(-2, 1), 0, f(-2, 1), 0, f(0, 10), 0};
    cell.x1 = cell.x0 + f(0.01, 2);
    cell.y1 = cell.y0 + f(0.01, 2);
    cell.distance1 = cell.distance0 + f(0.1, 10);
    const Vec3d center{random.between(-20, 20), random.between(-20, 20), random.between(-20, 20)};
    const double sampled = sampled_distance(cell, center);
    const Placement placed{center, Vec3d(0.0), Mat3d(1.0)};
    EXPECT_TRUE(ball_meets_exactly(placed, sampled * (1.0 + 0x1p-40), cell)) << "pair " << i;
    if (sampled > 1e-3) {
      EXPECT_FALSE(ball_meets_exactly(placed, sampled * (1.0 - 1e-6), cell)) << "pair " << i;
    }
  }
}

}  // namespace
}  // namespace clusterbench::geom
