#include "geom/ball/ball_decider.h"
#include "geom/shapes/ball_and_cone.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "geom/ball/rational_ball.h"

namespace clusterbench::geom {
namespace {

// Balls that nearly touch cells, or do, in the ways that levels and broken files have: anywhere, nudged by a few ulp to
// touch, on lattices, and at scales from micrometres to 1e15 m.
class RandomBalls {
 public:
  explicit RandomBalls(std::uint64_t seed) : random_(seed) {}

  struct Ball {
    Placement center;
    double radius = 0.0;
  };

  FrustumCell frustum() {
    start_cell();
    const auto [x0, x1] = slopes();
    const auto [y0, y1] = slopes();
    const auto [near, far] = depths();
    return {x0, x1, y0, y1, near, far, false};
  }
  ShellCell shell() {
    const FrustumCell p = frustum();
    return {p.x0, p.x1, p.y0, p.y1, p.depth0, p.depth1};
  }
  Box box() {
    start_cell();
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      const double lo = on_lattice_ ? whole(8) : random_.between(-1, 1) * scale_;
      box.lo[axis] = static_cast<float>(lo);
      box.hi[axis] = static_cast<float>(lo + (on_lattice_ ? 1.0 + below(4) : scale_ * random_.between(0.01, 1.0)));
    }
    return box;
  }

  // least(center): about how far the cell is from there.
  template <class Least>
  Ball ball(Least&& least) {
    Ball ball;
    for (int axis = 0; axis < 3; ++axis)
      ball.center.position[axis] = on_lattice_ ? whole(12) : random_.between(-1.5, 1.5) * scale_;
    if (below(3) == 0) ball.center.position[static_cast<int>(below(3))] = 0.0;
    if (below(4) == 0) turn(ball.center);
    const double distance = least(local_point(ball.center).at);
    ball.radius = distance;
    const std::uint64_t kind = below(6);
    if (kind == 0) ball.radius *= random_.between(0.9, 1.1);
    if (kind == 1) ball.radius = below(4) == 0 ? 0.0 : std::round(distance);
    if (kind >= 2)
      for (std::uint64_t ulps = below(4); ulps > 0; --ulps)
        ball.radius = std::nextafter(ball.radius, below(2) == 0 ? 0.0 : 1e300);
    return ball;
  }

 private:
  void start_cell() {
    on_lattice_ = below(2) == 0;
    constexpr double k_scales[] = {1e-6, 1.0, 30.0, 5e3, 1e9, 1e15};
    scale_ = on_lattice_ ? 1.0 : k_scales[below(6)];
  }
  std::pair<float, float> slopes() {
    if (on_lattice_) {
      const double low = whole(4) * 0.25;
      return {static_cast<float>(low), static_cast<float>(low + 0.25 * (1.0 + below(3)))};
    }
    const double steep = below(4) == 0 ? 1e4 : 1.0, low = steep * random_.between(-1, 1);
    const double wide = below(4) == 0 ? 1e-6 : 0.3;
    const auto first = static_cast<float>(low);
    return {first, std::max(std::nextafter(first, 2e4f), static_cast<float>(low + wide * random_.between(0.01, 1.0)))};
  }
  std::pair<float, float> depths() {
    if (on_lattice_) {
      const double near = below(8);
      return {static_cast<float>(near), static_cast<float>(near + 1.0 + below(5))};
    }
    const double near = below(5) == 0 ? 0.0 : scale_ * random_.between(0.001, 1.0);
    return {static_cast<float>(near), static_cast<float>(near + scale_ * random_.between(0.001, 1.0))};
  }
  // A quarter turn around an axis, 45 degrees, or any; and an origin far away.
  void turn(Placement& place) {
    const double angle = below(2) == 0 ? std::acos(0.0) / 2.0 : random_.between(0, 6);
    const int axis = static_cast<int>(below(3)), a = (axis + 1) % 3, b = (axis + 2) % 3;
    place.rotation[a][a] = place.rotation[b][b] = std::cos(angle);
    place.rotation[a][b] = std::sin(angle);
    place.rotation[b][a] = -std::sin(angle);
    const double far = below(2) == 0 ? 0.0 : 1024.0 * scale_;
    for (int i = 0; i < 3; ++i) {
      place.position[i] += far;
      place.origin[i] += far;
    }
  }
  std::uint64_t below(std::uint64_t count) {
    return static_cast<std::uint64_t>(random_.between(0.0, static_cast<double>(count)));
  }
  double whole(int most) { return std::floor(random_.between(-most, most + 1)); }

  SplitMix64 random_;
  bool on_lattice_ = false;
  double scale_ = 1.0;
};

double gap(double lo, double at, double hi) {
  return std::max({0.0, lo - at, at - hi});
}

// By search: good to half of the digits at least, which a nudge of a few ulp from here makes up for only where the
// distance is right to the last ones; both kinds are wanted.
double about_least(const FrustumCell& c, const Vec3d& p, double from, double to) {
  const auto at = [&](double depth) {
    return std::hypot(gap(c.x0 * depth, p.x, c.x1 * depth), gap(c.y0 * depth, p.y, c.y1 * depth), depth + p.z);
  };
  for (int i = 0; i < 200; ++i) {
    const double a = from + (to - from) / 3.0, b = to - (to - from) / 3.0;
    (at(a) <= at(b) ? to : from) = at(a) <= at(b) ? b : a;
  }
  return at((from + to) / 2.0);
}

struct Counts {
  int balls = 0, touching = 0;
  std::uint64_t exact = 0;
};

template <class AnyCell>
void compare(const AnyCell& cell, const RandomBalls::Ball& ball, Counts& counts) {
  const BallDecider decider(ball.center, ball.radius);
  const bool expected = ball_meets_exactly(ball.center, ball.radius, cell);
  const bool found = decider.meets(cell);
  ASSERT_EQ(found, expected) << "ball " << counts.balls;
  ++counts.balls;
  counts.touching += expected;
  counts.exact += decider.exact_decisions();
}

void expect_both(const Counts& counts) {
  EXPECT_GT(counts.touching, counts.balls / 5);
  EXPECT_LT(counts.touching, counts.balls * 9 / 10);
  EXPECT_GT(counts.exact, counts.balls / 50) << "too few reach the exact numbers";
  EXPECT_LT(counts.exact, counts.balls * 9 / 10);
}

TEST(BallDecider, agrees_with_rational_numbers_on_frustum_pieces) {
  RandomBalls balls(1);
  Counts counts;
  for (int i = 0; i < 6000 && !testing::Test::HasFatalFailure(); ++i) {
    const FrustumCell cell = balls.frustum();
    compare(cell, balls.ball([&](const Vec3d& p) { return about_least(cell, p, cell.depth0, cell.depth1); }), counts);
  }
  expect_both(counts);
}

TEST(BallDecider, agrees_with_rational_numbers_on_boxes) {
  RandomBalls balls(2);
  Counts counts;
  for (int i = 0; i < 10'000 && !testing::Test::HasFatalFailure(); ++i) {
    const Box cell = balls.box();
    const auto least = [&](const Vec3d& p) {
      return std::hypot(gap(cell.lo.x, p.x, cell.hi.x), gap(cell.lo.y, p.y, cell.hi.y), gap(cell.lo.z, p.z, cell.hi.z));
    };
    compare(cell, balls.ball(least), counts);
  }
  expect_both(counts);
}

TEST(BallDecider, agrees_with_rational_numbers_on_shell_pieces) {
  RandomBalls balls(3);
  Counts counts;
  for (int i = 0; i < 6000 && !testing::Test::HasFatalFailure(); ++i) {
    const ShellCell cell = balls.shell();
    const FrustumCell pyramid{cell.x0, cell.x1, cell.y0, cell.y1, 0.0f, 1.0f, false};
    const auto least = [&](const Vec3d& p) {
      const double size = glm::length(p);
      const double height = std::min(about_least(pyramid, p, 0.0, 2.0 * size), size);
      const double along = std::sqrt((size - height) * (size + height));
      return std::hypot(height, gap(cell.distance0, along, cell.distance1));
    };
    compare(cell, balls.ball(least), counts);
  }
  expect_both(counts);
}

TEST(BallDecider, decides_exact_touches_on_a_lattice_without_exact_numbers) {
  const FrustumCell cell{0.0f, 0.25f, -0.25f, 0.0f, 4.0f, 8.0f, false};
  const Placement left{{-3.0, -0.5, -5.0}, Vec3d(0.0), Mat3d(1.0)}, above{{0.5, 2.0, -6.0}, Vec3d(0.0), Mat3d(1.0)},
      before{{0.0, 0.0, -1.0}, Vec3d(0.0), Mat3d(1.0)}, beside_edge{{-3.0, 4.0, -5.0}, Vec3d(0.0), Mat3d(1.0)};
  const std::pair<Placement, double> touches[] = {{left, 3.0}, {above, 2.0}, {before, 3.0}, {beside_edge, 5.0}};
  for (const auto& [center, radius] : touches) {
    const BallDecider decider(center, radius);
    EXPECT_TRUE(decider.meets(cell));
    EXPECT_EQ(decider.exact_decisions(), 0u);
    EXPECT_FALSE(BallDecider(center, std::nextafter(radius, 0.0)).meets(cell));
  }
}

// A camera that is turned about its x axis: depths are rounded, what lies across is not. The ball touches the plane x =
// 0, straight from its side; an ulp less and it does not.
TEST(BallDecider, decides_touches_of_upright_planes_in_doubles_however_depths_are_rounded) {
  const double cosine = std::cos(0.7), sine = std::sin(0.7);
  Placement center;
  center.rotation = glm::transpose(Mat3d{{1, 0, 0}, {0, cosine, -sine}, {0, sine, cosine}});
  for (const double depth : {4.3, 5.1, 6.7}) {
    center.position = glm::transpose(center.rotation) * Vec3d(0.75, 0.3, -depth);
    for (const Cell& cell : {Cell(FrustumCell{-0.5f, 0.0f, -0.5f, 0.5f, 3.0f, 9.0f, false}),
                             Cell(ShellCell{-0.5f, 0.0f, -0.5f, 0.5f, 3.0f, 9.0f})}) {
      const BallDecider touching(center, 0.75);
      EXPECT_TRUE(touching.meets(cell));
      EXPECT_EQ(touching.exact_decisions(), 0u) << depth;
      EXPECT_FALSE(BallDecider(center, std::nextafter(0.75, 0.0)).meets(cell));
    }
  }
}

// Of a centre on the edge of what lies behind all of a pyramid: whether the eye is the nearest point, or one of the ray
// through (1, 0.5, -1), rounding hides.
TEST(BallDecider, tells_no_nearest_corner_where_rounding_hides_whether_the_centre_is_behind_the_pyramid) {
  const ShellCell cell{0.5f, 1.0f, 0.25f, 0.5f, 1.0f, 3.0f};
  const double cosine = std::cos(0.7), sine = std::sin(0.7);
  Placement center;
  center.rotation = glm::transpose(Mat3d{{1, 0, 0}, {0, cosine, -sine}, {0, sine, cosine}});
  int hidden = 0;
  for (int ulps = -12; ulps <= 12; ++ulps) {
    const Vec3d from_eye(1.3, 0.7, 1.65 + 0x1p-52 * ulps);
    center.position = glm::transpose(center.rotation) * from_eye;
    const BallDecider ball(center, 4.0);
    const PyramidView view = ball.view_of(cell);
    if (!view.is_behind) continue;
    const bool is_known = (-view.along).is_surely_above(0.0);
    hidden += is_known ? 0 : 1;
    EXPECT_EQ(ball.nearest_point(cell).has_value(), is_known) << ulps;
  }
  EXPECT_GT(hidden, 0);
  // Farther behind, it is the ray's corner.
  center.position = glm::transpose(center.rotation) * Vec3d(1.3, 0.7, 1.66);
  const std::optional<NearestPoint> nearest = BallDecider(center, 4.0).nearest_point(cell);
  ASSERT_TRUE(nearest.has_value());
  EXPECT_NEAR(nearest->way.x.value, 1.0 / 1.5 - 1.3, 1e-12);
  EXPECT_NEAR(nearest->way.y.value, 0.5 / 1.5 - 0.7, 1e-12);
  EXPECT_NEAR(nearest->way.z.value, -1.0 / 1.5 - 1.66, 1e-12);
}

// Squares of errors that a double cannot hold are not nothing.
TEST(BallDecider, is_not_fooled_by_what_is_too_small_for_a_double) {
  const Placement beside{{1.0, 0.0, 0.0}, {-0x1p-540, 0.0, 0.0}, Mat3d(1.0)};
  for (const bool orthographic : {false, true})
    EXPECT_FALSE(BallDecider(beside, 1.0).meets(FrustumCell{0.0f, 1.0f, -1.0f, 1.0f, 1.0f, 2.0f, orthographic}));
  Placement turned{{0.0, 0x1p-500, 0.0}, Vec3d(0.0), Mat3d(1.0)};
  turned.rotation[1][0] = 0x1p-600;
  EXPECT_FALSE(BallDecider(turned, 1.0).meets(FrustumCell{-1.0f, 0.0f, -1.0f, 1.0f, 1.0f, 2.0f, false}));
  EXPECT_FALSE(BallDecider(turned, 1.0).meets(Box{{-1.0f, -1.0f, -2.0f}, {0.0f, 1.0f, -1.0f}}));
}

TEST(BallDecider, numbers_too_wide_for_the_stack_are_decided_all_the_same) {
  const Placement center{{0x1p60, 0x1p-1000, -0x1p-1040},
                         {0.0, 0x1.8p-1060, 0x1p59},
                         {0.6, 0.8, 0x1p-1000, -0.8, 0.6, 0x1p-1020, 0x1p-900, 0, 1}};
  const FrustumCell cell{-0.5f, 0.5f, -0.5f, 0.5f, 1.0f, 0x1p58f, false};
  for (const double radius : {0x1p58, 0x1p59, 0x1p60})
    EXPECT_EQ(BallDecider(center, radius).meets(cell), ball_meets_exactly(center, radius, cell));
}

}  // namespace
}  // namespace clusterbench::geom
