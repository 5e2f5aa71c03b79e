#include "view/packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"

namespace clusterbench::view {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr Packing k_lossy[] = {Packing::half, Packing::unorm16};

Vec3d random_unit(SplitMix64& random) {
  return glm::normalize(Vec3d{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
}

scene::WorldLight light_at(const Vec3d& place, double range) {
  scene::WorldLight light;
  light.position = place;
  light.range_m = range;
  return light;
}

scene::WorldLight spot_at(const Vec3d& place, double range, const Vec3d& axis, double angle) {
  scene::WorldLight light = light_at(place, range);
  light.type = scene::LightType::spot;
  light.direction = axis;
  light.outer_cone_rad = angle;
  return light;
}

// Points, then spots from needles to half-spaces, from a millimetre to kilometres from the eye.
Frame random_frame(std::uint64_t seed) {
  SplitMix64 random(seed);
  Frame frame;
  const auto place = [&] { return random_unit(random) * std::pow(10.0, random.between(-3, 3.5)); };
  const auto range = [&] { return std::pow(10.0, random.between(-2, 2.5)); };
  for (int i = 0; i < 300; ++i) frame.lights.push_back(light_at(place(), range()));
  frame.points = 300;
  constexpr double k_angles[] = {1e-6, 1e-3, 0.1, 0.5, 1.0, 1.5, 1.5706, M_PI / 2};
  for (int i = 0; i < 400; ++i) frame.lights.push_back(spot_at(place(), range(), random_unit(random), k_angles[i % 8]));
  return frame;
}

double angle_between(const Vec3d& a, const Vec3d& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

Vec3d place_of(const LightArrays& lights, std::uint32_t light) {
  return {lights.x[light], lights.y[light], lights.z[light]};
}

Vec3d axis_of(const LightArrays& lights, std::uint32_t spot) {
  return {lights.axis_x[spot], lights.axis_y[spot], lights.axis_z[spot]};
}

TEST(Packing, float32_changes_nothing) {
  const Frame frame = random_frame(1);
  const LightArrays lights = lights_in(frame, {});
  const PackedLights same = packed(lights, Packing::float32);
  EXPECT_EQ(same.lights.x, lights.x);
  EXPECT_EQ(same.lights.sin_angle, lights.sin_angle);
  const LightArrays grown = inflated(same);
  EXPECT_EQ(grown.radius, lights.radius);
  EXPECT_EQ(grown.z, lights.z);
  EXPECT_EQ(grown.reach, lights.reach);
}

TEST(Packing, half_and_unorm16_give_the_numbers_that_their_definitions_give) {
  Frame frame;
  frame.lights = {light_at({0, 0, 0}, 2049), light_at({1000.3, 65535, -0.1}, 4096)};
  frame.points = 2;
  const LightArrays lights = lights_in(frame, {});
  const LightArrays unorm = packed(lights, Packing::unorm16).lights;
  EXPECT_FLOAT_EQ(unorm.x[1], 1000.3f) << "the end of the box";
  EXPECT_EQ(unorm.y[1], 65535.0f);
  EXPECT_FLOAT_EQ(unorm.radius[0], 32784 * 4096.0f / 65535) << "rounded up from 32783.5 steps";
  frame.lights[1].position.y = 2049;
  const LightArrays half = packed(lights_in(frame, {}), Packing::half).lights;
  EXPECT_EQ(half.x[1], 1000.5f);
  EXPECT_EQ(half.y[1], 2048.0f) << "a tie goes to even";
  EXPECT_EQ(half.radius[0], 2050.0f) << "a range never ends before it did";
}

TEST(Packing, no_light_is_farther_off_than_its_bound_and_no_bound_is_far_too_large) {
  for (const Packing packing : k_lossy) {
    const Frame frame = random_frame(2);
    const Space space{{5, -3, 2}, Mat3d(Vec3d(0, 0, -1), Vec3d(0, 1, 0), Vec3d(1, 0, 0))};
    const PackedLights found = packed(lights_in(frame, space), packing);
    double nearest_place = 0, nearest_axis = 0, nearest_angle = 0;  // to the bound, as a share of it
    for (std::uint32_t i = 0; i < found.lights.size(); ++i) {
      const scene::WorldLight& light = frame.lights[i];
      const PackingBound& bound = found.bounds[i];
      const Vec3d exact = space.rotation * (light.position - space.origin);
      const double off = glm::length(place_of(found.lights, i) - exact);
      EXPECT_LE(off, bound.position_m) << packing_name(packing) << i;
      EXPECT_GE(static_cast<double>(found.lights.radius[i]), light.range_m);
      nearest_place = std::max(nearest_place, off / bound.position_m);
      if (!found.lights.is_spot(i)) continue;
      const std::uint32_t spot = i - found.lights.spots.first;
      const double turned = angle_between(axis_of(found.lights, spot), space.rotation * light.direction);
      const double angle = std::atan2(found.lights.sin_angle[spot], found.lights.cos_angle[spot]);
      EXPECT_LE(turned, bound.axis_rad);
      EXPECT_LE(std::fabs(angle - light.outer_cone_rad), bound.angle_rad);
      nearest_axis = std::max(nearest_axis, turned / bound.axis_rad);
      nearest_angle = std::max(nearest_angle, std::fabs(angle - light.outer_cone_rad) / bound.angle_rad);
    }
    EXPECT_GT(nearest_place, 0.8) << packing_name(packing);
    EXPECT_GT(nearest_axis, 0.5) << packing_name(packing);
    EXPECT_GT(nearest_angle, 0.3) << packing_name(packing);
  }
}

// A point of the light's volume, half of them at the end of its range, a third of a spot's on its side.
Vec3d point_of(const scene::WorldLight& light, SplitMix64& random) {
  const double distance = light.range_m * (random.unit() < 0.5 ? 1.0 : random.unit());
  if (light.type != scene::LightType::spot) return light.position + distance * random_unit(random);
  const double turn = light.outer_cone_rad * (random.unit() < 0.33 ? 1.0 : random.unit());
  const Vec3d side = glm::normalize(glm::cross(light.direction, random_unit(random)));
  return light.position + distance * (std::cos(turn) * light.direction + std::sin(turn) * side);
}

// How far a point lies outside of a light as the arrays have it; at most 0: inside.
double outside_by(const LightArrays& lights, std::uint32_t light, const Vec3d& point) {
  const Vec3d to_point = point - place_of(lights, light);
  const double beyond = glm::length(to_point) - lights.radius[light];
  if (!lights.is_spot(light)) return beyond;
  const std::uint32_t spot = light - lights.spots.first;
  const Vec3d axis = axis_of(lights, spot);
  const double along = glm::dot(to_point, axis), across = glm::length(to_point - along * axis);
  return std::max(beyond, static_cast<double>(lights.cos_angle[spot]) * across -
                              static_cast<double>(lights.sin_angle[spot]) * along);
}

TEST(Packing, an_inflated_light_holds_what_was_packed_and_one_that_is_not_inflated_does_not) {
  for (const Packing packing : k_lossy) {
    const Frame frame = random_frame(3);
    const PackedLights unpacked = packed(lights_in(frame, {}), packing);
    const LightArrays grown = inflated(unpacked);
    SplitMix64 random(4);
    int lost_balls = 0, lost_cones = 0;
    for (std::uint32_t i = 0; i < grown.size(); ++i)
      for (int k = 0; k < 200; ++k) {
        const Vec3d point = point_of(frame.lights[i], random);
        const double rounding = 0x1p-23 * static_cast<double>(grown.reach[i]);
        ASSERT_LE(outside_by(grown, i, point), rounding)
            << packing_name(packing) << ", light " << i << ", angle " << frame.lights[i].outer_cone_rad;
        if (outside_by(unpacked.lights, i, point) > rounding) ++(grown.is_spot(i) ? lost_cones : lost_balls);
      }
    EXPECT_GT(lost_balls, 100) << packing_name(packing);
    EXPECT_GT(lost_cones, 1000) << packing_name(packing);
  }
}

TEST(Packing, inflation_grows_a_point_by_its_places_bound_and_a_spot_by_a_few_of_its_own) {
  for (const Packing packing : k_lossy) {
    const Frame frame = random_frame(5);
    const PackedLights unpacked = packed(lights_in(frame, {}), packing);
    const LightArrays grown = inflated(unpacked);
    for (std::uint32_t i = 0; i < grown.size(); ++i) {
      const PackingBound& bound = unpacked.bounds[i];
      const double range = unpacked.lights.radius[i], more = grown.radius[i] - range;
      const double most = grown.is_spot(i)
                              ? bound.inflation_m(range) + std::max(0.5 * range, bound.position_m) + bound.position_m
                              : bound.position_m;
      EXPECT_LE(more, most * (1 + 1e-6) + 1e-6 * range) << packing_name(packing) << ", light " << i;
      EXPECT_GE(more, bound.position_m * (1 - 1e-6) - 1e-6 * range);
    }
  }
}

TEST(Packing, what_a_format_cannot_hold_is_told_and_keeps_its_numbers) {
  Frame frame;
  frame.lights = {light_at({1, 2, 3}, k_infinity), light_at({70000, 0, 0}, 3),
                  light_at({0, -65519, 0}, 3),     light_at({0, 0, 5}, 65505),
                  light_at({0, 0, 5}, 0.0),        spot_at({1, 2, 3}, k_infinity, {0, 0, 1}, 1.0)};
  frame.points = 5;
  const LightArrays lights = lights_in(frame, {});
  const PackedLights half = packed(lights, Packing::half), unorm = packed(lights, Packing::unorm16);
  EXPECT_EQ(half.unrepresentable, (std::vector<std::uint32_t>{0, 1, 3, 5}));
  EXPECT_EQ(unorm.unrepresentable, (std::vector<std::uint32_t>{0, 5}));
  for (const PackedLights* found : {&half, &unorm}) {
    const LightArrays grown = inflated(*found);
    for (const std::uint32_t light : found->unrepresentable) {
      EXPECT_EQ(grown.x[light], lights.x[light]);
      EXPECT_EQ(grown.radius[light], lights.radius[light]);
      EXPECT_EQ(found->bounds[light].inflation_m(k_infinity), 0.0);
    }
    for (std::uint32_t light = 0; light < grown.size(); ++light) {
      EXPECT_TRUE(std::isfinite(grown.x[light]) && std::isfinite(grown.y[light]) && std::isfinite(grown.z[light]));
      EXPECT_FALSE(std::isnan(grown.radius[light]));
    }
    EXPECT_EQ(grown.radius[4], 0.0f) << "a light without volume stays without";
  }
  EXPECT_EQ(half.lights.y[2], -65504.0f);
}

TEST(Packing, copes_with_no_light_and_with_lights_in_one_place) {
  for (const Packing packing : k_lossy) {
    EXPECT_EQ(packed(lights_in(Frame{}, {}), packing).lights.size(), 0u);
    Frame frame;
    frame.lights = {light_at({1.5, 2, 3}, 4), light_at({1.5, 2, 3}, 4)};
    frame.points = 2;
    const LightArrays lights = packed(lights_in(frame, {}), packing).lights;
    EXPECT_EQ(place_of(lights, 1), Vec3d(1.5, 2, 3));
    EXPECT_EQ(lights.radius[1], 4.0f);
  }
}

TEST(Packing, goes_back_to_the_same_source_as_what_was_packed) {
  const Frame frame = random_frame(6);
  const Space space{{5, -3, 2}, Mat3d(1.0)};
  const LightArrays grown = inflated(packed(lights_in(frame, space), Packing::half));
  EXPECT_EQ(grown.source.data(), frame.lights.data());
  EXPECT_EQ(grown.space.origin, space.origin);
}

}  // namespace
}  // namespace clusterbench::view
