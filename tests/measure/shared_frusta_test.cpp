// Frusta that spots share: every point of every member is in them, and groups are held against all partitions.

#include "measure/shadows/shared_frusta.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.h"

namespace clusterbench::measure {
namespace {

scene::WorldLight spot(const Vec3d& position, const Vec3d& direction, double half_angle_rad, double range_m) {
  scene::WorldLight light;
  light.type = scene::LightType::spot;
  light.position = position;
  light.direction = glm::normalize(direction);
  light.outer_cone_rad = half_angle_rad;
  light.range_m = range_m;
  return light;
}

Vec3d within(SplitMix64& random, double most) {
  const double x = random.between(-most, most), y = random.between(-most, most);
  return {x, y, random.between(-most, most)};
}

std::vector<std::uint32_t> all_of(const std::vector<scene::WorldLight>& lights) {
  std::vector<std::uint32_t> indices(lights.size());
  std::iota(indices.begin(), indices.end(), 0u);
  return indices;
}

// A point of a sphere-capped cone; one in three on its side, its cap or their rim.
Vec3d way_in(const scene::WorldLight& light, SplitMix64& random) {
  const Vec3d aside = std::abs(light.direction.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0);
  const Vec3d right = glm::normalize(glm::cross(light.direction, aside)), up = glm::cross(right, light.direction);
  const std::uint64_t where = random.below(6);
  const double turn = random.between(0.0, 6.283185307179586);
  const double lean = light.outer_cone_rad * (where == 0 || where == 1 ? 1.0 : random.unit());
  const double far = light.range_m * (where == 0 || where == 2 ? 1.0 : random.unit());
  return far * (std::cos(lean) * light.direction + std::sin(lean) * (std::cos(turn) * right + std::sin(turn) * up));
}

// `way`: from the apex.
bool holds(const SharedFrustum& frustum, const Vec3d& way) {
  const Vec3d aside = std::abs(frustum.axis.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0);
  const Vec3d right = glm::normalize(glm::cross(frustum.axis, aside)), up = glm::cross(right, frustum.axis);
  const double depth = glm::dot(way, frustum.axis), wide = frustum.slope * depth;
  return depth >= frustum.near_m && depth <= frustum.far_m && std::abs(glm::dot(way, right)) <= wide &&
         std::abs(glm::dot(way, up)) <= wide;
}

TEST(SharedFrusta, hold_every_point_of_every_members_cone) {
  SplitMix64 random(1);
  int frusta = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<scene::WorldLight> lights;
    const Vec3d axis = within(random, 1.0);
    const std::uint64_t count = 1 + random.below(5);
    const double lean = random.unit();
    for (std::uint64_t i = 0; i < count; ++i) {
      const Vec3d position = within(random, 3.0) + std::pow(10.0, round % 12) * Vec3d(1.0, 0.0, -0.5),
                  direction = axis + within(random, 0.5 * lean);
      const double half_angle = random.between(0.02, 0.9);
      lights.push_back(spot(position, direction, half_angle, random.between(0.5, 40.0)));
    }
    const std::vector<std::uint32_t> members = all_of(lights);
    const std::optional<SharedFrustum> frustum = frustum_around(lights, members);
    if (!frustum) continue;
    ++frusta;
    for (const scene::WorldLight& light : lights)
      for (int i = 0; i < 200; ++i)
        ASSERT_TRUE(holds(*frustum, (light.position - frustum->apex) + way_in(light, random))) << round;
  }
  EXPECT_GT(frusta, 300);
}

TEST(SharedFrusta, a_spots_own_is_the_square_around_its_cone) {
  const std::vector<scene::WorldLight> lights{spot({1, 2, 3}, {0, 0, -1}, 0.5, 10.0)};
  const std::optional<SharedFrustum> own = frustum_around(lights, all_of(lights));
  ASSERT_TRUE(own);
  EXPECT_NEAR(own->slope, std::tan(0.5), 1e-8);
  EXPECT_NEAR(own->far_m, 10.0, 1e-6);
  EXPECT_NEAR(own->near_m, 0.0, 1e-6);
  EXPECT_NEAR(own->volume_m3(), 4.0 / 3.0 * std::pow(std::tan(0.5), 2.0) * 1000.0, 1e-3);
  // Of a cube's side, a sixth of all directions.
  SharedFrustum side;
  side.slope = 1.0;
  EXPECT_NEAR(side.solid_angle_sr(), 4.0 * 3.14159265358979323846 / 6.0, 1e-12);
}

TEST(SharedFrusta, none_holds_what_points_apart_or_has_no_end) {
  const double endless = std::numeric_limits<double>::infinity();
  const std::vector<scene::WorldLight> lights{
      spot({0, 0, 0}, {0, 0, -1}, 0.3, 10.0), spot({0, 0, 0}, {0, 0, 1}, 0.3, 10.0),
      spot({0, 0, 0}, {0, 0, -1}, 0.3, endless), spot({0, 0, 0}, {0, 0, -1}, 1.5, 9.0)};
  const auto around = [&](std::vector<std::uint32_t> of) { return frustum_around(lights, of).has_value(); };
  EXPECT_TRUE(around({0}));
  EXPECT_FALSE(around({0, 1}));
  EXPECT_FALSE(around({2}));
  EXPECT_FALSE(around({3}));
  EXPECT_FALSE(around({0, 3}));
}

TEST(SharedFrusta, headlights_of_a_car_share_one_and_those_of_two_cars_do_not) {
  std::vector<scene::WorldLight> lights;
  for (const double z : {0.0, -30.0})
    for (const double side : {-0.7, 0.7}) lights.push_back(spot({side, 0.7, z}, {0, -0.06, -1}, 0.244, 38.0));
  lights.push_back(spot({0.0, 0.7, 0.5}, {0, -0.06, 1}, 0.244, 38.0));  // backwards
  const std::vector<SharedFrustum> frusta = shared_frusta(lights, all_of(lights), {});
  ASSERT_EQ(frusta.size(), 3u);
  EXPECT_EQ(frusta[0].members, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(frusta[1].members, (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(frusta[2].members, (std::vector<std::uint32_t>{4}));
  const double own = frustum_around(lights, std::vector<std::uint32_t>{0})->volume_m3();
  EXPECT_GT(frusta[0].volume_m3(), own);
  EXPECT_LT(frusta[0].volume_m3(), 1.5 * own);
}

bool is_allowed(const std::vector<scene::WorldLight>& lights, const std::vector<std::uint32_t>& members,
                const SharingLimits& limits) {
  double largest = 0.0;
  for (const std::uint32_t a : members) {
    const std::optional<SharedFrustum> own = frustum_around(lights, std::vector<std::uint32_t>{a});
    if (!own) return false;
    largest = std::max(largest, own->volume_m3());
    for (const std::uint32_t b : members) {
      if (glm::length(lights[a].position - lights[b].position) > limits.most_apart_m) return false;
      const double cosine = std::clamp(glm::dot(lights[a].direction, lights[b].direction), -1.0, 1.0);
      if (std::acos(cosine) > limits.most_turned_rad + 1e-7) return false;
    }
  }
  const std::optional<SharedFrustum> frustum = frustum_around(lights, members);
  return frustum && (members.size() == 1 || frustum->volume_m3() <= limits.most_growth * largest);
}

// The fewest groups of all partitions: each light joins a group or begins one.
std::size_t fewest(const std::vector<scene::WorldLight>& lights, const SharingLimits& limits, std::uint32_t next,
                   std::vector<std::vector<std::uint32_t>>& groups) {
  if (next == lights.size())
    return std::ranges::all_of(groups, [&](const auto& group) { return is_allowed(lights, group, limits); })
               ? groups.size()
               : lights.size();
  std::size_t best = lights.size();
  for (std::size_t i = 0; i < groups.size(); ++i) {
    groups[i].push_back(next);
    best = std::min(best, fewest(lights, limits, next + 1, groups));
    groups[i].pop_back();
  }
  groups.push_back({next});
  best = std::min(best, fewest(lights, limits, next + 1, groups));
  groups.pop_back();
  return best;
}

TEST(SharedFrusta, groups_keep_the_limits_and_are_nearly_as_few_as_in_the_best_of_all_partitions) {
  SplitMix64 random(5);
  constexpr int k_rounds = 150;
  int best_found = 0, shared = 0;
  for (int round = 0; round < k_rounds; ++round) {
    std::vector<scene::WorldLight> lights;
    for (int i = 0; i < 6; ++i) {
      const Vec3d position = within(random, 1.2), direction = Vec3d(0, 0, -1) + within(random, 0.2);
      lights.push_back(spot(position, direction, random.between(0.15, 0.4), random.between(10.0, 30.0)));
    }
    const SharingLimits limits{random.between(0.8, 3.0), random.between(0.05, 0.4), random.between(1.1, 2.5)};
    const std::vector<SharedFrustum> frusta = shared_frusta(lights, all_of(lights), limits);
    std::vector<std::uint32_t> members;
    for (const SharedFrustum& frustum : frusta) {
      EXPECT_TRUE(is_allowed(lights, frustum.members, limits)) << round;
      members.insert(members.end(), frustum.members.begin(), frustum.members.end());
      shared += frustum.members.size() > 1 ? 1 : 0;
    }
    std::ranges::sort(members);
    EXPECT_EQ(members, all_of(lights));
    std::vector<std::vector<std::uint32_t>> groups;
    const std::size_t best = fewest(lights, limits, 0, groups);
    EXPECT_GE(frusta.size(), best);
    EXPECT_LE(frusta.size(), best + 1) << round;
    best_found += frusta.size() == best ? 1 : 0;
  }
  EXPECT_GT(shared, k_rounds / 2);
  EXPECT_GE(best_found, k_rounds * 8 / 10);
  RecordProperty("best_found", best_found);
}

TEST(SharedFrusta, many_lights_are_grouped_as_those_of_each_place_by_themselves) {
  SplitMix64 random(9);
  std::vector<scene::WorldLight> lights;
  std::size_t apart = 0;
  for (int car = 0; car < 300; ++car) {
    const Vec3d at(20.0 * (car % 20), 0.0, 20.0 * (car / 20)), heading = within(random, 1.0);
    std::vector<scene::WorldLight> here;
    for (int i = 0; i < 4; ++i)
      here.push_back(spot(at + within(random, 1.0), heading + within(random, 0.1), 0.3, 20.0));
    apart += shared_frusta(here, all_of(here), {}).size();
    lights.insert(lights.end(), here.begin(), here.end());
  }
  EXPECT_EQ(shared_frusta(lights, all_of(lights), {}).size(), apart);
}

}  // namespace
}  // namespace clusterbench::measure
