// Boxes against cells: the decider's steps against an oracle that goes another way, and against touches that are known.

#include "geom/box/box_decider.h"

#include <gtest/gtest.h>

#include <cmath>

#include "effort.h"
#include "geom/box/quick_box.h"
#include "geom/box_oracle.h"
#include "geom/light_meets_cell.h"
#include "geom/random_pairs.h"

namespace clusterbench::geom {
namespace {

enum class Shape { frustum, orthographic, box, shell };

BoxVolume box_of(const Vec3d& middle, const std::array<Vec3d, 3>& half_axes) {
  BoxVolume box;
  box.center.position = middle;
  box.half_axes = half_axes;
  box.range = glm::length(half_axes[0]) + glm::length(half_axes[1]) + glm::length(half_axes[2]);
  return box;
}

Mat3d any_rotation(SplitMix64& random) {
  const Vec3d x = random_direction(random), y = glm::normalize(glm::cross(x, random_direction(random)));
  return Mat3d(x, y, glm::cross(x, y));
}

// Half axes of any length; every fifth box is flat, every seventh a segment, every third sheared.
BoxVolume random_volume(SplitMix64& random, int i) {
  const Mat3d turn = any_rotation(random);
  std::array<Vec3d, 3> axes;
  for (int axis = 0; axis < 3; ++axis)
    axes[static_cast<std::size_t>(axis)] = std::exp(random.between(-3.0, 3.0)) * turn[axis];
  if (i % 3 == 0) axes[0] += random.between(-1.0, 1.0) * axes[1];
  if (i % 5 == 0) axes[2] = Vec3d(0.0);
  if (i % 7 == 0) axes[1] = Vec3d(0.0);
  BoxVolume box = box_of({random.between(-20, 20), random.between(-20, 20), random.between(-60, 5)}, axes);
  if (i % 2 == 0) {
    box.center.rotation = any_rotation(random);
    box.center.origin = {random.between(-9, 9), random.between(-9, 9), random.between(-9, 9)};
  }
  return box;
}

Cell random_cell(Shape shape, SplitMix64& random) {
  if (shape == Shape::box) return random_box(random);
  if (shape == Shape::shell) return random_shell(random);
  FrustumCell cell = random_piece(random);
  if (shape == Shape::orthographic) {
    cell.orthographic = true;
    for (float* side : {&cell.x0, &cell.x1, &cell.y0, &cell.y1}) *side *= 20.0f;
  }
  return cell;
}

Vec3d middle_of(const Cell& cell) {
  if (const auto* box = std::get_if<Box>(&cell)) return 0.5 * (Vec3d(box->lo) + Vec3d(box->hi));
  if (const auto* shell = std::get_if<ShellCell>(&cell)) {
    const Vec3d ray{0.5 * (shell->x0 + shell->x1), 0.5 * (shell->y0 + shell->y1), -1.0};
    return 0.5 * (shell->distance0 + shell->distance1) * glm::normalize(ray);
  }
  const auto& frustum = std::get<FrustumCell>(cell);
  const double depth = 0.5 * (frustum.depth0 + frustum.depth1), scale = frustum.orthographic ? 1.0 : depth;
  return {0.5 * scale * (frustum.x0 + frustum.x1), 0.5 * scale * (frustum.y0 + frustum.y1), -depth};
}

bool has_volume(const BoxVolume& box) {
  const auto& a = box.half_axes;
  return glm::dot(glm::cross(a[0], a[1]), a[2]) != 0.0;
}

class AnyShape : public testing::TestWithParam<Shape> {};

TEST_P(AnyShape, all_steps_agree_with_the_oracle_on_boxes_of_any_form) {
  SplitMix64 random(11);
  int yes = 0, no = 0, quick = 0, all = 0;
  for (int i = 0; i < test::tries(120); ++i) {
    BoxVolume box = random_volume(random, i);
    const Cell cell = random_cell(GetParam(), random);
    if (GetParam() == Shape::shell && !has_volume(box)) continue;
    // Near the cell, so that most pairs are close.
    const Vec3d towards = middle_of(cell) + box.range * random.between(0.0, 1.2) * random_direction(random);
    box.center.position = glm::transpose(box.center.rotation) * towards + box.center.origin;
    const bool meets = oracle_meets(box, cell);
    const BoxDecider decider(box);
    EXPECT_EQ(decider.meets(cell), meets) << i;
    EXPECT_EQ(decider.meets_exactly(cell), meets) << i;
    const Verdict verdict = decider.meets_quickly(cell);
    EXPECT_TRUE(verdict == Verdict::uncertain || (verdict == Verdict::yes) == meets) << i;
    EXPECT_EQ(decide_meets(box, cell), meets ? Verdict::yes : Verdict::no);
    ++(meets ? yes : no);
    quick += verdict != Verdict::uncertain;
    ++all;
  }
  EXPECT_GT(yes, all / 5);
  EXPECT_GT(no, all / 5);
  EXPECT_GT(quick, all * 98 / 100);
}

// Small whole numbers, where boxes touch cells exactly and often.
Cell lattice_cell(Shape shape, SplitMix64& random) {
  const auto whole = [&](int lo, int hi) {
    return static_cast<float>(lo + static_cast<int>(random.below(static_cast<std::uint64_t>(hi - lo + 1))));
  };
  if (shape == Shape::box) {
    const Vec3f lo{whole(-3, 1), whole(-3, 1), whole(-5, -2)};
    return Box{lo, lo + Vec3f(whole(1, 2), whole(1, 2), whole(1, 2))};
  }
  const float x = whole(-2, 1), y = whole(-2, 1), near = whole(0, 3);
  const float x1 = x + whole(1, 2), y1 = y + whole(1, 2), far = near + whole(1, 3);
  if (shape == Shape::shell) return ShellCell{x, x1, y, y1, near, far};
  return FrustumCell{x, x1, y, y1, near, far, shape == Shape::orthographic};
}

BoxVolume lattice_volume(SplitMix64& random) {
  const auto whole = [&](int most) {
    return static_cast<double>(static_cast<int>(random.below(static_cast<std::uint64_t>(2 * most + 1))) - most);
  };
  const auto vector = [&](int most) { return Vec3d{whole(most), whole(most), whole(most)}; };
  return box_of(vector(5), {vector(1), vector(1), vector(1)});
}

TEST_P(AnyShape, touches_on_a_lattice_are_decided_as_the_oracle_does) {
  SplitMix64 random(12);
  int touching = 0, exact_steps = 0;
  for (int i = 0; i < test::tries(500); ++i) {
    const Cell cell = lattice_cell(GetParam(), random);
    const BoxVolume box = lattice_volume(random);
    if (GetParam() == Shape::shell && !has_volume(box)) continue;
    const bool meets = oracle_meets(box, cell);
    const BoxDecider decider(box);
    EXPECT_EQ(decider.meets(cell), meets) << i;
    EXPECT_EQ(decider.meets_exactly(cell), meets) << i;
    exact_steps += decider.exact_decisions() > 0;
    // It meets the cell, and a box that is smaller by 2^-40 does not.
    touching += meets && has_volume(box) && !oracle_meets(with_range(box, box.range * (1.0 - 0x1p-40)), cell);
  }
  EXPECT_GT(touching, test::tries(500) / 80);
  // Crossings at thirds are not doubles.
  EXPECT_LT(exact_steps, test::tries(500) / 4);
}

INSTANTIATE_TEST_SUITE_P(Shapes, AnyShape,
                         testing::Values(Shape::frustum, Shape::orthographic, Shape::box, Shape::shell));

// One step of a double's last digit.
TEST(BoxDecider, a_box_that_touches_a_face_by_nothing_meets_it_and_one_ulp_away_does_not) {
  const Box cell{{0, 0, -4}, {1, 1, -3}};
  const std::array<Vec3d, 3> axes{Vec3d(0.5, 0, 0), Vec3d(0, 2, 0), Vec3d(0, 0, 2)};
  EXPECT_TRUE(BoxDecider(box_of({1.5, 0, -3.5}, axes)).meets(cell));
  EXPECT_FALSE(BoxDecider(box_of({std::nextafter(1.5, 2), 0, -3.5}, axes)).meets(cell));
  EXPECT_TRUE(BoxDecider(box_of({std::nextafter(1.5, 1), 0, -3.5}, axes)).meets(cell));
}

TEST(BoxDecider, corners_edges_and_flat_boxes_touch_as_closed_sets_do) {
  const Box cell{{0, 0, 0}, {1, 1, 1}};
  const std::array<Vec3d, 3> cube{Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)};
  EXPECT_TRUE(BoxDecider(box_of({2, 2, 2}, cube)).meets(cell));
  EXPECT_FALSE(BoxDecider(box_of({2, 2, std::nextafter(2, 3)}, cube)).meets(cell));
  // An edge across an edge: a box turned by 45° about z, as an axis of it says, and then about x.
  const std::array<Vec3d, 3> turned{Vec3d(1, 1, 0), Vec3d(-0.5, 0.5, 0.5), Vec3d(0.5, -0.5, 1)};
  EXPECT_EQ(BoxDecider(box_of({1.5, 1.5, 2}, turned)).meets(cell), oracle_meets(box_of({1.5, 1.5, 2}, turned), cell));
  // A decal without thickness in the cell's face, and a segment through its corner.
  EXPECT_TRUE(BoxDecider(box_of({1, 0.5, 0.5}, {Vec3d(0), Vec3d(0, 9, 0), Vec3d(0, 0, 9)})).meets(cell));
  EXPECT_FALSE(
      BoxDecider(box_of({std::nextafter(1, 2), 0.5, 0.5}, {Vec3d(0), Vec3d(0, 9, 0), Vec3d(0, 0, 9)})).meets(cell));
  EXPECT_TRUE(BoxDecider(box_of({1, 1, 1}, {Vec3d(1, -1, 0), Vec3d(0), Vec3d(0)})).meets(cell));
  EXPECT_FALSE(BoxDecider(box_of({1, 1, std::nextafter(1, 2)}, {Vec3d(1, -1, 0), Vec3d(0), Vec3d(0)})).meets(cell));
  // A point, and three half axes in one plane.
  EXPECT_TRUE(BoxDecider(box_of({1, 1, 1}, {})).meets(cell));
  EXPECT_TRUE(BoxDecider(box_of({1.5, 1, 1}, {Vec3d(0.25, 0, 0), Vec3d(0.25, 0, 0), Vec3d(0, 1, 0)})).meets(cell));
  EXPECT_FALSE(BoxDecider(box_of({1.5, 1, 1}, {Vec3d(0.25, 0, 0), Vec3d(0.125, 0, 0), Vec3d(0, 1, 0)})).meets(cell));
}

TEST(BoxDecider, a_cell_within_a_box_and_a_box_within_a_cell_meet) {
  const FrustumCell cell{-1, 1, -1, 1, 0, 4, false};
  EXPECT_TRUE(BoxDecider(box_of({0, 0, -2}, {Vec3d(90, 0, 9), Vec3d(0, 90, 0), Vec3d(-9, 0, 90)})).meets(cell));
  EXPECT_TRUE(BoxDecider(box_of({0, 0, -2}, {Vec3d(0.1, 0.2, 0), Vec3d(0, 0.1, 0), Vec3d(0, 0, 0.1)})).meets(cell));
}

TEST(BoxDecider, shells_are_met_between_the_nearest_and_the_farthest_point) {
  // A wall at depth 3 across the whole tile: nearest 3, farthest at the corners.
  const BoxVolume wall = box_of({0, 0, -3.5}, {Vec3d(9, 0, 0), Vec3d(0, 9, 0), Vec3d(0, 0, 0.5)});
  const BoxDecider decider(wall);
  const float corner = static_cast<float>(std::sqrt(3.0) * 4.0);
  ShellCell shell{-1, 1, -1, 1, 1, 3};
  EXPECT_TRUE(decider.meets(shell));
  shell.distance1 = std::nextafter(3.0f, 0.0f);
  EXPECT_FALSE(decider.meets(shell));
  EXPECT_TRUE(decider.meets(ShellCell{-1, 1, -1, 1, std::nextafter(corner, 0.0f), 9}));
  EXPECT_FALSE(decider.meets(ShellCell{-1, 1, -1, 1, std::nextafter(corner, 9.0f), 9}));
  // The eye in the box.
  const BoxVolume around = box_of({0, 0, 0}, {Vec3d(2, 0, 0), Vec3d(0, 2, 0), Vec3d(0, 0, 2)});
  EXPECT_TRUE(BoxDecider(around).meets(ShellCell{-1, 1, -1, 1, 0, 0.5f}));
  EXPECT_TRUE(BoxDecider(around).meets(ShellCell{-0.5f, 0.5f, -0.5f, 0.5f, 2, 3}));
  EXPECT_FALSE(BoxDecider(around).meets(ShellCell{-0.5f, 0.5f, -0.5f, 0.5f, 2.5f, 3}));
  // Behind the eye.
  const BoxVolume behind = box_of({0, 0, 5}, {Vec3d(2, 0, 0), Vec3d(0, 2, 0), Vec3d(0, 0, 2)});
  EXPECT_FALSE(BoxDecider(behind).meets(ShellCell{-1, 1, -1, 1, 0, 90}));
}

// The oracle takes none without volume.
TEST(BoxDecider, flat_boxes_meet_the_shells_that_boxes_of_next_to_no_thickness_do) {
  SplitMix64 random(14);
  int yes = 0, no = 0;
  for (int i = 0; i < test::tries(150); ++i) {
    BoxVolume flat = random_volume(random, 1);
    const ShellCell cell = random_shell(random);
    flat.center.position = middle_of(cell) + flat.range * random.unit() * random_direction(random);
    BoxVolume thick = flat;
    flat.half_axes[2] = Vec3d(0);
    thick.half_axes[2] *= 1e-12;
    const bool meets = BoxDecider(flat).meets(cell);
    EXPECT_EQ(BoxDecider(flat).meets_exactly(cell), meets);
    EXPECT_EQ(oracle_meets(thick, cell), meets) << i;
    ++(meets ? yes : no);
  }
  EXPECT_GT(yes, test::tries(150) / 8);
  EXPECT_GT(no, test::tries(150) / 8);
}

TEST(BoxDecider, a_point_is_in_a_box_as_its_own_coordinates_say) {
  SplitMix64 random(15);
  for (int i = 0; i < test::tries(300); ++i) {
    BoxVolume box = random_volume(random, i);
    box.center.rotation = Mat3d(1.0);
    const Vec3d from = box.center.position - box.center.origin;
    const auto at = [&](double a, double b, double c) {
      return from + a * box.half_axes[0] + b * box.half_axes[1] + c * box.half_axes[2];
    };
    const Vec3d in{random.between(-0.99, 0.99), random.between(-0.99, 0.99), random.between(-0.99, 0.99)};
    const BoxDecider decider(box);
    const QuickBox quick(box, from);
    if (has_volume(box)) {
      EXPECT_TRUE(decider.holds(at(in.x, in.y, in.z)));
    }
    EXPECT_FALSE(quick.surely_misses(at(in.x, in.y, in.z), 0.0));
    EXPECT_FALSE(decider.holds(at(1.01, in.y, in.z)) && has_volume(box));
    EXPECT_FALSE(quick.surely_holds(at(1.01, in.y, in.z)));
    EXPECT_FALSE(quick.surely_holds(at(1.0, in.y, in.z)));
  }
  const BoxDecider flat(box_of({1, 2, 3}, {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0)}));
  EXPECT_TRUE(flat.holds({0, 1, 3}));
  EXPECT_TRUE(flat.holds({2, 2.5, 3}));
  EXPECT_FALSE(flat.holds({2, 2.5, std::nextafter(3.0, 4.0)}));
  EXPECT_FALSE(flat.holds({std::nextafter(2.0, 3.0), 2.5, 3}));
}

// Balls beyond the middle of a face: near enough by a millionth of what they measure, and too far by as much.
TEST(QuickBox, misses_balls_beyond_a_face_and_none_that_reach_it) {
  SplitMix64 random(16);
  int missed = 0;
  for (int i = 0; i < test::tries(1000); ++i) {
    const BoxVolume box = random_volume(random, i);
    const Vec3d middle = box.center.rotation * (box.center.position - box.center.origin);
    const QuickBox quick(box, middle);
    const auto axis_at = [&](int axis) { return box.center.rotation * box.half_axes[static_cast<std::size_t>(axis)]; };
    const int face = i % 3;
    const Vec3d normal = glm::cross(axis_at((face + 1) % 3), axis_at((face + 2) % 3));
    if (!(glm::length(normal) > 0.0)) continue;
    const Vec3d out = glm::normalize(normal) * (glm::dot(normal, axis_at(face)) < 0.0 ? -1.0 : 1.0);
    const Vec3d on_face = middle + axis_at(face);
    const double radius = std::exp(random.between(-4.0, 4.0)), hair = 1e-6 * (radius + glm::length(axis_at(face)));
    EXPECT_FALSE(quick.surely_misses(on_face + (radius - hair) * out, radius)) << i;
    missed += quick.surely_misses(on_face + (radius + hair) * out, radius) ? 1 : 0;
  }
  EXPECT_GT(missed, test::tries(1000) / 2);
}

}  // namespace
}  // namespace clusterbench::geom
