// Lights of texels against loops over all lights and texels, and sizes against sets that are written down.

#include "measure/light_maps/light_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "core/error.h"
#include "core/random.h"
#include "measure/light_maps/unwrap.h"
#include "needs.h"
#include "scene/mesh_fixture.h"

namespace clusterbench::measure {
namespace {

using Json = nlohmann::json;
using scene::Vec2f;
using scene::test::LoadedGeometry;
using scene::test::MeshFile;

// A square of 10 m on the ground, whose texture coordinates are those of a picture laid on it.
const std::vector<Vec3f> k_ground = {{0, 0, 0}, {0, 0, 10}, {10, 0, 0}, {10, 0, 10}};
const std::vector<Vec2f> k_ground_uvs = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};

Json strip_of(MeshFile& file, const std::vector<Vec3f>& corners, const std::vector<Vec2f>& uvs) {
  Json out = {{"mode", 5}, {"attributes", {{"POSITION", file.positions(corners)}}}};
  if (!uvs.empty()) out["attributes"]["TEXCOORD_0"] = file.uvs(uvs);
  return out;
}

void put_light(MeshFile& file, const Json& light, const Json& node) {
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  Json& lights = file.json["extensions"]["KHR_lights_punctual"]["lights"];
  lights.push_back(light);
  Json of = node;
  of["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
  file.node(of);
}
void put_point(MeshFile& file, const Vec3d& at, double range_m) {
  put_light(file, {{"type", "point"}, {"range", range_m}}, {{"translation", {at.x, at.y, at.z}}});
}

LoadedGeometry loaded_with_uvs(const MeshFile& file) {
  LoadedGeometry out = scene::test::loaded_geometry(file.text(), scene::GeometryParts::positions_and_uvs);
  scene::resolve_ranges(out.scene, {});
  return out;
}

LightMaps maps_of(const MeshFile& file, const LightMapRequest& request) {
  const LoadedGeometry from = loaded_with_uvs(file);
  return measure_light_maps(from.scene, from.geometry, request);
}

LightMapRequest of_resolution(int width, int height) {
  LightMapRequest request;
  request.resolution = {width, height};
  return request;
}

TEST(LightMap, a_point_light_over_the_ground_lights_the_texels_of_a_circle) {
  MeshFile file;
  file.node({{"mesh", file.mesh(strip_of(file, k_ground, k_ground_uvs))}});
  put_point(file, {5, 3, 5}, 5);
  const LightMaps maps = maps_of(file, of_resolution(100, 100));
  // Centres are 0.05 m off a lattice of 0.1 m: in units of 0.05 m all is whole.
  std::uint64_t lit = 0;
  for (int x = 1; x < 200; x += 2)
    for (int z = 1; z < 200; z += 2)
      lit += (x - 100) * (x - 100) + (z - 100) * (z - 100) + 60 * 60 <= 100 * 100 ? 1 : 0;
  EXPECT_EQ(maps.all.lit, lit);
  EXPECT_NEAR(static_cast<double>(lit), 3.14159265 * 40.0 * 40.0, 60.0);
  EXPECT_EQ(maps.all.texels, 10'000U);
  EXPECT_EQ(maps.all.dead(), 0U);
  EXPECT_EQ(maps.all.pairs, lit);
  EXPECT_EQ(maps.all.sets, 2U);
  ASSERT_EQ(maps.maps.size(), 1U);
  EXPECT_EQ(maps.maps[0].lights, 1U);
  EXPECT_NEAR(maps.maps[0].area_m2, 100.0, 1e-9);
  EXPECT_EQ(maps.all.bytes.bits_of_all, 40'000U);
}

TEST(LightMap, a_spot_lights_what_its_cone_meets) {
  MeshFile file;
  file.node({{"mesh", file.mesh(strip_of(file, k_ground, k_ground_uvs))}});
  const double half_angle = std::atan(0.5);  // a circle of 2 m on the ground, 4 m below
  const double turn = std::sqrt(0.5);
  put_light(file, {{"type", "spot"}, {"range", 100}, {"spot", {{"outerConeAngle", half_angle}}}},
            {{"translation", {5, 4, 5}}, {"rotation", {-turn, 0, 0, turn}}});
  const LightMaps maps = maps_of(file, of_resolution(100, 100));
  std::uint64_t lit = 0;
  for (int x = 1; x < 200; x += 2)
    for (int z = 1; z < 200; z += 2) lit += (x - 100) * (x - 100) + (z - 100) * (z - 100) < 40 * 40 ? 1 : 0;
  EXPECT_EQ(maps.all.lit, lit);
  EXPECT_EQ(maps.all.left[static_cast<std::size_t>(TexelTest::range)], 10'000U);
  EXPECT_EQ(maps.spots, 1U);
}

TEST(LightMap, facing_leaves_out_lights_behind_and_in_the_plane_of_a_surface) {
  const auto lit = [](double height, bool double_sided, bool facing, bool mirrored) {
    MeshFile file;
    Json of = strip_of(file, k_ground, k_ground_uvs);
    if (double_sided) of["material"] = file.material({{"doubleSided", true}});
    Json node = {{"mesh", file.mesh(of)}};
    if (mirrored) node["scale"] = {-1, 1, 1};
    file.node(node);
    put_point(file, {0.3, height, 5}, 50);
    LightMapRequest request = of_resolution(8, 8);
    request.facing = facing;
    return maps_of(file, request).all.lit;
  };
  EXPECT_EQ(lit(1, false, true, false), 64U);
  EXPECT_EQ(lit(1, false, true, true), 64U);
  EXPECT_EQ(lit(-1, false, true, false), 0U);
  EXPECT_EQ(lit(-1, false, true, true), 0U);
  EXPECT_EQ(lit(-1, true, true, false), 64U);
  EXPECT_EQ(lit(0, false, true, false), 0U);
  EXPECT_EQ(lit(0, true, true, false), 0U);
  EXPECT_EQ(lit(-1, false, false, false), 64U);
}

TEST(LightMap, a_wall_hides_a_light_and_one_that_moves_does_not) {
  NEEDS(embree);
  const auto lit = [](bool moves, double lamp_radius_m) {
    MeshFile file;
    file.node({{"mesh", file.mesh(strip_of(file, k_ground, k_ground_uvs))}});
    // From x = 5 on nothing sees the light: the wall stands there, higher than it.
    file.node({{"mesh", file.mesh(strip_of(file, {{5, 0, -50}, {5, 0, 50}, {5, 9, -50}, {5, 9, 50}}, {}))}});
    put_point(file, {4, 2, 5}, 50);
    if (moves) {
      file.json["animations"] =
          Json::parse(R"([{"channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}],
                                                 "samplers": [{}]}])");
      const std::size_t times = file.accessor(scene::test::bytes_of(std::vector<float>{0, 1}), 5126, "SCALAR", 2);
      file.json["accessors"][times]["min"] = Json::array({0});
      file.json["accessors"][times]["max"] = Json::array({1});
      Json& sampler = file.json["animations"][0]["samplers"][0];
      sampler["input"] = times;
      sampler["output"] = file.positions({{0, 0, 0}, {1, 0, 0}});
    }
    LightMapRequest request = of_resolution(40, 40);
    request.visibility = true;
    request.lamp_radius_m = lamp_radius_m;
    return maps_of(file, request);
  };
  const LightMaps hidden = lit(false, 0.0);
  EXPECT_EQ(hidden.all.lit, 40U * 20U);
  EXPECT_EQ(hidden.all.left[static_cast<std::size_t>(TexelTest::cone)], 1600U);
  ASSERT_EQ(hidden.left_out.size(), 1U);
  EXPECT_EQ(hidden.left_out[0].reason, "has no texture coordinates");
  EXPECT_GT(lit(false, 1.5).all.lit, 40U * 20U);  // where rays reach the wall late
  const LightMaps moved = lit(true, 0.0);
  EXPECT_EQ(moved.all.lit, 1600U);
  ASSERT_EQ(moved.left_out.size(), 1U);
  EXPECT_EQ(moved.left_out[0].reason, "moves");
}

TEST(LightMap, surfaces_that_share_texels_have_the_lights_of_all_of_them_and_are_told) {
  MeshFile file;
  const std::vector<Vec3f> far = {{100, 0, 0}, {100, 0, 10}, {110, 0, 0}, {110, 0, 10}};
  file.mesh(strip_of(file, k_ground, k_ground_uvs));
  file.json["meshes"][0]["primitives"].push_back(strip_of(file, far, k_ground_uvs));
  file.node({{"mesh", 0}});
  put_point(file, {5, 1, 5}, 20);
  put_point(file, {105, 1, 5}, 20);
  const LightMaps maps = maps_of(file, of_resolution(16, 16));
  EXPECT_EQ(maps.all.overlapping, 256U);
  EXPECT_EQ(maps.all.pairs, 512U);
  EXPECT_EQ(maps.all.lit, 256U);
}

// Triangles anywhere, with texture coordinates anywhere, point and spot lights anywhere.
LoadedGeometry random_scene(std::uint64_t seed, bool double_sided) {
  SplitMix64 random(seed);
  MeshFile file;
  const auto anywhere = [&](double reach) {
    Vec3d at;
    for (int axis = 0; axis < 3; ++axis) at[axis] = random.between(-reach, reach);
    return at;
  };
  std::vector<Vec3f> corners;
  std::vector<Vec2f> uvs;
  for (int i = 0; i < 20; ++i) {
    const Vec3d middle = anywhere(10.0);
    for (int k = 0; k < 3; ++k) {
      corners.emplace_back(middle + anywhere(5.0));
      const double u = random.between(-0.2, 1.2), v = random.between(-0.2, 1.2);
      uvs.emplace_back(static_cast<float>(u), static_cast<float>(v));
    }
  }
  Json of = strip_of(file, corners, uvs);
  of.erase("mode");
  of["material"] = file.material({{"doubleSided", double_sided}});
  file.node({{"mesh", file.mesh(of)}, {"translation", {1, 2, 3}}, {"scale", {1, -2, 1}}});
  for (int i = 0; i < 12; ++i) {
    const Vec3d at = anywhere(15.0), axis = glm::normalize(anywhere(1.0));
    if (i % 3 == 2)
      put_light(file, {{"type", "spot"}, {"range", 12}, {"spot", {{"outerConeAngle", 0.7}}}},
                {{"translation", {at.x, at.y, at.z}}, {"rotation", {axis.x, axis.y, axis.z, 0.0}}});
    else
      put_point(file, at, random.between(3.0, 12.0));
  }
  return loaded_with_uvs(file);
}

// By the straight line between them; nothing is said where it goes by an edge, or where a surface is met at an end.
enum class Sight : std::uint8_t { free, hidden, uncertain };
Sight sight_by_loop(const MapMesh& mesh, std::uint32_t own, const Vec3d& from, const Vec3d& to) {
  Sight out = Sight::free;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t].corners;
    const Vec3d along = to - from, p = glm::cross(along, c - a), q = glm::cross(from - a, b - a);
    const double det = glm::dot(b - a, p);
    const double u = glm::dot(from - a, p) / det, v = glm::dot(along, q) / det, at = glm::dot(c - a, q) / det;
    if (t == own) continue;
    const double margin = std::min({u, v, 1.0 - u - v, at, 1.0 - at});
    if (std::abs(margin) < 2e-3) return Sight::uncertain;
    if (margin > 0.0) out = Sight::hidden;
  }
  return out;
}

TEST(LightMap, the_lights_of_every_texel_are_those_of_a_loop_over_all_lights) {
  NEEDS(embree);
  std::uint64_t pairs = 0, hidden = 0, behind = 0, uncertain = 0;
  for (const bool double_sided : {false, true})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const LoadedGeometry from = random_scene(seed, double_sided);
      const StaticMeshes meshes = static_meshes(from.scene, from.geometry, true);
      ASSERT_EQ(meshes.meshes.size(), 1U);
      const MapMesh& mesh = meshes.meshes[0];
      const TexelCover cover =
          cover_texels(mesh.uvs, {40, 24}, seed % 2 == 0 ? TexelCoverage::conservative : TexelCoverage::centres);
      const std::vector<scene::WorldLight> lights = world_lights(from.scene, 0.0);
      depth::RayCaster shadows(from.scene, from.geometry);
      shadows.pose(0.0, Vec3d(0.0));
      TexelTests tests;
      tests.facing = true;
      tests.shadows = &shadows;
      const TexelLights found = texel_lights(mesh, cover, lights, tests, 1);
      for (std::size_t texel = 0; texel < cover.grid.count(); ++texel)
        for (std::uint32_t light = 0; light < lights.size(); ++light) {
          bool wanted = false, is_certain = true;
          for (const TexelSample& sample : cover.of(texel)) {
            const auto& [a, b, c] = mesh.triangles[sample.triangle].corners;
            const Vec3d at = (1.0 - sample.weight_b - sample.weight_c) * a + sample.weight_b * b + sample.weight_c * c;
            const Vec3d way = lights[light].position - at, normal = glm::normalize(glm::cross(b - a, c - a));
            bool reached = glm::length(way) <= lights[light].range_m;
            if (lights[light].type == scene::LightType::spot)
              reached &= glm::dot(-way, lights[light].direction) >= std::cos(0.7) * glm::length(way);
            if (!reached) continue;
            const double facing = glm::dot(normal, way);
            is_certain &= std::abs(facing) > 1e-6 && std::abs(glm::length(way) - lights[light].range_m) > 1e-6;
            if (!double_sided && facing <= 0.0) {
              ++behind;
              continue;
            }
            const Sight sight = sight_by_loop(mesh, sample.triangle, at, lights[light].position);
            is_certain &= sight != Sight::uncertain;
            hidden += sight == Sight::hidden ? 1 : 0;
            wanted |= sight == Sight::free;
          }
          uncertain += is_certain ? 0 : 1;
          if (!is_certain) continue;
          const auto of = found.of(texel);
          EXPECT_EQ(std::ranges::count(of, light), wanted ? 1 : 0)
              << double_sided << " " << seed << " " << texel << " " << light;
          pairs += wanted ? 1 : 0;
        }
      for (std::size_t texel = 0; texel < cover.grid.count(); ++texel)
        EXPECT_TRUE(std::ranges::is_sorted(found.of(texel)));
      EXPECT_EQ(found.left[3], found.lights.size());
      for (const int threads : {2, 5}) {
        const TexelLights again = texel_lights(mesh, cover, lights, tests, threads);
        EXPECT_EQ(again.begin, found.begin);
        EXPECT_EQ(again.lights, found.lights);
        EXPECT_EQ(again.left, found.left);
      }
    }
  EXPECT_GT(pairs, 5000U);
  EXPECT_GT(hidden, 1000U);
  EXPECT_GT(behind, 1000U);
  EXPECT_LT(uncertain, pairs / 2);
}

// The sets of a map of 4 x 4 texels, of which the last row is dead.
TEST(LightMap, sizes_are_those_of_the_sets) {
  const std::vector<UvTriangle> triangles{{Vec2f(0, 0), Vec2f(1, 0), Vec2f(1, 0.75f)},
                                          {Vec2f(0, 0), Vec2f(1, 0.75f), Vec2f(0, 0.75f)}};
  const TexelCover cover = cover_texels(triangles, {4, 4}, TexelCoverage::centres);
  ASSERT_EQ(cover.covered, 12U);
  const std::vector<std::vector<std::uint32_t>> sets{{0}, {0},     {39}, {},    //
                                                     {0}, {0, 39}, {39}, {},    //
                                                     {},  {},      {39}, {39},  //
                                                     {},  {},      {},   {}};
  TexelLights lights;
  lights.begin = {0};
  for (const std::vector<std::uint32_t>& set : sets) {
    lights.lights.insert(lights.lights.end(), set.begin(), set.end());
    lights.begin.push_back(lights.lights.size());
  }
  const LightMapCounts counts = count_light_map(cover, lights, 40, 2);
  EXPECT_EQ(counts.texels, 16U);
  EXPECT_EQ(counts.dead(), 4U);
  EXPECT_EQ(counts.lit, 8U);
  EXPECT_EQ(counts.pairs, 9U);
  EXPECT_EQ(counts.histogram, (std::vector<std::uint64_t>{4, 7, 1}));
  EXPECT_EQ(counts.sets, 4U);
  // Unions: {0, 39} of four covered texels, {39} of four; {} of two, {39} of two.
  EXPECT_EQ(counts.tiles, 4U);
  EXPECT_EQ(counts.tile_pairs, 4U);
  EXPECT_EQ(counts.tile_evaluated, 8U + 4U + 0U + 2U);
  EXPECT_EQ(counts.tile_false_positives(), 5U);
  EXPECT_EQ(counts.bytes.bits_of_all, 16U * 8U);  // 40 lights: two words
  EXPECT_EQ(counts.bytes.bits_of_own, 16U * 4U);  // two lights: one
  EXPECT_EQ(counts.bytes.lists_8, 17U * 4U + 9U);
  EXPECT_EQ(counts.bytes.lists_16, 17U * 4U + 18U);
  EXPECT_EQ(counts.bytes.palette, 16U + 4U * 4U);
  EXPECT_EQ(counts.bytes.tiles, 4U * 4U);
  LightMapCounts twice = counts;
  twice.add(counts);
  EXPECT_EQ(twice.pairs, 18U);
  EXPECT_EQ(twice.histogram, (std::vector<std::uint64_t>{8, 14, 2}));
  EXPECT_EQ(twice.bytes.lists_8, 2U * (17U * 4U + 9U));
}

TEST(LightMap, as_many_texels_per_metre_as_asked_for_lie_on_a_mesh) {
  MeshFile file;
  const std::vector<Vec2f> half = {{0, 0}, {0, 0.5f}, {0.5f, 0}, {0.5f, 0.5f}};
  file.node({{"mesh", file.mesh(strip_of(file, k_ground, half))}, {"scale", {2, 1, 2}}});
  LightMapRequest request;
  request.texels_per_metre = 3.0;
  const LightMaps maps = maps_of(file, request);
  ASSERT_EQ(maps.maps.size(), 1U);
  EXPECT_EQ(maps.maps[0].grid.width, 120);  // 20 m on half of the map
  EXPECT_EQ(maps.all.covered, 3600U);
  EXPECT_EQ(maps.all.dead(), 3U * 3600U);
  request.texels_per_metre = 1000.0;
  EXPECT_THROW(maps_of(file, request), Error);
}

TEST(LightMap, what_has_no_map_is_told_with_the_reason) {
  MeshFile file;
  const Json ground = strip_of(file, k_ground, k_ground_uvs);
  file.node({{"name", "hidden"},
             {"mesh", file.mesh(ground)},
             {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
  file.node({{"name", "line"}, {"mesh", file.mesh(strip_of(file, k_ground, {4, {0.5f, 0.5f}}))}});
  file.mesh(ground);
  file.json["meshes"].back()["primitives"].push_back(strip_of(file, k_ground, {}));
  file.node({{"mesh", file.json["meshes"].size() - 1}});
  put_light(file, {{"type", "directional"}}, Json::object());
  const LightMaps maps = maps_of(file, of_resolution(4, 4));
  EXPECT_EQ(maps.maps.size(), 1U);
  EXPECT_EQ(maps.directional, 1U);
  std::set<std::string> told;
  for (const LeftOut& mesh : maps.left_out) told.insert(mesh.name + " " + mesh.reason);
  EXPECT_EQ(told, (std::set<std::string>{"hidden is not shown at time 0", "line has texture coordinates without area",
                                         "node 2 2 triangles without texture coordinates"}));
}

// A box and a slanted square: seven faces, whose texels are as many as their areas have and lie as far apart.
TEST(Unwrap, faces_lie_flat_side_by_side_at_one_scale) {
  MapMesh mesh;
  const auto add_square = [&](const Vec3d& from, const Vec3d& along, const Vec3d& up) {
    mesh.triangles.push_back({{from, from + along, from + along + up}, false});
    mesh.triangles.push_back({{from, from + along + up, from + up}, false});
  };
  const Vec3d x(4, 0, 0), y(0, 2, 0), z(0, 0, 3);
  add_square({0, 0, 0}, z, y);
  add_square(x, y, z);
  add_square({0, 0, 0}, x, z);
  add_square(y, z, x);
  add_square({0, 0, 0}, y, x);
  add_square(z, x, y);
  add_square({20, 0, 0}, {3, 4, 0}, {0, 0, 6});
  const double scale = 7.0, area = 2.0 * (8.0 + 12.0 + 6.0) + 30.0;
  const Unwrapped made = unwrapped(mesh, scale);
  const TexelCover cover = cover_texels(made.uvs, made.grid, TexelCoverage::centres);
  EXPECT_EQ(cover.overlapping, 0U);
  EXPECT_EQ(cover.wrapped_triangles, 0U);
  EXPECT_NEAR(static_cast<double>(cover.covered), area * scale * scale, 1.0);
  const auto place = [&](const TexelSample& sample) {
    const auto& [a, b, c] = mesh.triangles[sample.triangle].corners;
    return a + sample.weight_b * (b - a) + sample.weight_c * (c - a);
  };
  std::size_t neighbours = 0;
  for (std::size_t texel = 0; texel + 1 < cover.grid.count(); ++texel) {
    if (cover.of(texel).empty() || cover.of(texel + 1).empty()) continue;
    const TexelSample &left = cover.of(texel)[0], &right = cover.of(texel + 1)[0];
    EXPECT_EQ(left.triangle / 2, right.triangle / 2) << "no dead texel between two faces";
    EXPECT_NEAR(glm::length(place(right) - place(left)), 1.0 / scale, 1e-3);
    ++neighbours;
  }
  EXPECT_GT(neighbours, 3000U);
  EXPECT_LT(static_cast<double>(cover.grid.count()), 1.7 * area * scale * scale);
}

TEST(Unwrap, a_map_without_texture_coordinates_is_made_and_one_too_large_refused) {
  MeshFile file;
  file.node({{"mesh", file.mesh(strip_of(file, k_ground, {}))}});
  put_point(file, {5, 3, 5}, 5);
  LightMapRequest request;
  request.unwrap = true;
  request.texels_per_metre = 10.0;
  const LightMaps maps = maps_of(file, request);
  EXPECT_EQ(maps.all.covered, 10'000U);
  EXPECT_NEAR(static_cast<double>(maps.all.lit), 3.14159265 * 40.0 * 40.0, 60.0);
  EXPECT_EQ(maps.maps.at(0).uv_set, -1);
  request.texels_per_metre = 2000.0;
  EXPECT_THROW(maps_of(file, request), Error);
}

}  // namespace
}  // namespace clusterbench::measure
