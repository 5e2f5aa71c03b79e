// Depth against a loop over all triangles in double precision.

#include "depth/ray_caster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/gtc/matrix_transform.hpp>

#include "core/random.h"
#include "scene/mesh_fixture.h"

namespace clusterbench::depth {
namespace {

using Json = nlohmann::json;
using scene::test::LoadedGeometry;
using scene::test::MeshFile;

constexpr double k_nothing = std::numeric_limits<double>::infinity();

std::vector<Vec3f> random_triangles(int count, std::uint64_t seed, double size) {
  SplitMix64 random(seed);
  std::vector<Vec3f> out;
  for (int i = 0; i < count; ++i) {
    const Vec3d middle(random.between(-8, 8), random.between(-5, 5), random.between(-20, -2));
    for (int k = 0; k < 3; ++k)
      out.emplace_back(middle +
                       Vec3d(random.between(-size, size), random.between(-size, size), random.between(-size, size)));
  }
  return out;
}

scene::Shot shot_of(bool orthographic) {
  scene::Shot shot;
  shot.pose = scene::camera_pose(glm::translate(Mat4d(1.0), Vec3d(0.5, -0.25, 1.0)));
  shot.projection.orthographic = orthographic;
  shot.projection.yfov_rad = 1.0;
  shot.projection.xmag_m = 6.0;
  shot.projection.ymag_m = 4.0;
  shot.projection.near_m = 2.5;
  shot.projection.far_m = 18.0;
  return shot;
}

// A triangle's corners in world space, in the order in which its front is seen counter-clockwise.
struct Placed {
  Vec3d a, b, c;
  bool blends, double_sided;
};

std::vector<Placed> placed(const LoadedGeometry& from, double time_s) {
  const std::vector<Mat4d> transforms = world_transforms(from.scene, time_s);
  std::vector<Placed> out;
  for (const scene::SurfaceInstance& instance : from.geometry.instances) {
    const scene::Surface& surface = from.geometry.surfaces[instance.surface];
    const Mat4d& world = transforms[static_cast<std::size_t>(instance.node)];
    const bool mirrored = glm::determinant(Mat3d(world)) < 0.0;
    for (const scene::Triangle& triangle : surface.triangles) {
      const auto at = [&](std::size_t k) { return Vec3d(world * Vec4d(Vec3d(surface.vertices[triangle[k]]), 1.0)); };
      out.push_back({at(0), mirrored ? at(2) : at(1), mirrored ? at(1) : at(2), surface.blends, surface.double_sided});
    }
  }
  return out;
}

// Moller and Trumbore 1997. How near the ray goes by an edge is told, too: there precisions may differ.
struct Crossing {
  double depth, margin;
  bool from_front;
};
std::optional<Crossing> crossing(const Placed& t, const Vec3d& from, const Vec3d& along) {
  const Vec3d ab = t.b - t.a, ac = t.c - t.a, p = glm::cross(along, ac);
  const double det = glm::dot(ab, p);
  if (det == 0.0) return std::nullopt;
  const Vec3d to = from - t.a, q = glm::cross(to, ab);
  const double u = glm::dot(to, p) / det, v = glm::dot(along, q) / det;
  return Crossing{glm::dot(ac, q) / det, std::min({u, v, 1.0 - u - v}), det > 0.0};
}

struct Ray {
  Vec3d from, along;
};
Ray ray_of(const view::Frame& frame, const Vec2d& pixel) {
  const view::Projection& p = frame.projection;
  const double across = p.left + (p.right - p.left) * pixel.x / frame.viewport.x;
  const double up = p.top - (p.top - p.bottom) * pixel.y / frame.viewport.y;
  const Mat3d turn = glm::transpose(frame.view_space.rotation);
  if (p.orthographic) return {frame.view_space.origin + turn * Vec3d(across, up, 0.0), turn * Vec3d(0, 0, -1)};
  return {frame.view_space.origin, turn * Vec3d(across, up, -1.0)};
}

// All depths between near and far, ascending; `is_sure` is false where a ray goes by an edge too closely to tell.
std::vector<double> depths_by_loop(const std::vector<Placed>& triangles, const Ray& ray, const view::Projection& p,
                                   bool blends, bool& is_sure) {
  std::vector<double> out;
  for (const Placed& triangle : triangles) {
    if (triangle.blends != blends) continue;
    const std::optional<Crossing> found = crossing(triangle, ray.from, ray.along);
    if (!found) continue;
    is_sure &= std::abs(found->margin) > 1e-5;
    if (found->margin < 0.0 || (!triangle.double_sided && !found->from_front)) continue;
    is_sure &= std::abs(found->depth - p.near_m) > 1e-5 && std::abs(found->depth - p.far_m) > 1e-5;
    if (found->depth >= p.near_m && found->depth <= p.far_m) out.push_back(found->depth);
  }
  std::ranges::sort(out);
  return out;
}

// Opaque and blending ones, seen from the front and from both sides, in a mirrored, a sheared and a scaled node.
LoadedGeometry soup() {
  MeshFile file;
  std::uint64_t seed = 0;
  for (const Json& transform :
       {Json{{"scale", {-1, 1, 1}}}, Json{{"rotation", {0, 0, 0.6, 0.8}}, {"scale", {1, 0.5, 1}}},
        Json{{"translation", {0, 1, 0}}}})
    for (const Json& material : {Json{{"name", "front"}}, Json{{"doubleSided", true}}, Json{{"alphaMode", "BLEND"}},
                                 Json{{"alphaMode", "BLEND"}, {"doubleSided", true}}}) {
      Json primitive = {{"attributes", {{"POSITION", file.positions(random_triangles(40, ++seed, 2.0))}}}};
      primitive["material"] = file.material(material);
      Json node = transform;
      node["mesh"] = file.mesh(primitive);
      file.node(node);
    }
  return scene::test::loaded_geometry(file.text());
}

class Pictures : public testing::TestWithParam<bool> {};

TEST_P(Pictures, have_the_depths_and_layers_that_a_loop_over_all_triangles_finds) {
  const LoadedGeometry from = soup();
  const view::Frame frame = view::make_frame(from.scene, shot_of(GetParam()), 0, {96, 60});
  RayCaster caster(from.scene, from.geometry);
  caster.pose(frame);
  const PixelGrid pixels(frame.viewport, 1);
  const DepthImage image = caster.depths(frame, pixels, 1);
  const LayerImage layers = caster.layers(frame, image, 3, 1);
  const std::vector<Placed> triangles = placed(from, 0.0);
  int sure = 0, hits = 0, layered = 0;
  for (std::size_t i = 0; i < pixels.count(); ++i) {
    const Ray ray = ray_of(frame, pixels.pixel(i));
    bool is_sure = true;
    const std::vector<double> opaque = depths_by_loop(triangles, ray, frame.projection, false, is_sure);
    std::vector<double> seen_through = depths_by_loop(triangles, ray, frame.projection, true, is_sure);
    if (!is_sure) continue;
    ++sure;
    const double nearest = opaque.empty() ? k_nothing : opaque.front();
    if (opaque.empty()) {
      EXPECT_EQ(image.nearest[i], k_nothing) << i;
    } else {
      ++hits;
      EXPECT_NEAR(image.nearest[i], nearest, 1e-4) << i;
    }
    std::erase_if(seen_through, [&](double depth) { return depth > nearest; });
    if (seen_through.size() > 3) seen_through.resize(3);
    ASSERT_EQ(layers.begin[i + 1] - layers.begin[i], seen_through.size()) << i;
    for (std::size_t k = 0; k < seen_through.size(); ++k)
      EXPECT_NEAR(layers.depths[layers.begin[i] + k], seen_through[k], 1e-4) << i;
    layered += seen_through.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(sure, 4500);
  EXPECT_GT(hits, 1500);
  EXPECT_GT(layered, 200);
}

INSTANTIATE_TEST_SUITE_P(RayCaster, Pictures, testing::Bool(),
                         [](const auto& test) { return test.param ? "orthographic" : "perspective"; });

TEST(RayCaster, pictures_are_the_same_on_any_number_of_threads) {
  const LoadedGeometry from = soup();
  const view::Frame frame = view::make_frame(from.scene, shot_of(false), 0, {97, 61});
  RayCaster caster(from.scene, from.geometry);
  caster.pose(frame);
  const DepthImage image = caster.depths(frame, PixelGrid(frame.viewport, 1), 1);
  const DepthImage four = caster.depths(frame, PixelGrid(frame.viewport, 1), 4);
  EXPECT_EQ(image.nearest, four.nearest);
  EXPECT_EQ(caster.layers(frame, image, 4, 1).depths, caster.layers(frame, image, 4, 4).depths);
}

// A wall of 4 m at z = -depth, seen from both sides.
std::size_t wall(MeshFile& file) {
  Json primitive = {{"attributes", {{"POSITION", file.positions({{-2, -2, 0}, {2, -2, 0}, {-2, 2, 0}, {2, 2, 0}})}}},
                    {"mode", 5}};
  primitive["material"] = file.material({{"doubleSided", true}});
  return file.mesh(primitive);
}

float depth_at_middle(const LoadedGeometry& from, RayCaster& caster, double time_s) {
  scene::Shot shot = shot_of(false);
  shot.pose = scene::camera_pose(Mat4d(1.0));
  shot.projection.near_m = 0.1;
  shot.projection.far_m = k_nothing;
  shot.time_s = time_s;
  const view::Frame frame = view::make_frame(from.scene, shot, 0, {8, 8});
  caster.pose(frame);
  return caster.depths(frame, PixelGrid(frame.viewport, 8), 1).nearest.at(0);
}

TEST(RayCaster, surfaces_move_with_their_nodes_and_hide_with_them) {
  MeshFile file;
  const std::size_t mesh = wall(file);
  file.node({{"mesh", mesh}, {"translation", {0, 0, -5}}});
  file.node(
      {{"mesh", mesh}, {"translation", {0, 0, -3}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
  const std::size_t times = file.accessor(scene::test::bytes_of(std::vector<float>{0, 1}), 5126, "SCALAR", 2);
  file.json["accessors"][times]["min"] = {0};
  file.json["accessors"][times]["max"] = {1};
  const std::size_t places = file.positions({{0, 0, -5}, {0, 0, -9}});
  file.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  const LoadedGeometry from = scene::test::loaded_geometry(file.text());
  RayCaster caster(from.scene, from.geometry);
  EXPECT_FLOAT_EQ(depth_at_middle(from, caster, 0.0), 5.0f);
  EXPECT_FLOAT_EQ(depth_at_middle(from, caster, 0.5), 7.0f);
  EXPECT_FLOAT_EQ(depth_at_middle(from, caster, 0.0), 5.0f);
}

// Single precision holds 1e7 m to the metre.
TEST(RayCaster, depths_far_from_the_worlds_origin_are_as_good_as_near_it) {
  MeshFile file;
  file.node({{"mesh", wall(file)}, {"translation", {1e7, 0, -5.125}}});
  const LoadedGeometry from = scene::test::loaded_geometry(file.text());
  scene::Shot shot = shot_of(false);
  shot.pose = scene::camera_pose(glm::translate(Mat4d(1.0), Vec3d(1e7 + 0.5, 0, 0)));
  const view::Frame frame = view::make_frame(from.scene, shot, 0, {8, 8});
  RayCaster caster(from.scene, from.geometry);
  caster.pose(frame);
  EXPECT_FLOAT_EQ(caster.depths(frame, PixelGrid(frame.viewport, 8), 1).nearest.at(0), 5.125f);
}

// Whatever was cast before it; on a path images are cast again, now these, now those.
TEST(RayCaster, a_frame_has_the_same_depths_whichever_came_before_it) {
  const LoadedGeometry from = soup();
  const auto frame_at = [&](double x) {
    scene::Shot shot = shot_of(false);
    shot.pose = scene::camera_pose(glm::translate(Mat4d(1.0), Vec3d(x, 0.1, 0.2)));
    return view::make_frame(from.scene, shot, 0, {97, 61});
  };
  const auto depths = [](RayCaster& caster, const view::Frame& frame) {
    caster.pose(frame);
    return caster.depths(frame, PixelGrid(frame.viewport, 1), 1).nearest;
  };
  RayCaster one(from.scene, from.geometry), other(from.scene, from.geometry);
  const std::vector<float> at_once = depths(one, frame_at(0.1));
  for (const double x : {0.7, -0.3, 900.0}) static_cast<void>(depths(other, frame_at(x)));
  EXPECT_EQ(depths(other, frame_at(0.1)), at_once);
}

// The box around both is 1e9 m wide; single precision around its middle holds 64 m.
TEST(RayCaster, a_far_object_leaves_near_ones_as_precise_as_they_are) {
  MeshFile file;
  const std::size_t mesh = wall(file);
  file.node({{"mesh", mesh}, {"translation", {0, 0, -5.125}}});
  file.node({{"mesh", mesh}, {"translation", {1e9, 0, 0}}});
  const LoadedGeometry from = scene::test::loaded_geometry(file.text());
  RayCaster caster(from.scene, from.geometry);
  EXPECT_FLOAT_EQ(depth_at_middle(from, caster, 0.0), 5.125f);
}

// The skin's joint stands in a mirrored node; a wall of one side is seen all the same.
TEST(RayCaster, skinned_meshes_in_mirrored_nodes_show_their_fronts_however_far_from_the_origin) {
  MeshFile file;
  Json primitive = {{"attributes", {{"POSITION", file.positions({{-2, -2, 0}, {2, -2, 0}, {-2, 2, 0}, {2, 2, 0}})}}},
                    {"mode", 5}};
  primitive["attributes"]["JOINTS_0"] = file.accessor(std::string(16, '\0'), 5121, "VEC4", 4);
  primitive["attributes"]["WEIGHTS_0"] = file.accessor(
      scene::test::bytes_of(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), 5126, "VEC4", 4);
  file.node({{"translation", {1e9, 0, -5.125}}, {"scale", {-1, 1, 1}}, {"children", {1, 2}}});
  file.node({{"mesh", file.mesh(primitive)}, {"skin", 0}});
  file.node({{"name", "joint"}});
  file.json["skins"] = {{{"joints", {2}}}};
  file.json["scenes"] = {{{"nodes", {0}}}};
  const LoadedGeometry from = scene::test::loaded_geometry(file.text());
  RayCaster caster(from.scene, from.geometry);
  scene::Shot shot = shot_of(false);
  shot.pose = scene::camera_pose(glm::translate(Mat4d(1.0), Vec3d(1e9, 0, 0)));
  const view::Frame frame = view::make_frame(from.scene, shot, 0, {8, 8});
  caster.pose(frame);
  EXPECT_FLOAT_EQ(caster.depths(frame, PixelGrid(frame.viewport, 8), 1).nearest.at(0), 5.125f);
}

TEST(RayCaster, a_mesh_beyond_the_domain_is_named) {
  MeshFile file;
  file.node({{"mesh", wall(file)}, {"name", "moon"}, {"translation", {1e16, 0, 0}}});
  const LoadedGeometry from = scene::test::loaded_geometry(file.text());
  RayCaster caster(from.scene, from.geometry);
  try {
    caster.pose(view::make_frame(from.scene, shot_of(false), 0, {8, 8}));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "/nodes/0");
    EXPECT_NE(error.message().find("'moon'"), std::string::npos);
  }
}

}  // namespace
}  // namespace clusterbench::depth
