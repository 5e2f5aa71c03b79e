#include "geom/single_precision/touch_tests.h"
#include "geom/single_precision/bounding_volumes.h"
#include "geom/single_precision/plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"

namespace clusterbench::geom {
namespace {

constexpr float k_endless = std::numeric_limits<float>::infinity();

// A double's place beside a number, ± a few float steps, often none.
float nudged(double value, SplitMix64& random) {
  auto near = static_cast<float>(value);
  for (auto steps = random.below(4); steps > 0; --steps)
    near = std::nextafter(near, random.unit() < 0.5 ? -k_endless : k_endless);
  return near;
}

Vec3d any_direction(SplitMix64& random) {
  const double z = random.between(-1, 1), turn = random.between(0, 2 * M_PI), beside = std::sqrt(1 - z * z);
  return {beside * std::cos(turn), beside * std::sin(turn), z};
}

Vec3d perpendicular(const Vec3d& axis) {
  return glm::normalize(glm::cross(axis, std::fabs(axis.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
}

// --- Ball against box ---

TEST(BallTouchesBox, touching_a_face_an_edge_or_a_corner_counts) {
  const Box box{{0, 0, 0}, {2, 4, 6}};
  EXPECT_TRUE(ball_touches_box({{5, 2, 3}, 3}, box));
  EXPECT_FALSE(ball_touches_box({{5, 2, 3}, std::nextafter(3.0f, 0.0f)}, box));
  EXPECT_TRUE(ball_touches_box({{5, 8, 3}, 5}, box));  // 3² + 4² = 5²
  EXPECT_FALSE(ball_touches_box({{5, 8, 3}, std::nextafter(5.0f, 0.0f)}, box));
  EXPECT_TRUE(ball_touches_box({{-1, -2, -2}, 3}, box));  // 1² + 2² + 2² = 3²
  EXPECT_FALSE(ball_touches_box({{-1, -2, -2}, std::nextafter(3.0f, 0.0f)}, box));
}

TEST(BallTouchesBox, the_centre_inside_or_no_end_to_the_ball_touches) {
  EXPECT_TRUE(ball_touches_box({{1, 1, 1}, 1e-30f}, {{0, 0, 0}, {2, 2, 2}}));
  EXPECT_TRUE(ball_touches_box({{1e6f, 0, 0}, k_endless}, {{0, 0, 0}, {2, 2, 2}}));
}

TEST(BallTouchesBox, agrees_with_whole_number_arithmetic_where_single_precision_is_exact) {
  SplitMix64 random(2);
  const auto whole = [&](int reach) {
    return static_cast<int>(random.below(2u * static_cast<unsigned>(reach))) - reach;
  };
  int touching = 0;
  for (int i = 0; i < 100000; ++i) {
    int c[3], lo[3], hi[3];
    std::int64_t squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
      c[axis] = whole(40);
      lo[axis] = whole(30);
      hi[axis] = lo[axis] + 1 + static_cast<int>(random.below(20));
      const std::int64_t gap = std::max({0, lo[axis] - c[axis], c[axis] - hi[axis]});
      squared += gap * gap;
    }
    const auto r = static_cast<std::int64_t>(random.below(60));
    const Ball ball{Vec3f(Vec3i{c[0], c[1], c[2]}), static_cast<float>(r)};
    const Box box{Vec3f(Vec3i{lo[0], lo[1], lo[2]}), Vec3f(Vec3i{hi[0], hi[1], hi[2]})};
    ASSERT_EQ(ball_touches_box(ball, box), squared <= r * r) << i;
    touching += squared == r * r;
  }
  EXPECT_GT(touching, 20);
}

// --- Ball against planes ---

FrustumCell any_piece(SplitMix64& random, bool orthographic) {
  const double size = orthographic ? 30.0 : 1.5;
  FrustumCell cell{};
  cell.orthographic = orthographic;
  cell.x0 = static_cast<float>(random.between(-size, size));
  cell.x1 = cell.x0 + static_cast<float>(random.between(0.01, 0.5) * size);
  cell.y0 = static_cast<float>(random.between(-size, size));
  cell.y1 = cell.y0 + static_cast<float>(random.between(0.01, 0.5) * size);
  cell.depth0 = static_cast<float>(std::pow(10.0, random.between(-1, 2.5)));
  cell.depth1 = cell.depth0 * static_cast<float>(random.between(1.01, 2));
  return cell;
}

// The point of a cell at shares of its widths and depths.
Vec3d place_in(const FrustumCell& cell, double x, double y, double depth) {
  const double at_depth = cell.depth0 + depth * (static_cast<double>(cell.depth1) - cell.depth0);
  const double scale = cell.orthographic ? 1.0 : at_depth;
  return {(cell.x0 + x * (static_cast<double>(cell.x1) - cell.x0)) * scale,
          (cell.y0 + y * (static_cast<double>(cell.y1) - cell.y0)) * scale, -at_depth};
}

TEST(OutwardPlanes, each_holds_its_face_and_has_the_rest_of_the_cell_behind_it) {
  SplitMix64 random(3);
  constexpr double k_faces[6][3] = {{0, .5, .5}, {1, .5, .5}, {.5, 0, .5}, {.5, 1, .5}, {.5, .5, 0}, {.5, .5, 1}};
  for (int i = 0; i < 200; ++i) {
    const FrustumCell cell = any_piece(random, i % 2 == 0);
    Plane planes[6];
    outward_planes(cell, planes);
    for (int face = 0; face < 6; ++face) {
      const auto height = [&](const Vec3d& p) {
        return glm::dot(Vec3d(planes[face].normal), p) - static_cast<double>(planes[face].offset);
      };
      const Vec3d middle = place_in(cell, k_faces[face][0], k_faces[face][1], k_faces[face][2]);
      EXPECT_NEAR(glm::length(Vec3d(planes[face].normal)), 1.0, 2e-7);
      EXPECT_NEAR(height(middle), 0.0, 4e-7 * (glm::length(middle) + 1));
      EXPECT_LT(height(place_in(cell, 0.5, 0.5, 0.5)), 0.0) << "face " << face;
    }
  }
}

TEST(BallTouchesPlanes, excludes_a_ball_beyond_one_face_and_keeps_one_that_touches_it) {
  const FrustumCell cell{-0.5f, 0.5f, -0.5f, 0.5f, 4, 8, false};
  Plane planes[6];
  outward_planes(cell, planes);
  EXPECT_TRUE(ball_touches_planes({{0, 0, -2}, 2}, planes, 6));
  EXPECT_FALSE(ball_touches_planes({{0, 0, -2}, 1.99f}, planes, 6));
  EXPECT_TRUE(ball_touches_planes({{0, 0, -10}, 2}, planes, 6));
  EXPECT_FALSE(ball_touches_planes({{0, 0, -10}, 1.99f}, planes, 6));
  // From (5, 0, -6) to the plane x = depth / 2: (5 - 3) * 2 / sqrt 5.
  EXPECT_TRUE(ball_touches_planes({{5, 0, -6}, 1.7889f}, planes, 6));
  EXPECT_FALSE(ball_touches_planes({{5, 0, -6}, 1.7888f}, planes, 6));
  EXPECT_TRUE(ball_touches_planes({{0, -5, -6}, 1.7889f}, planes, 6));
  EXPECT_FALSE(ball_touches_planes({{0, -5, -6}, 1.7888f}, planes, 6));
}

TEST(BallTouchesPlanes, cannot_exclude_a_ball_beyond_an_edge_which_is_why_it_is_boxy) {
  const FrustumCell cell{-1, 1, -1, 1, 1, 2, true};
  Plane planes[6];
  outward_planes(cell, planes);
  const Ball ball{{1.9f, 1.9f, -1.5f}, 1};
  EXPECT_TRUE(ball_touches_planes(ball, planes, 6));
  EXPECT_FALSE(ball_touches_box(ball, box_around(cell)));
}

// --- Bounds of cells ---

TEST(BoxAround, holds_every_corner_and_each_face_touches_one) {
  SplitMix64 random(4);
  for (int i = 0; i < 500; ++i) {
    const FrustumCell cell = any_piece(random, i % 2 == 0);
    const Box box = box_around(cell);
    Vec3d lo(1e30), hi(-1e30);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3d p = place_in(cell, corner & 1, corner >> 1 & 1, corner >> 2);
      lo = glm::min(lo, p);
      hi = glm::max(hi, p);
    }
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_LE(box.lo[axis], lo[axis]);
      ASSERT_GE(box.hi[axis], hi[axis]);
      ASSERT_NEAR(box.lo[axis], lo[axis], 2e-7 * std::fabs(lo[axis]));
      ASSERT_NEAR(box.hi[axis], hi[axis], 2e-7 * std::fabs(hi[axis]));
    }
  }
}

TEST(BallAround, a_piece_is_held_by_a_ball_no_wider_than_the_one_around_its_box) {
  SplitMix64 random(5);
  for (int i = 0; i < 500; ++i) {
    const FrustumCell cell = any_piece(random, i % 2 == 0);
    const Ball ball = ball_around(cell);
    for (int corner = 0; corner < 8; ++corner)
      ASSERT_LE(glm::length(place_in(cell, corner & 1, corner >> 1 & 1, corner >> 2) - Vec3d(ball.center)),
                static_cast<double>(ball.radius));
    const Box box = box_around(cell);
    ASSERT_LE(ball.radius, 0.5f * glm::length(box.hi - box.lo) * 1.000001f);
  }
}

TEST(BallAround, a_box_is_held_by_the_ball_through_its_corners) {
  const Ball ball = ball_around(Box{{-1, 2, -6}, {3, 6, 1}});
  EXPECT_EQ(ball.center, Vec3f(1, 4, -2.5f));
  EXPECT_NEAR(ball.radius, 4.5f, 1e-6f);  // half of sqrt(4² + 4² + 7²)
  EXPECT_GE(ball.radius, 4.5f);
}

TEST(BallAround, a_shell_piece_is_held_with_its_curved_ends) {
  SplitMix64 random(6);
  for (int i = 0; i < 200; ++i) {
    const FrustumCell like = any_piece(random, false);
    const ShellCell cell{like.x0, like.x1, like.y0, like.y1, like.depth0, like.depth1};
    const Ball ball = ball_around(cell);
    for (int j = 0; j < 100; ++j) {
      const auto end = [&] { return random.unit() < 0.3 ? std::round(random.unit()) : random.unit(); };
      const Vec3d ray{cell.x0 + end() * (static_cast<double>(cell.x1) - cell.x0),
                      cell.y0 + end() * (static_cast<double>(cell.y1) - cell.y0), -1};
      const double distance = cell.distance0 + end() * (static_cast<double>(cell.distance1) - cell.distance0);
      ASSERT_LE(glm::length(distance * glm::normalize(ray) - Vec3d(ball.center)),
                static_cast<double>(ball.radius) + 1e-12 * distance);
    }
  }
}

// --- Cones ---

struct ExactCone {
  Vec3d apex, axis;
  double range, angle;

  SphericalCone rounded() const {
    return {Vec3f(apex), static_cast<float>(range), Vec3f(axis), static_cast<float>(std::cos(angle)),
            static_cast<float>(std::sin(angle))};
  }
  Vec3d point(double distance, double off_axis, double turn) const {
    const Vec3d u = perpendicular(axis), v = glm::cross(axis, u);
    return apex +
           distance * (std::cos(off_axis) * axis + std::sin(off_axis) * (std::cos(turn) * u + std::sin(turn) * v));
  }
};

constexpr double k_degree = M_PI / 180;
constexpr double k_half_angles[] = {0.0,           0.01 * k_degree, 0.5 * k_degree,  20 * k_degree,
                                    45 * k_degree, 60 * k_degree,   89.9 * k_degree, 90 * k_degree};

ExactCone random_cone(SplitMix64& random, double angle) {
  const double size = std::pow(10.0, random.between(-1, 3));
  const Vec3d axis = random.unit() < 0.2 ? Vec3d{0, 0, -1} : any_direction(random);
  return {size * Vec3d{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}, axis,
          std::pow(10.0, random.between(-1, 2)), angle};
}

// Distance from a place to the sphere-capped cone, from its generator, its cap or its rim.
double distance_to(const ExactCone& cone, const Vec3d& p) {
  const Vec3d to = p - cone.apex;
  const double along = glm::dot(to, cone.axis), across = glm::length(to - along * cone.axis);
  if (std::atan2(across, along) <= cone.angle) return std::max(0.0, glm::length(to) - cone.range);
  const double c = std::cos(cone.angle), s = std::sin(cone.angle);
  const double on_generator = std::clamp(along * c + across * s, 0.0, cone.range);
  return std::hypot(along - on_generator * c, across - on_generator * s);
}

TEST(ConeTouchesBall, never_says_no_to_a_ball_that_holds_a_point_of_the_cone) {
  SplitMix64 random(7);
  for (int i = 0; i < 200000; ++i) {
    const ExactCone cone = random_cone(random, k_half_angles[random.below(8)]);
    const double share = random.unit() < 0.4 ? 1.0 : random.unit();
    const double off_axis = cone.angle * (random.unit() < 0.5 ? 1.0 : random.unit());
    const Vec3d touch = cone.point(cone.range * share, off_axis, random.between(0, 2 * M_PI));
    const double r = std::pow(10.0, random.between(-3, 2));
    // Away from the cone as far as the ball allows; then the exact distance says how far it may really be.
    Vec3d away = glm::normalize(touch - cone.apex + 0.3 * cone.range * any_direction(random));
    if (random.unit() < 0.3) away = -cone.axis;
    const Vec3d center = touch + r * away;
    const Ball ball{Vec3f(center), nudged(r, random)};
    if (distance_to(cone, Vec3d(ball.center)) > static_cast<double>(ball.radius)) continue;
    ASSERT_TRUE(cone_touches_ball(cone.rounded(), ball)) << i << ": half-angle " << cone.angle / k_degree;
  }
}

TEST(ConeTouchesBall, excludes_what_is_clearly_beside_beyond_or_behind) {
  SplitMix64 random(8);
  int beside = 0, beyond = 0, behind = 0;
  for (int i = 0; i < 20000; ++i) {
    const ExactCone cone = random_cone(random, k_half_angles[random.below(8)]);
    const double r = random.between(0.01, 1) * cone.range;
    const Vec3d center = cone.apex + 3.0 * cone.range * random.unit() * any_direction(random);
    const Vec3d to = center - cone.apex;
    const double along = glm::dot(to, cone.axis), across = glm::length(to - along * cone.axis);
    const double margin = 1e-5 * (glm::length(cone.apex) + glm::length(to));
    const bool is_beside = std::cos(cone.angle) * across - std::sin(cone.angle) * along > r + margin;
    const bool is_beyond = glm::length(to) > r + cone.range + margin;
    const bool is_behind = along < -r - margin;
    const bool excluded = !cone_touches_ball(cone.rounded(), {Vec3f(center), static_cast<float>(r)});
    if (is_beside || is_beyond || is_behind) {
      ASSERT_TRUE(excluded) << i;
    }
    beside += is_beside && !is_beyond && !is_behind;
    beyond += is_beyond && !is_beside && !is_behind;
    behind += is_behind && !is_beyond && !is_beside;
  }
  EXPECT_GT(beside, 100);
  EXPECT_GT(beyond, 100);
  EXPECT_GT(behind, 100);
}

TEST(ConeTouchesBall, an_unbounded_cone_still_has_sides) {
  const SphericalCone cone{{0, 0, 0}, k_endless, {0, 0, -1}, std::cos(0.5f), std::sin(0.5f)};
  EXPECT_TRUE(cone_touches_ball(cone, {{0, 0, -1e6f}, 1}));
  EXPECT_FALSE(cone_touches_ball(cone, {{0, 0, 10}, 1}));
  EXPECT_FALSE(cone_touches_ball(cone, {{100, 0, -10}, 1}));
  EXPECT_TRUE(cone_touches_ball(cone, {{100, 0, -10}, k_endless}));
}

TEST(BoundingBall, has_the_centre_and_radius_that_trigonometry_gives) {
  const auto ball = [](double degrees) {
    return bounding_ball(ExactCone{{1, 2, 3}, {1, 0, 0}, 10, degrees * k_degree}.rounded());
  };
  EXPECT_NEAR(ball(0).radius, 5.0, 1e-4);
  EXPECT_NEAR(ball(0).center.x, 6.0, 1e-4);
  EXPECT_NEAR(ball(30).radius, 10 / std::sqrt(3.0), 1e-4);  // 10 / (2 cos 30°)
  EXPECT_NEAR(ball(30).center.x, 1 + 10 / std::sqrt(3.0), 1e-4);
  EXPECT_NEAR(ball(45).radius, 10 / std::sqrt(2.0), 1e-4);
  EXPECT_NEAR(ball(60).radius, 10 * std::sqrt(0.75), 1e-4);
  EXPECT_NEAR(ball(60).center.x, 6.0, 1e-4);
  EXPECT_NEAR(ball(90).radius, 10.0, 1e-4);
  EXPECT_NEAR(ball(90).center.x, 1.0, 1e-4);
  EXPECT_EQ(ball(60).center.y, 2.0f);
  EXPECT_EQ(ball(60).center.z, 3.0f);
}

TEST(BoundingBall, holds_apex_rim_and_cap) {
  SplitMix64 random(9);
  for (int i = 0; i < 20000; ++i) {
    const ExactCone cone = random_cone(random, k_half_angles[random.below(8)] + random.between(-1e-7, 1e-7));
    if (cone.angle < 0 || cone.angle > M_PI / 2) continue;
    const Ball ball = bounding_ball(cone.rounded());
    const double turn = random.between(0, 2 * M_PI);
    for (const Vec3d& p : {cone.apex, cone.point(cone.range, cone.angle, turn),
                           cone.point(cone.range, cone.angle * random.unit(), turn), cone.point(cone.range, 0, 0)})
      ASSERT_LE(glm::length(p - Vec3d(ball.center)), static_cast<double>(ball.radius)) << cone.angle / k_degree;
  }
}

TEST(BoundingBall, an_unbounded_cone_has_an_unbounded_ball) {
  const SphericalCone cone{{1, 2, 3}, k_endless, {0, 0, -1}, std::cos(0.5f), std::sin(0.5f)};
  EXPECT_EQ(bounding_ball(cone).radius, k_endless);
  EXPECT_EQ(bounding_ball(cone).center, cone.apex);
}

}  // namespace
}  // namespace clusterbench::geom
