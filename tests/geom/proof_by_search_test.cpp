// Spots against cells where they touch, or miss touching by an ulp. The cosine of the half-angle is no rational number,
// so only touches that do not depend on it are exact; others happen between two neighbouring numbers.

#include "geom/spot/proof_by_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "geom/filter/light_filter.h"
#include "geom/light_meets_cell.h"
#include "geom/random_pairs.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {
namespace {

constexpr double k_pi = std::numbers::pi;

SpotVolume spot(const Vec3d& apex, double range, const Vec3d& direction, double half_angle) {
  SpotVolume light;
  light.apex.position = apex;
  light.range = range;
  light.direction = direction;
  light.half_angle_rad = half_angle;
  return light;
}

double moved(double value, int ulps) {
  for (int i = 0; i < std::abs(ulps); ++i) value = std::nextafter(value, ulps < 0 ? -1e300 : 1e300);
  return value;
}

Verdict verdict(const SpotVolume& light, const Cell& cell) {
  const Verdict decided = prove_meets(light, cell), filtered = filter_meets(light, cell);
  EXPECT_TRUE(filtered == Verdict::uncertain || filtered == decided);
  return decided;
}

// The spot touches the cell just so: an ulp less of what moves(-1) changes and they are apart.
void expect_touches_just(const std::function<SpotVolume(int)>& moves, const Cell& cell) {
  EXPECT_EQ(verdict(moves(0), cell), Verdict::yes);
  EXPECT_EQ(verdict(moves(1), cell), Verdict::yes);
  EXPECT_EQ(verdict(moves(-1), cell), Verdict::no);
}

// With the rounded number they are within 8 ulps of touching: apart before, together after, decided everywhere.
void expect_begins_to_touch_near(const std::function<SpotVolume(int)>& moves, const Cell& cell) {
  bool has_met = false;
  for (int ulps = -8; ulps <= 8; ++ulps) {
    const Verdict now = verdict(moves(ulps), cell);
    EXPECT_NE(now, Verdict::uncertain) << ulps;
    EXPECT_FALSE(has_met && now == Verdict::no) << ulps;
    has_met = has_met || now == Verdict::yes;
    if (ulps == -8) {
      EXPECT_EQ(now, Verdict::no);
    }
  }
  EXPECT_TRUE(has_met);
}

TEST(Spot, touches_a_box_with_the_middle_of_its_cap) {
  const Box box{{-1, -1, -9}, {1, 1, -5}};
  for (const double angle : {0.0, 1e-6, 0.5, k_pi / 2.0})
    expect_touches_just([&](int ulps) { return spot({0.25, 0.5, 0}, moved(5.0, ulps), {0, 0, -3}, angle); }, box);
  // Beside the axis, but within the angle.
  expect_touches_just([&](int ulps) { return spot({0.25, 0.5, 0}, moved(5.0, ulps), {0.3, 0.1, -1}, 0.5); }, box);
}

TEST(Spot, touches_a_corner_at_the_end_of_its_axis) {
  const Box box{{2, 3, -9}, {4, 5, -6}};
  for (const double angle : {0.0, 1e-6, 0.5})
    expect_touches_just([&](int ulps) { return spot({0, 0, 0}, moved(7.0, ulps), {2, 3, -6}, angle); }, box);
  const FrustumCell frustum{0.25f, 0.5f, 1.0f, 2.0f, 8.0f, 32.0f, false};  // corner (4, 8, -8)
  expect_touches_just([&](int ulps) { return spot({5, 6, -6}, moved(3.0, ulps), {-1, 2, -2}, 0.1); }, frustum);
}

TEST(Spot, touches_a_face_with_its_rim) {
  for (const double angle : {0.01, k_pi / 6.0, k_pi / 4.0, 1.2}) {
    const Box above{{-10, 1, -200}, {10, 2, 10}};
    // The rim's highest point is at range * sin(angle).
    expect_begins_to_touch_near(
        [&](int ulps) {
          return spot({0, 0, 0}, moved(1.0 / std::sin(angle), ulps), {0, 0, -1}, angle);
        },
        above);
  }
  const FrustumCell right{0.75f, 1.0f, -9.0f, 9.0f, 1.0f, 40.0f, false};
  // 4 away from the plane x = 0.75 depth, along the axis (0, 1, 0), which is parallel to it.
  expect_begins_to_touch_near(
      [&](int ulps) {
        return spot({7, 0, -16}, moved(4.0 / std::sin(k_pi / 3.0), ulps), {0, 1, 0}, k_pi / 3.0);
      },
      right);
}

TEST(Spot, touches_a_face_with_a_generator) {
  // The axis leans from the face by the half-angle: the generator on that side runs along it.
  const Box above{{1, 0, -1}, {2, 1, 1}};
  for (const double angle : {0.2, k_pi / 4.0, 1.1})
    expect_begins_to_touch_near(
        [&](int ulps) {
          return spot({0, 0, 0}, 3.0, {std::cos(angle), -std::sin(angle), 0}, moved(angle, ulps));
        },
        above);
}

TEST(Spot, touches_an_edge_with_a_generator) {
  const Box box{{1, 1, -1}, {2, 2, 1}};  // edge x = 2, y = 1
  expect_begins_to_touch_near(
      [&](int ulps) {
        return spot({0, 0, 0}, 4.0, {1, 0, 0}, moved(std::atan(0.5), ulps));
      },
      box);
  // Where the range ends at the edge as well, both have to be enough.
  const double range = moved(std::sqrt(5.0), 1), angle = std::atan(0.5) + 1e-3;
  EXPECT_EQ(verdict(spot({0, 0, 0}, range, {1, 0, 0}, angle), box), Verdict::yes);
}

TEST(Spot, whose_range_ends_before_the_edge_that_its_cone_would_touch_does_not_touch) {
  const Box box{{1, 1, -1}, {2, 2, 1}};
  const double angle = std::atan(0.5);
  for (const double more : {1e-12, 1e-6, 1e-3})
    EXPECT_EQ(verdict(spot({0, 0, 0}, 2.0, {1, 0, 0}, angle + more), box), Verdict::no);
}

TEST(Spot, with_its_apex_on_a_corner_touches_wherever_it_points) {
  const Box box{{2, 3, -9}, {4, 5, -6}};
  for (const Vec3d& direction : {Vec3d(-1, -1, 1), Vec3d(1, 1, -1), Vec3d(-1, 0, 0)})
    EXPECT_EQ(verdict(spot({2, 3, -6}, 1.0, direction, 0.3), box), Verdict::yes);
  const Vec3d beside(std::nextafter(2.0, 0.0), 3, -6);
  EXPECT_EQ(verdict(spot(beside, 1.0, {-1, -1, 1}, 0.3), box), Verdict::no);
  EXPECT_EQ(verdict(spot(beside, 1.0, {1, 1, -1}, 0.3), box), Verdict::yes);
}

TEST(Spot, touches_shells_with_the_middle_of_its_cap) {
  const ShellCell shell{-0.75f, 0.75f, -0.75f, 0.75f, 14.0f, 28.0f};
  for (const double angle : {1e-6, 0.5, k_pi / 2.0}) {
    // Along (2, 3, -6) / 7: from outside the far shell, from inside the near one.
    expect_touches_just([&](int ulps) { return spot({12, 18, -36}, moved(14.0, ulps), {-2, -3, 6}, angle); }, shell);
    expect_touches_just([&](int ulps) { return spot({1, 1.5, -3}, moved(10.5, ulps), {2, 3, -6}, angle); }, shell);
  }
}

TEST(Spot, at_the_eye_touches_the_shell_at_its_range) {
  const ShellCell shell{0.5f, 1.0f, 0.25f, 0.75f, 4.0f, 9.0f};
  expect_touches_just([&](int ulps) { return spot({0, 0, 0}, moved(4.0, ulps), {3, 2, -4}, 0.2); }, shell);
  EXPECT_EQ(verdict(spot({0, 0, 0}, 5.0, {-1, 0, -1}, 0.2), shell), Verdict::no);
}

TEST(Spot, touches_a_corner_on_a_shell_whose_place_is_not_rational) {
  // The corner's direction (-0.75, 0.5, -1) is perpendicular to the way to the apex: 5² + 96 = 11².
  const ShellCell shell{-0.75f, -0.25f, 0.5f, 0.75f, 5.0f, 8.0f};
  expect_touches_just([&](int ulps) { return spot({-8, -4, 4}, moved(11.0, ulps), {2, 1, 1}, k_pi / 2.0); }, shell);
}

TEST(Spot, whose_apex_lies_in_a_tile_plane_reaches_along_the_plane) {
  const auto shell_to = [](float far) { return ShellCell{-0.5f, 0.5f, 0.0f, 1.0f, 6.0f, far}; };
  const SpotVolume light = spot({8, 8, -8}, 12.0, {-2, 2, 0}, 0.7);
  // The generator in the plane y = depth comes as near to the eye as 12.2375.
  EXPECT_EQ(verdict(light, shell_to(12.23f)), Verdict::no);
  EXPECT_EQ(verdict(light, shell_to(12.24f)), Verdict::yes);
  EXPECT_EQ(verdict(light, shell_to(12.5f)), Verdict::yes);
}

TEST(Spot, of_nearly_no_angle_is_decided) {
  const Box box{{1, -1, -9}, {3, 1, -5}};
  const FrustumCell frustum{0.0f, 0.25f, -0.5f, 0.5f, 8.0f, 32.0f, false};
  const ShellCell shell{0.0f, 0.25f, -0.5f, 0.5f, 8.0f, 32.0f};
  for (const double angle : {0.0, 5e-324, 1e-200, 1e-60, 1e-30, 1e-18}) {
    EXPECT_EQ(verdict(spot({2, 0, 0}, 5.0, {0, 0, -1}, angle), box), Verdict::yes) << angle;
    EXPECT_EQ(verdict(spot({2, 0, 0}, 4.0, {0, 0, -1}, angle), box), Verdict::no) << angle;
    EXPECT_EQ(verdict(spot({1, 0, 0}, 6.0, {0, 0, -1}, angle), box), Verdict::yes) << angle;  // along a face
    EXPECT_EQ(verdict(spot({moved(1, -1), 0, 0}, 6.0, {0, 0, -1}, angle), box), Verdict::no) << angle;
    for (const Cell& cell : {Cell(frustum), Cell(shell)}) {
      EXPECT_EQ(verdict(spot({1, 0.25, 0}, 20.0, {0, 0, -1}, angle), cell), Verdict::yes) << angle;
      EXPECT_EQ(verdict(spot({0, 0.25, 0}, 20.0, {0, 0, -1}, angle), cell), Verdict::yes) << angle;  // in a tile plane
      EXPECT_EQ(verdict(spot({-0.125, 0.25, 0}, 20.0, {0, 0, -1}, angle), cell), Verdict::no) << angle;
      EXPECT_EQ(verdict(spot({1, 0.25, 0}, 6.0, {0, 0, -1}, angle), cell), Verdict::no) << angle;
    }
  }
}

// Without the filter, which settles such pairs before.
Verdict proven(const SpotVolume& light, const Cell& cell) {
  return std::visit([&](const auto& shape) { return decide_spot(light, shape); }, cell);
}

// The generator on the eye's side comes as near to the eye as 5 sin(45°) sqrt 2 = 5 but for rounding: that of the
// half-angle leaves 1.5e-16 m.
TEST(Spot, whose_side_touches_the_far_shell_is_decided_an_ulp_either_way) {
  const auto shell_to = [](float far) { return ShellCell{0.25f, 0.75f, 0.0f, 0.75f, 3, far}; };
  const auto light = [](int ulps) { return spot({5, 5, 0}, 8, {0, 0, -1}, moved(0.78539816339744828, ulps)); };
  EXPECT_EQ(verdict(light(0), shell_to(5)), Verdict::no);
  EXPECT_EQ(verdict(light(1), shell_to(5)), Verdict::yes);
  EXPECT_EQ(verdict(light(0), shell_to(std::nextafter(5.0f, 6.0f))), Verdict::yes);
  EXPECT_EQ(verdict(light(1), shell_to(std::nextafter(5.0f, 4.0f))), Verdict::no);
}

// All of these were uncertain where 256 bits were the last to be tried.
TEST(Spot, that_differs_from_touching_a_shell_by_next_to_nothing_is_decided) {
  // Beyond the far shell by 1e-110 m, and every direction of the cone leads farther away from the eye.
  const ShellCell shell{-1, 0, -1, 0, 3, 4};
  EXPECT_EQ(proven(spot({-4.70687e-184, -3.26265e-55, -4}, std::sqrt(3.0), {0, 1, -1}, 0.3), shell), Verdict::no);
  // From the eye itself. Of v = d (x, y, -1) - apex, where 0.5 <= y: v·axis / |v| <= (d (1 - y) + 1e-50) / (d + 1e-50)
  // / sqrt 2 <= cos 45°, and the half-angle is 3e-17 less than that.
  const ShellCell whole{0.5f, 1.5f, 0.5f, 1.0f, 0, 4};
  EXPECT_EQ(proven(spot({0, 0, 1e-50}, 5, {0, -1, -1}, 0.78539816339744828), whole), Verdict::no);
  // An ulp wider, 1.4e-16 more than 45°: the eye itself is in it.
  EXPECT_EQ(proven(spot({0, 0, 1e-50}, 5, {0, -1, -1}, moved(0.78539816339744828, 1)), whole), Verdict::yes);
}

// Needles along the tile plane x = 0, whose axes lean from it by less than their half-angles, or by as much, or more:
// they reach beyond it by 5e-19 of their width, by the square of the angle, or not at all.
TEST(Spot, of_the_narrowest_cone_along_a_tile_plane_is_decided_in_the_cells_behind_it) {
  const ShellCell shell{0.0f, 0.5f, -0.25f, 0.25f, 3, 8};
  const FrustumCell frustum{0.0f, 0.5f, -0.25f, 0.25f, 3, 8, false};
  const Box box{{0, -1, -8}, {2, 1, -3}};
  for (const double angle : {1e-24, 1e-30, 1e-60, 1e-100, 1e-150, 1e-200, 1e-233, 1e-250, 1e-300})
    for (const Cell& cell : {Cell(shell), Cell(frustum), Cell(box)}) {
      EXPECT_EQ(proven(spot({0, 0, -1}, 40, {-angle, -1e-9, -1}, angle), cell), Verdict::yes) << angle;
      EXPECT_EQ(proven(spot({0, 0, -1}, 40, {-moved(angle, 1), 0, -1}, angle), cell), Verdict::no) << angle;
      // sin(angle - atan(angle)) is angle³ / 3.
      const Verdict nearly = proven(spot({0, 0, -1}, 40, {-angle, 0, -1}, angle), cell);
      EXPECT_TRUE(nearly == Verdict::yes || (angle < 1e-250 && nearly == Verdict::uncertain)) << angle;
    }
}

// Small whole numbers and their quarters: much is parallel, perpendicular, in one plane or equally far.
SpotVolume whole_number_light(SplitMix64& random) {
  const auto whole = [&](int lo, int hi) { return lo + static_cast<double>(random.below(std::uint64_t(hi - lo + 1))); };
  const double angles[] = {k_pi / 2.0, k_pi / 3.0, k_pi / 4.0, k_pi / 6.0, std::atan(0.5), std::atan(2.0), 0.01, 1e-60};
  SpotVolume light = spot({whole(-8, 8), whole(-8, 8), whole(-12, 8)}, whole(1, 12), {},
                          random.below(16) == 0 ? 0.0 : angles[random.below(8)]);
  do light.direction = {whole(-2, 2), whole(-2, 2), whole(-2, 2)};
  while (light.direction == Vec3d(0.0));
  return light;
}

Slopes whole_number_slopes(SplitMix64& random) {
  const auto quarters = [&](int lo, int hi) {
    return 0.25f * static_cast<float>(lo + static_cast<int>(random.below(std::uint64_t(hi - lo + 1))));
  };
  Slopes s{quarters(-4, 3), 0, quarters(-4, 3), 0, 4.0f * quarters(0, 6), 0};
  s.x1 = s.x0 + quarters(1, 4);
  s.y1 = s.y0 + quarters(1, 4);
  s.far = s.near + 4.0f * quarters(1, 6);
  return s;
}

Cell whole_number_cell(SplitMix64& random, std::size_t kind) {
  const Slopes s = whole_number_slopes(random);
  if (kind == 0) return FrustumCell{s.x0, s.x1, s.y0, s.y1, s.near, s.far, false};
  if (kind == 1) return ShellCell{s.x0, s.x1, s.y0, s.y1, s.near, s.far};
  return Box{{4.0f * s.x0, 4.0f * s.y0, -s.far}, {4.0f * s.x1, 4.0f * s.y1, -s.near}};
}

TEST(Spot, of_whole_numbers_is_always_decided_and_never_against_the_filter) {
  SplitMix64 random(23);
  for (std::size_t kind = 0; kind < 3; ++kind) {
    int met = 0, left_by_filter = 0;
    for (int i = 0; i < 4000; ++i) {
      const SpotVolume light = whole_number_light(random);
      const Cell cell = whole_number_cell(random, kind);
      const Verdict decided = prove_meets(light, cell), filtered = filter_meets(light, cell);
      EXPECT_NE(decided, Verdict::uncertain) << "kind " << kind << " pair " << i;
      EXPECT_TRUE(filtered == Verdict::uncertain || filtered == decided) << "kind " << kind << " pair " << i;
      met += decided == Verdict::yes;
      left_by_filter += filtered == Verdict::uncertain;
    }
    EXPECT_GT(met, 300);
    EXPECT_GT(left_by_filter, 10);
  }
}

// The least range with which the spot is not certainly apart from the cell.
double touching_range(SpotVolume light, const Cell& cell) {
  double apart = 0.0, touching = 200.0;
  for (;;) {
    light.range = 0.5 * (apart + touching);
    if (light.range <= apart || light.range >= touching) return touching;
    Verdict now = filter_meets(light, cell);
    if (now == Verdict::uncertain) now = prove_meets(light, cell);
    EXPECT_NE(now, Verdict::uncertain);
    (now == Verdict::no ? apart : touching) = light.range;
  }
}

TEST(Spot, begins_to_touch_at_one_range_and_is_decided_around_it) {
  SplitMix64 random(29);
  for (int i = 0; i < 60; ++i) {
    const SpotVolume light = random_spot(random);
    for (const Cell& cell : {Cell(random_piece(random)), Cell(random_shell(random)), Cell(random_box(random))}) {
      const double touching = touching_range(light, cell);
      if (touching >= 200.0) continue;  // the cone does not meet it
      for (const int ulps : {-4, -2, -1, 0, 1, 2, 4}) {
        SpotVolume nudged = light;
        nudged.range = moved(touching, ulps);
        EXPECT_EQ(verdict(nudged, cell), ulps < 0 ? Verdict::no : Verdict::yes) << "pair " << i << " ulps " << ulps;
      }
    }
  }
}

TEST(Spot, that_holds_much_of_a_shell_piece_is_proven_to_however_far_it_reaches_beyond) {
  const ShellCell wide{-2, 4, 2, 8, 2, 2.5}, thin{-2, 2, -1, 5, 3.95591521f, 4.11773014f};
  for (const double range : {10.0, 1000.0, 1e15, std::numeric_limits<double>::infinity()}) {
    const Vec3d up(0x1.c9fbd7d1994bdp-2, 0x1.8302cf63f3da8p-1, -0x1.e99be1c6b8f42p-2);
    EXPECT_EQ(proven(spot({-1, -1.5, -0.5}, range, glm::normalize(up), 0x1.0c152382d7365p-1), wide), Verdict::yes);
    const Vec3d apex(-0.080428729675795729, 2.2406449120687872, 1.8565740992412714);
    const Vec3d down(-0.25884664601274504, -0.8506932619609241, -0.45751435813779129);
    EXPECT_EQ(proven(spot(apex, range, down, 0.26733714044650803), thin), Verdict::yes) << range;
  }
}

// Cells around the eye and spots beside them that reach far beyond: into the pyramid before a shell cell and behind
// it.
TEST(Spot, of_any_range_beside_wide_cells_near_the_eye_is_always_decided_and_never_against_the_filter) {
  SplitMix64 random(31);
  const double ranges[] = {4.0, 10.0, 1e3, 1e15, std::numeric_limits<double>::infinity()};
  int met = 0;
  for (int i = 0; i < 6000; ++i) {
    SpotVolume light = random_spot(random);
    light.apex.position = {random.between(-3, 3), random.between(-3, 3), random.between(-3, 3)};
    light.range = ranges[random.below(5)];
    light.half_angle_rad = random.between(0.1, 0.6);
    const auto f = [&](double lo, double hi) { return static_cast<float>(random.between(lo, hi)); };
    const float x = f(-3, 2), y = f(-3, 2), near = f(1, 5);
    const ShellCell shell{x, x + f(1, 6), y, y + f(1, 6), near, near + f(0.01, 0.5)};
    const FrustumCell frustum{shell.x0, shell.x1, shell.y0, shell.y1, shell.distance0, shell.distance1, false};
    for (const Cell& cell : {Cell(shell), Cell(frustum)}) {
      const Verdict decided = proven(light, cell), filtered = filter_meets(light, cell);
      EXPECT_NE(decided, Verdict::uncertain) << "pair " << i;
      EXPECT_TRUE(filtered == Verdict::uncertain || filtered == decided) << "pair " << i;
      met += decided == Verdict::yes;
    }
  }
  EXPECT_GT(met, 1000);
}

}  // namespace
}  // namespace clusterbench::geom
