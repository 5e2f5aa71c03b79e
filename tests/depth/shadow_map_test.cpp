// Shadow maps against a loop over all triangles in double precision, by rays between points of bodies and the light.

#include "depth/shadow_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "scene/mesh_fixture.h"

namespace clusterbench::depth {
namespace {

using scene::test::LoadedGeometry;
using scene::test::MeshFile;

constexpr double k_far = std::numeric_limits<double>::infinity();

// Three corners each; seen from both sides unless it is said otherwise.
LoadedGeometry loaded(const std::vector<Vec3f>& corners, bool double_sided = true) {
  MeshFile file;
  nlohmann::json primitive = {{"attributes", {{"POSITION", file.positions(corners)}}}};
  primitive["material"] = file.material({{"doubleSided", double_sided}});
  const std::size_t mesh = file.mesh(primitive);
  file.node({{"mesh", mesh}});
  return scene::test::loaded_geometry(file.text());
}

void add_quad(std::vector<Vec3f>& corners, const Vec3f& from, const Vec3f& along, const Vec3f& up) {
  corners.insert(corners.end(), {from, from + along, from + along + up, from, from + along + up, from + up});
}

struct Caster {
  LoadedGeometry scene;
  RayCaster caster;

  explicit Caster(const std::vector<Vec3f>& corners, bool double_sided = true)
      : scene(loaded(corners, double_sided)), caster(scene.scene, scene.geometry) {
    caster.pose(0.0, Vec3d(0.0));
  }
};

ShadowMap map_of(const Caster& from, const scene::WorldLight& light, const ShadowMapRequest& request) {
  ShadowMap map(from.caster, light, request);
  map.reduce();
  return map;
}

scene::WorldLight point_at(const Vec3d& position, double range_m = 1000.0) {
  scene::WorldLight light;
  light.position = position;
  light.range_m = range_m;
  return light;
}

scene::WorldLight spot_at(const Vec3d& position, const Vec3d& direction, double half_angle_rad) {
  scene::WorldLight light = point_at(position);
  light.type = scene::LightType::spot;
  light.direction = glm::normalize(direction);
  light.outer_cone_rad = half_angle_rad;
  return light;
}

struct Body {
  Vec3d lo, hi;

  Vec3d at(SplitMix64& random) const {
    Vec3d p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = random.between(lo[axis], hi[axis]);
    return p;
  }
};

bool is_hidden(const ShadowMap& map, const scene::WorldLight& light, const Body& body, double bias_m = 0.0) {
  std::array<Vec3d, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = Vec3d((i & 1) != 0 ? body.hi.x : body.lo.x, (i & 2) != 0 ? body.hi.y : body.lo.y,
                       (i & 4) != 0 ? body.hi.z : body.lo.z) -
                 light.position;
  const Vec3d apart = glm::max(glm::max(body.lo - light.position, light.position - body.hi), Vec3d(0.0));
  return map.hides(corners, glm::length(apart) * (1.0 - 1e-12), bias_m);
}

// Moller and Trumbore 1997. A point that this finds lit is so by no narrow margin: rays beside an edge are not looked
// at.
enum class Light { reaches, blocked, unsure };
Light seen_from(const scene::WorldLight& light, const Vec3d& point, const std::vector<Vec3f>& corners, double near_m) {
  const Vec3d way = point - light.position;
  if (light.type == scene::LightType::spot &&
      glm::dot(way, light.direction) <= std::cos(light.outer_cone_rad) * glm::length(way) + 1e-9)
    return Light::unsure;
  Light found = Light::reaches;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Vec3d a(corners[i]), ab = Vec3d(corners[i + 1]) - a, ac = Vec3d(corners[i + 2]) - a;
    const Vec3d p = glm::cross(way, ac);
    const double det = glm::dot(ab, p);
    if (det == 0.0) return Light::unsure;
    const Vec3d to = light.position - a, q = glm::cross(to, ab);
    const double u = glm::dot(to, p) / det, v = glm::dot(way, q) / det, t = glm::dot(ac, q) / det;
    const double margin = std::min({u, v, 1.0 - u - v}), before = t * glm::length(way);
    if (margin < -1e-4 || before < near_m || t > 1.0) continue;
    if (margin < 1e-4 || t > 1.0 - 1e-6) return Light::unsure;
    found = Light::blocked;
  }
  return found;
}

std::vector<Vec3f> soup(std::uint64_t seed, int triangles) {
  SplitMix64 random(seed);
  std::vector<Vec3f> corners;
  for (int i = 0; i < triangles; ++i) {
    const Body room{Vec3d(-6.0), Vec3d(6.0)}, around{Vec3d(-4.0), Vec3d(4.0)};
    const Vec3d middle = room.at(random);
    for (int k = 0; k < 3; ++k) corners.emplace_back(middle + around.at(random));
  }
  return corners;
}

// A room of 6 m around the origin: six walls of two triangles, seen from inside.
std::vector<Vec3f> room() {
  std::vector<Vec3f> corners;
  const float r = 3.0f;
  add_quad(corners, {-r, -r, -r}, {2 * r, 0, 0}, {0, 2 * r, 0});
  add_quad(corners, {r, -r, r}, {-2 * r, 0, 0}, {0, 2 * r, 0});
  add_quad(corners, {-r, -r, r}, {0, 0, -2 * r}, {0, 2 * r, 0});
  add_quad(corners, {r, -r, -r}, {0, 0, 2 * r}, {0, 2 * r, 0});
  add_quad(corners, {-r, -r, r}, {2 * r, 0, 0}, {0, 0, -2 * r});
  add_quad(corners, {-r, r, -r}, {2 * r, 0, 0}, {0, 0, 2 * r});
  return corners;
}

// Four strips around a hole of 2 m by 2 m at (2, 0, -5), in a wall of 40 m.
std::vector<Vec3f> wall_with_window() {
  std::vector<Vec3f> corners;
  add_quad(corners, {-20, -20, -5}, {21, 0, 0}, {0, 40, 0});
  add_quad(corners, {3, -20, -5}, {17, 0, 0}, {0, 40, 0});
  add_quad(corners, {1, -20, -5}, {2, 0, 0}, {0, 19, 0});
  add_quad(corners, {1, 1, -5}, {2, 0, 0}, {0, 19, 0});
  return corners;
}

class BothBounds : public testing::TestWithParam<TexelBound> {};
INSTANTIATE_TEST_SUITE_P(ShadowMap, BothBounds, testing::Values(TexelBound::proven, TexelBound::sampled),
                         [](const auto& of) { return std::string(name_of(of.param)); });

TEST_P(BothBounds, hide_what_is_behind_a_wall_and_not_what_is_behind_its_window) {
  const Caster caster(wall_with_window());
  for (const scene::WorldLight& light : {point_at({0, 0, 0}), spot_at({0, 0, 0}, {0, 0, -1}, 0.9)}) {
    const ShadowMap map = map_of(caster, light, {64, GetParam(), 0.01});
    EXPECT_TRUE(is_hidden(map, light, {{-5, -1, -10}, {-3, 1, -8}}));
    EXPECT_FALSE(is_hidden(map, light, {{3.5, -0.5, -10}, {4.5, 0.5, -8}})) << "behind the window";
    EXPECT_FALSE(is_hidden(map, light, {{-5, -1, -4}, {-3, 1, -3}})) << "before the wall";
    EXPECT_FALSE(is_hidden(map, light, {{-5, -1, -10}, {-3, 1, -4}})) << "through the wall";
    EXPECT_FALSE(is_hidden(map, light, {{-1, -1, -1}, {1, 1, 1}})) << "around the light";
  }
}

TEST_P(BothBounds, a_light_in_a_closed_room_lights_nothing_outside) {
  const Caster caster(room(), false);
  SplitMix64 random(1);
  for (const int resolution : {4, 7, 32}) {
    const scene::WorldLight light = point_at({0.7, -0.4, 1.1});
    const ShadowMap map = map_of(caster, light, {resolution, GetParam(), 0.01});
    EXPECT_EQ(map.texel_counts().unlimited, 0u) << resolution;
    EXPECT_EQ(map.texel_counts().texels, 6u * static_cast<unsigned>(resolution * resolution));
    int hidden = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec3d away = glm::normalize(Body{Vec3d(-1.0), Vec3d(1.0)}.at(random));
      const Vec3d middle = random.between(9.0, 40.0) * away, size(random.between(0.1, 1.0));
      hidden += is_hidden(map, light, {middle - size, middle + size}) ? 1 : 0;
    }
    EXPECT_EQ(hidden, 500) << resolution;
  }
}

TEST(ShadowMap, a_single_sided_wall_casts_no_shadow_of_its_back) {
  const Caster inward(room(), false);
  const scene::WorldLight light = point_at({10, 0, 0});
  const ShadowMap map = map_of(inward, light, {32, TexelBound::proven, 0.01});
  EXPECT_FALSE(is_hidden(map, light, {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}})) << "inside";
  EXPECT_TRUE(is_hidden(map, light, {{-9.5, -0.5, -0.5}, {-8.5, 0.5, 0.5}})) << "behind the wall that faces the light";
}

TEST(ShadowMap, what_is_nearer_than_near_casts_no_shadow) {
  std::vector<Vec3f> shade;
  add_quad(shade, {-1, -1, -0.2f}, {2, 0, 0}, {0, 2, 0});
  const Caster caster(shade);
  const scene::WorldLight light = point_at({0, 0, 0});
  const Body below{{-0.5, -0.5, -6}, {0.5, 0.5, -5}};
  for (const TexelBound bound : {TexelBound::proven, TexelBound::sampled}) {
    EXPECT_TRUE(is_hidden(map_of(caster, light, {32, bound, 0.1}), light, below));
    EXPECT_FALSE(is_hidden(map_of(caster, light, {32, bound, 0.3}), light, below));
  }
}

TEST(ShadowMap, a_proven_texel_has_the_greatest_distance_of_a_plane_that_covers_it) {
  std::vector<Vec3f> plane;
  add_quad(plane, {-400, -400, -5}, {800, 0, 0}, {0, 800, 0});
  const Caster caster(plane);
  const scene::WorldLight light = spot_at({0.3, 0.1, 0}, {0, 0, -1}, std::atan(1.0));
  const ShadowMap map = map_of(caster, light, {16, TexelBound::proven, 0.01});
  // The face's axes follow the light's alone: of texels in a ring all four turns are the same.
  const double slope = 2.0 / 8.0, corner = 5.0 * std::sqrt(1.0 + 2.0 * slope * slope);
  for (const int x : {6, 9})
    for (const int y : {6, 9}) EXPECT_NEAR(static_cast<double>(map.texel(0, x, y)), corner, 1e-4);
  EXPECT_EQ(map.texel(0, 0, 0), 0.0f) << "beside the cone";
  EXPECT_EQ(map.texel_counts().unlimited, 0u);
}

// Bodies that a map hides although a ray from one of their points reaches the light.
struct Exceptions {
  int hidden = 0, wrong = 0;
};
Exceptions exceptions(TexelBound bound, int resolution) {
  Exceptions found;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const std::vector<Vec3f> corners = soup(seed, 60);
    const Caster caster(corners);
    SplitMix64 random(seed + 100);
    for (const double half_angle : {0.0, 0.4, 1.3}) {
      const Body around{Vec3d(-3.0), Vec3d(3.0)}, all{Vec3d(-12.0), Vec3d(12.0)};
      const Vec3d position = around.at(random), direction = glm::normalize(around.at(random));
      const scene::WorldLight light = half_angle > 0.0 ? spot_at(position, direction, half_angle) : point_at(position);
      const ShadowMap map = map_of(caster, light, {resolution, bound, 0.05});
      for (int i = 0; i < 150; ++i) {
        const Vec3d lo = all.at(random), hi = lo + random.between(0.2, 2.0);
        const Body body{lo, hi};
        const bool hides = is_hidden(map, light, body, 1e-4);
        bool is_lit = false;
        for (int ray = 0; hides && ray < 400 && !is_lit; ++ray)
          is_lit = seen_from(light, body.at(random), corners, 0.05) == Light::reaches;
        found.hidden += hides ? 1 : 0;
        found.wrong += is_lit ? 1 : 0;
      }
    }
  }
  return found;
}

TEST(ShadowMap, proven_texels_hide_nothing_that_any_ray_reaches) {
  int least = 0;
  for (const int resolution : {4, 16, 64}) {
    const Exceptions found = exceptions(TexelBound::proven, resolution);
    EXPECT_EQ(found.wrong, 0) << resolution;
    EXPECT_GT(found.hidden, least) << resolution;
    least = found.hidden;
  }
}

TEST(ShadowMap, sampled_texels_hide_less_that_is_lit_the_finer_they_are) {
  const Exceptions coarse = exceptions(TexelBound::sampled, 4), middle = exceptions(TexelBound::sampled, 16),
                   fine = exceptions(TexelBound::sampled, 128);
  RecordProperty("wrong_4", coarse.wrong);
  RecordProperty("wrong_16", middle.wrong);
  RecordProperty("wrong_128", fine.wrong);
  EXPECT_GT(coarse.wrong, 0) << "or this test compares nothing";
  EXPECT_LT(middle.wrong, coarse.wrong);
  EXPECT_LE(fine.wrong, middle.wrong);
  EXPECT_GT(fine.hidden, coarse.hidden);
}

// A wall of 12 x 12 tiles, one of which is missing, over one texel: whichever it is, the texel has no distance.
TEST(ShadowMap, a_texel_with_more_triangles_than_it_casts_rays_is_unlimited) {
  constexpr int k_tiles = 12;
  for (int missing = -1; missing < k_tiles * k_tiles; missing += 13) {
    std::vector<Vec3f> corners;
    for (int tile = 0; tile < k_tiles * k_tiles; ++tile) {
      const Vec3f from(-6.0f + static_cast<float>(tile % k_tiles), -6.0f + static_cast<float>(tile / k_tiles), 5.0f);
      if (tile != missing) add_quad(corners, from, {1, 0, 0}, {0, 1, 0});
    }
    const Caster caster(corners);
    const ShadowMap map = map_of(caster, point_at({0, 0, 0}), {1, TexelBound::proven, 0.05});
    EXPECT_EQ(map.texel(4, 0, 0), static_cast<float>(k_far)) << missing;
  }
  // Of texels so small that few tiles are in each, all have one.
  std::vector<Vec3f> whole;
  for (int tile = 0; tile < k_tiles * k_tiles; ++tile)
    add_quad(whole, {-6.0f + static_cast<float>(tile % k_tiles), -6.0f + static_cast<float>(tile / k_tiles), 5.0f},
             {1, 0, 0}, {0, 1, 0});
  const Caster caster(whole);
  const ShadowMap map = map_of(caster, point_at({0, 0, 0}), {16, TexelBound::proven, 0.05});
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) EXPECT_LT(map.texel(4, x, y), 9.0f);
}

// To the left of the slope 0.2 the view along +z ends at a wall 5 m away, to the right at one 20 m away, with a third
// between them. What is before the farther one is not hidden, however many texels it covers and however few of them
// are beside the nearer one.
TEST(ShadowMap, coarser_levels_lose_no_distance) {
  std::vector<Vec3f> corners;
  add_quad(corners, {-50, -50, 5}, {51, 0, 0}, {0, 100, 0});
  add_quad(corners, {4, -50, 20}, {50, 0, 0}, {0, 100, 0});
  add_quad(corners, {1, -50, 5}, {3, 0, 15}, {0, 100, 0});
  const Caster caster(corners);
  const scene::WorldLight light = point_at({0, 0, 0});
  for (const int resolution : {37, 64}) {
    const ShadowMap map = map_of(caster, light, {resolution, TexelBound::proven, 0.05});
    for (const double left : {-6.0, -3.0, -1.0, 0.0, 1.0})
      for (const double right : {2.2, 2.5, 4.0, 8.0}) {
        EXPECT_FALSE(is_hidden(map, light, {{left, -0.3, 10.0}, {right, 0.3, 10.5}})) << left << " to " << right;
        EXPECT_TRUE(is_hidden(map, light, {{left, -0.3, 60.0}, {right, 0.3, 60.5}})) << left << " to " << right;
      }
    EXPECT_TRUE(is_hidden(map, light, {{-4.0, -0.3, 10.0}, {-3.5, 0.3, 10.5}}));
  }
}

}  // namespace
}  // namespace clusterbench::depth
