#include "geom/certificate/rational_spot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geom/random_pairs.h"

namespace clusterbench::geom {
namespace {

const Rational k_hair = Rational(1) / Rational(Integer(1) << 250);

ExactSpot spot(double half_angle) {
  SpotVolume light;
  light.range = 5.0;
  light.direction = {0.0, 0.0, -2.0};
  light.half_angle_rad = half_angle;
  return exact_spot(light);
}

TEST(SurelyHolds, takes_points_at_the_range_on_the_axis_and_none_beyond) {
  EXPECT_TRUE(surely_holds(spot(0.5), {0, 0, -5}));
  EXPECT_FALSE(surely_holds(spot(0.5), {0, 0, -5 - k_hair}));
  EXPECT_TRUE(surely_holds(spot(0.5), {0, 0, 0}));
  EXPECT_FALSE(surely_holds(spot(0.5), {0, 0, k_hair}));
}

TEST(SurelyHolds, takes_a_cone_of_half_angle_zero_as_its_axis) {
  EXPECT_TRUE(surely_holds(spot(0.0), {0, 0, -3}));
  EXPECT_FALSE(surely_holds(spot(0.0), {k_hair, 0, -3}));
}

TEST(SurelyHolds, takes_points_within_the_angle_by_a_hair_and_leaves_those_outside_by_one) {
  for (const double angle : {1e-3, 0.5, std::numbers::pi / 4.0, std::numbers::pi / 2.0}) {
    const AngleBounds bounds = bounds_of_angle(exact(angle), 1040);
    EXPECT_TRUE(surely_holds(spot(angle), {bounds.sine.lo - k_hair, 0, -bounds.cosine.hi})) << angle;
    EXPECT_FALSE(surely_holds(spot(angle), {bounds.sine.hi + k_hair, 0, -bounds.cosine.lo})) << angle;
  }
}

std::array<RationalPoint, 8> cube_at(const Rational& x, const Rational& z) {
  std::array<RationalPoint, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {x + ((i & 1) != 0 ? 1 : 0), (i & 2) != 0 ? 1 : -1, z - ((i & 4) != 0 ? 1 : 0)};
  return corners;
}

TEST(SurelySeparates, leaves_what_touches_and_takes_what_is_a_hair_away) {
  // The range's end, the half-space x <= 0 of a quarter cone's rim, and the apex from behind.
  const Rational sine = bounds_of_angle(exact(0.5), 1040).sine.hi;
  EXPECT_FALSE(surely_separates({0, 0, -1}, spot(0.5), cube_at(0, -5)));
  EXPECT_TRUE(surely_separates({0, 0, -1}, spot(0.5), cube_at(0, -5 - k_hair)));
  EXPECT_FALSE(surely_separates({1, 0, 0}, spot(0.5), cube_at(5 * sine - k_hair, -5)));
  EXPECT_TRUE(surely_separates({1, 0, 0}, spot(0.5), cube_at(5 * sine + k_hair, -5)));
  EXPECT_FALSE(surely_separates({0, 0, 3}, spot(0.5), cube_at(0, 1)));
  EXPECT_TRUE(surely_separates({0, 0, 3}, spot(0.5), cube_at(0, 1 + k_hair)));
}

// A half-angle known only to have a cosine around 0.8 and a sine around 0.6.
ExactSpot vague_spot() {
  ExactSpot vague = spot(0.6435);
  const Rational cosine(4, 5), sine(3, 5), off(1, 1000);
  vague.half_angle = {{cosine - off, cosine + off}, {sine - off, sine + off}};
  return vague;
}

TEST(Certificates, hold_for_every_angle_between_the_bounds) {
  EXPECT_FALSE(surely_holds(vague_spot(), {3, 0, -4}));
  EXPECT_TRUE(surely_holds(vague_spot(), {Rational(298, 100), 0, -4}));
  // The rim is at x = 3, the end of the generator (3, 0, -4) at 5, the side's plane through the apex.
  const RationalPoint sideways{1, 0, 0}, along{4, 0, 3};
  EXPECT_FALSE(surely_separates(sideways, vague_spot(), cube_at(Rational(3001, 1000), 0)));
  EXPECT_TRUE(surely_separates(sideways, vague_spot(), cube_at(Rational(3006, 1000), 0)));
  EXPECT_FALSE(surely_separates(along, vague_spot(), cube_at(Rational(1, 1000), 1)));
  EXPECT_TRUE(surely_separates(along, vague_spot(), cube_at(Rational(1, 10), 1)));
  // A normal that leans backwards, and one that may be within the cone, whose range alone counts then.
  const RationalPoint backwards{4, 0, Rational(29, 10)}, edgewise{3, 0, -4};
  EXPECT_FALSE(surely_separates(backwards, vague_spot(), cube_at(Rational(105, 1000), 1)));
  EXPECT_FALSE(surely_separates(edgewise, vague_spot(), cube_at(3, -4)));
  EXPECT_FALSE(surely_separates(edgewise, vague_spot(), cube_at(Rational(2999, 1000), -4)));
  EXPECT_TRUE(surely_separates(edgewise, vague_spot(), cube_at(Rational(3001, 1000), -4)));
}

TEST(SurelySeparates, never_says_so_where_a_point_of_the_volume_is_on_the_other_side) {
  SplitMix64 random(17);
  int separated = 0;
  for (int i = 0; i < 300; ++i) {
    const SpotVolume light = random_spot(random);
    const ExactSpot volume = exact_spot(light);
    const Vec3d normal = random_direction(random);
    // A small cell, as far along the normal as the farthest of random points of the volume, and a little nearer.
    double farthest = 0.0;
    for (int sample = 0; sample < 200; ++sample) {
      const Vec3d p = light.apex.position + light.range * std::cbrt(random.unit()) * random_direction(random);
      if (volume_holds(light, p)) farthest = std::max(farthest, glm::dot(normal, p - light.apex.position));
    }
    std::array<RationalPoint, 8> corners;
    for (RationalPoint& corner : corners) {
      const Vec3d p = light.apex.position + (farthest - 1e-9) * normal;
      corner = {exact(p.x), exact(p.y), exact(p.z)};
    }
    const RationalPoint direction{exact(normal.x), exact(normal.y), exact(normal.z)};
    EXPECT_FALSE(surely_separates(direction, volume, corners)) << "pair " << i;
    for (RationalPoint& corner : corners) corner = corner + exact(light.range) * direction;
    separated += surely_separates(direction, volume, corners);
  }
  EXPECT_GT(separated, 280);
}

}  // namespace
}  // namespace clusterbench::geom
