#include "geom/light_meets_cell.h"
#include "geom/filter/light_filter.h"
#include "geom/shapes/verdict.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geom/ball/rational_ball.h"
#include "geom/random_pairs.h"
#include "measure/dykstra.h"

namespace clusterbench::geom {
namespace {

template <class Cell>
void expect_no_sampled_point_to_be_denied(bool is_cone, Cell (*make_cell)(SplitMix64&), int pairs) {
  SplitMix64 random(11);
  int found = 0;
  for (int i = 0; i < pairs; ++i) {
    const LightVolume light = random_light(random, is_cone);
    const Cell cell = make_cell(random);
    bool has_common_point = false;
    for (int sample = 0; sample < 1000 && !has_common_point; ++sample)
      has_common_point = volume_holds(light, point_of(cell, random));
    if (!has_common_point) continue;
    ++found;
    EXPECT_NE(filter_meets(light, cell), Verdict::no) << "pair " << i;
    EXPECT_EQ(prove_meets(light, cell), Verdict::yes) << "pair " << i;
  }
  EXPECT_GT(found, 20);
}

TEST(Meets, balls_and_frustum_pieces_with_a_common_point_meet) {
  expect_no_sampled_point_to_be_denied(false, random_piece, 1500);
}
TEST(Meets, balls_and_shell_pieces_with_a_common_point_meet) {
  expect_no_sampled_point_to_be_denied(false, random_shell, 1500);
}
TEST(Meets, spots_and_frustum_pieces_with_a_common_point_meet) {
  expect_no_sampled_point_to_be_denied(true, random_piece, 2500);
}
TEST(Meets, spots_and_shell_pieces_with_a_common_point_meet) {
  expect_no_sampled_point_to_be_denied(true, random_shell, 2500);
}

TEST(Meets, a_light_that_reaches_a_face_edge_or_corner_by_a_hair_meets_the_cell) {
  SplitMix64 random(31);
  for (int i = 0; i < 4000; ++i) {
    const Slopes s = random_slopes(random);
    for (const By by : {By::ball, By::cap, By::rim, By::side})
      for (const bool is_shell : {false, true}) {
        const Reach reach{random.between(0.5, 20.0), random.between(0.05, 1.5), 1e-6};
        const LightVolume light = light_against(random_contact(s, is_shell, random), by, reach, random);
        const Cell cell = is_shell ? Cell(ShellCell{s.x0, s.x1, s.y0, s.y1, s.near, s.far})
                                   : Cell(FrustumCell{s.x0, s.x1, s.y0, s.y1, s.near, s.far, false});
        Verdict verdict = filter_meets(light, cell);
        if (verdict == Verdict::uncertain) verdict = prove_meets(light, cell);
        EXPECT_EQ(verdict, Verdict::yes) << i << ", part " << static_cast<int>(by) << ", shell " << is_shell;
      }
  }
}

// A sheet 20 m wide and 12 cm thick: no edge or corner is near, nor does the light end in it.
TEST(Meets, a_light_that_passes_through_the_middle_of_a_thin_cell_meets_it) {
  const FrustumCell sheet{-1.0f, 1.0f, -1.0f, 1.0f, 10.0f, 10.125f, false};
  SpotVolume light{{{1.0, -2.0, -9.0}}, 3.0};
  EXPECT_EQ(filter_meets(BallVolume{light.apex, light.range}, sheet), Verdict::yes);
  light.half_angle_rad = 0.2;
  for (const Vec3d& direction : {Vec3d(0, 0, -1), Vec3d(1, 0, -1), Vec3d(-1, 1, -1)}) {
    light.direction = glm::normalize(direction);
    EXPECT_EQ(filter_meets(light, sheet), Verdict::yes);
    EXPECT_EQ(prove_meets(light, sheet), Verdict::yes);
  }
}

TEST(Meets, spots_agree_with_alternating_projections) {
  SplitMix64 random(5);
  int met = 0, decided = 0;
  for (int i = 0; i < 3000; ++i) {
    const SpotVolume light = random_spot(random);
    const FrustumCell cell = random_piece(random);
    const test::DykstraCone cone{light.apex.position, light.direction, light.half_angle_rad};
    const test::DykstraResult nearest = test::distance_to_common_point(cone, cell, 300);
    const bool has_converged = nearest.violation < 1e-7;
    const bool is_clear = std::abs(nearest.distance - light.range) > 1e-3;
    if (!has_converged || !is_clear) continue;
    ++decided;
    const bool expected = nearest.distance < light.range;
    EXPECT_EQ(filter_meets(light, cell), expected ? Verdict::yes : Verdict::no) << "pair " << i;
    met += expected;
  }
  EXPECT_GT(decided, 300);
  EXPECT_GT(met, 30);
}

// Pulls the range to within a few ulps of touching, by what exact arithmetic says.
double touching_range(const BallVolume& light, const FrustumCell& cell) {
  double apart = 0.0, touching = 200.0;
  for (;;) {
    const double middle = 0.5 * (apart + touching);
    if (middle <= apart || middle >= touching) return touching;
    (ball_meets_exactly(light.center, middle, cell) ? touching : apart) = middle;
  }
}

TEST(Meets, the_filter_never_contradicts_exact_arithmetic_within_a_few_ulps_of_touching) {
  SplitMix64 random(9);
  for (int i = 0; i < 12; ++i) {
    auto light = std::get<BallVolume>(random_light(random, false));
    const FrustumCell cell = random_piece(random);
    const double touching = touching_range(light, cell);
    for (const int ulps : {-4, -1, 0, 1, 4}) {
      light.range = touching;
      for (int step = 0; step < std::abs(ulps); ++step) light.range = std::nextafter(light.range, ulps < 0 ? 0.0 : 1e9);
      const Verdict exact = prove_meets(light, cell);
      EXPECT_EQ(exact, ulps < 0 ? Verdict::no : Verdict::yes);
      const Verdict filtered = filter_meets(light, cell);
      EXPECT_TRUE(filtered == Verdict::uncertain || filtered == exact) << "ulps " << ulps;
    }
  }
}

TEST(Meets, filter_and_proof_agree_wherever_the_filter_speaks) {
  SplitMix64 random(13);
  for (int i = 0; i < 60; ++i) {
    const LightVolume light = random_light(random, true);
    for (const Cell& cell : {Cell(random_piece(random)), Cell(random_shell(random))}) {
      const Verdict filtered = filter_meets(light, cell);
      if (filtered != Verdict::uncertain) {
        EXPECT_EQ(prove_meets(light, cell), filtered);
      }
    }
  }
}

TEST(Meets, an_apex_on_a_corner_of_the_cell_is_a_common_point_wherever_the_cone_points) {
  const FrustumCell cell{-0.75f, 0.75f, -0.5f, 0.5f, 8.0f, 32.0f, false};
  SpotVolume light;
  light.apex.position = {6.0, 4.0, -8.0};
  light.range = 1.0;
  light.direction = {0.0, 0.0, 1.0};  // away from the cell
  light.half_angle_rad = 0.2;
  EXPECT_EQ(prove_meets(light, cell), Verdict::yes);
  light.apex.position.z = -7.999;
  EXPECT_EQ(prove_meets(light, cell), Verdict::no);
}

TEST(Meets, a_ball_tangent_to_the_side_of_a_shell_piece_is_decided) {
  const ShellCell cell{-0.75f, 0.75f, -0.5f, 0.5f, 8.0f, 32.0f};
  BallVolume light;
  light.center.position = {16.0, 0.0, -13.0};
  light.range = 5.0;
  EXPECT_EQ(filter_meets(light, cell), Verdict::uncertain);
  EXPECT_EQ(prove_meets(light, cell), Verdict::yes);
  light.range = std::nextafter(5.0, 0.0);
  EXPECT_EQ(prove_meets(light, cell), Verdict::no);
}

TEST(Meets, a_very_narrow_cone_meets_the_cells_that_its_axis_passes_within_its_angle) {
  SpotVolume light;
  light.range = 100.0;
  light.half_angle_rad = 1.7453e-4;  // 0.01 degrees: sqrt(1 - cos²) is lost in single precision
  const FrustumCell cell{0.0625f, 0.125f, -0.05f, 0.05f, 10.0f, 20.0f, false};
  light.direction = glm::normalize(Vec3d(0.0625 - 1.6e-4, 0.0, -1.0));
  EXPECT_EQ(filter_meets(light, cell), Verdict::yes);
  light.direction = glm::normalize(Vec3d(0.0625 - 1.9e-4, 0.0, -1.0));
  EXPECT_EQ(filter_meets(light, cell), Verdict::no);
}

TEST(Distances, the_inner_interval_is_reached_and_the_outer_one_is_not_left) {
  SplitMix64 random(21);
  int checked = 0;
  for (int i = 0; i < 400; ++i) {
    const LightVolume light = random_light(random, i % 2 == 0);
    ShellCell tile = random_shell(random);
    tile.distance1 = 100.0f;
    const DistanceInterval reach = LightFilter(light).distances(tile);
    for (int sample = 0; sample < 300; ++sample) {
      const Vec3d ray{random.between(tile.x0, tile.x1), random.between(tile.y0, tile.y1), -1.0};
      const Vec3d p = random.between(0.0, 80.0) / glm::length(ray) * ray;
      if (!volume_holds(light, p)) continue;
      ++checked;
      EXPECT_LE(reach.outer_lo, glm::length(p));
      EXPECT_GE(reach.outer_hi, glm::length(p));
    }
    if (reach.inner_lo > reach.inner_hi) continue;
    EXPECT_LE(reach.outer_lo, reach.inner_lo);
    EXPECT_GE(reach.outer_hi, reach.inner_hi);
    EXPECT_LE(reach.likely_lo, reach.inner_lo);
    EXPECT_GE(reach.likely_hi, reach.inner_hi);
    EXPECT_LT(reach.likely_hi - reach.inner_hi + reach.inner_lo - reach.likely_lo, 1e-3);
  }
  EXPECT_GT(checked, 1000);
}

}  // namespace
}  // namespace clusterbench::geom
