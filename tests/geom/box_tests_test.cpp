// The single-precision tests of boxes against the exact decision: none loses a pair, at any size and by any hair.

#include "geom/single_precision/box_tests.h"

#include <gtest/gtest.h>

#include <cmath>

#include "effort.h"
#include "geom/box/box_decider.h"
#include "geom/numbers/round_to_float.h"
#include "geom/random_pairs.h"
#include "geom/single_precision/bounding_volumes.h"

namespace clusterbench::geom {
namespace {

// As view::lights_in hands it to methods.
PaddedBox as_methods_see(const BoxVolume& box, float roundoffs) {
  OrientedBox out;
  out.center = Vec3f(box.center.position);
  for (std::size_t i = 0; i < 3; ++i) out.axes[i] = Vec3f(box.half_axes[i]);
  const Vec3d& c = box.center.position;
  const float reach = rounded_up(std::abs(c.x) + std::abs(c.y) + std::abs(c.z) + rounded_up(box.range));
  return padded(out, roundoffs * (0x1p-24f * reach));
}

struct Found {
  bool coarse, refined, axes;
};
Found found(const BoxVolume& box, const FrustumCell& cell) {
  const Box bounds = box_around(cell);
  return {bounds_touch(as_methods_see(box, k_bounds_roundoffs), bounds),
          bounds_touch_in_box_space(as_methods_see(box, k_box_space_roundoffs), bounds) &&
              touches_sides(as_methods_see(box, k_sides_roundoffs), cell),
          no_axis_separates(as_methods_see(box, k_separating_axis_roundoffs), cell)};
}

double farthest_corner(const std::array<Vec3d, 3>& a) {
  double most = 0.0;
  for (const double s : {-1.0, 1.0})
    for (const double t : {-1.0, 1.0}) most = std::max(most, glm::length(a[0] + s * a[1] + t * a[2]));
  return most * (1.0 + 1e-14);
}

// A box with a corner at a cell's place, outward of it, moved by a margin along the way out.
BoxVolume box_against(const Contact& contact, double size, double margin, SplitMix64& random, int i) {
  const Vec3d x = i % 3 == 0 ? contact.outward : random_direction(random);
  const Vec3d y = glm::normalize(glm::cross(x, random_direction(random)));
  BoxVolume box;
  box.half_axes = {size * x, size * std::exp(random.between(-6, 1)) * y,
                   i % 4 == 0 ? Vec3d(0) : size * std::exp(random.between(-6, 1)) * glm::cross(x, y)};
  if (i % 5 == 0) box.half_axes[1] += 0.7 * box.half_axes[0];
  Vec3d corner(0);
  for (const Vec3d& axis : box.half_axes) corner -= glm::dot(axis, contact.outward) < 0.0 ? -axis : axis;
  box.center.position = contact.place + margin * contact.outward - corner;
  box.range = farthest_corner(box.half_axes);
  return box;
}

TEST(BoxTests, no_test_loses_a_box_that_touches_by_any_hair) {
  SplitMix64 random(21);
  int touching = 0;
  for (int i = 0; i < test::tries(20000); ++i) {
    const Slopes s = random_slopes(random);
    const bool orthographic = i % 6 == 0;
    const float scale = std::exp2(static_cast<float>(static_cast<int>(random.below(60)) - 30));
    FrustumCell cell{s.x0, s.x1, s.y0, s.y1, s.near * scale, s.far * scale, orthographic};
    if (orthographic)
      for (float* side : {&cell.x0, &cell.x1, &cell.y0, &cell.y1}) *side *= 20.0f * scale;
    Contact contact = random_contact(s, false, random);
    contact.place *= double{scale};
    if (orthographic) continue;
    const double size = double{scale} * std::exp(random.between(-9, 5));
    const double hair = std::exp(random.between(-40, -8)) * (size + glm::length(contact.place));
    const BoxVolume box = box_against(contact, size, i % 2 == 0 ? -hair : hair, random, i);
    if (!BoxDecider(box).meets(cell)) continue;
    ++touching;
    const Found by = found(box, cell);
    EXPECT_TRUE(by.coarse) << i;
    EXPECT_TRUE(by.refined) << i;
    EXPECT_TRUE(by.axes) << i;
  }
  EXPECT_GT(touching, test::tries(20000) / 5);
}

TEST(BoxTests, orthographic_cells_lose_none_either) {
  SplitMix64 random(22);
  int touching = 0;
  for (int i = 0; i < test::tries(4000); ++i) {
    const Slopes s = random_slopes(random);
    const FrustumCell cell{20 * s.x0, 20 * s.x1, 20 * s.y0, 20 * s.y1, s.near, s.far, true};
    const Vec3d at{random.below(2) == 0 ? cell.x0 : cell.x1, random.below(2) == 0 ? cell.y0 : cell.y1,
                   random.below(2) == 0 ? -cell.depth0 : -cell.depth1};
    const Contact contact{at, random_direction(random)};
    const BoxVolume box = box_against(contact, std::exp(random.between(-4, 4)),
                                      -std::exp(random.between(-36, -8)) * glm::length(at), random, i);
    if (!BoxDecider(box).meets(cell)) continue;
    ++touching;
    const Found by = found(box, cell);
    EXPECT_TRUE(by.coarse && by.refined && by.axes) << i;
  }
  EXPECT_GT(touching, test::tries(4000) / 2);
}

TEST(BoxTests, each_test_says_no_more_often_than_the_one_before_and_separating_axes_are_nearly_exact) {
  SplitMix64 random(23);
  int coarse = 0, refined = 0, axes = 0, meets = 0, all = 0;
  for (int i = 0; i < test::tries(4000); ++i) {
    const FrustumCell cell = random_piece(random);
    const Vec3d x = random_direction(random), y = glm::normalize(glm::cross(x, random_direction(random)));
    BoxVolume box;
    box.half_axes = {std::exp(random.between(-2, 2)) * x, std::exp(random.between(-2, 2)) * y,
                     std::exp(random.between(-5, 2)) * glm::cross(x, y)};
    box.range = farthest_corner(box.half_axes);
    box.center.position = point_of(cell, random) + box.range * random.unit() * random_direction(random);
    const Found by = found(box, cell);
    ++all;
    coarse += by.coarse;
    refined += by.coarse && by.refined;
    axes += by.axes;
    meets += BoxDecider(box).meets(cell);
  }
  EXPECT_LT(refined, coarse);
  EXPECT_LT(axes, refined);
  EXPECT_GE(axes, meets);
  EXPECT_LE(axes - meets, all / 500);
}

}  // namespace
}  // namespace clusterbench::geom
