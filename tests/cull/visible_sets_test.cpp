// Visible sets: walls and windows, and the whole of it once more without Embree, bits or a walk through voxels.

#include "cull/visible_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "core/random.h"
#include "grid/lights_in_view.h"
#include "places.h"
#include "scene/camera_path.h"
#include "scene/mesh_fixture.h"

namespace clusterbench::cull {
namespace {

using Json = nlohmann::json;
using scene::test::LoadedGeometry;
using scene::test::MeshFile;

// A wall at z = -5, 100 m wide and high, seen from both sides; with a window, a hole from -1 to 1.
LoadedGeometry room(bool has_window) {
  MeshFile file;
  std::vector<Vec3f> vertices;
  const auto quad = [&](float x0, float x1, float y0, float y1) {
    const Vec3f a(x0, y0, -5.0f), b(x1, y0, -5.0f), c(x1, y1, -5.0f), d(x0, y1, -5.0f);
    vertices.insert(vertices.end(), {a, b, c, a, c, d});
  };
  if (has_window) {
    quad(-50, -1, -50, 50);
    quad(1, 50, -50, 50);
    quad(-1, 1, -50, -1);
    quad(-1, 1, 1, 50);
  } else {
    quad(-50, 50, -50, 50);
  }
  const std::size_t material = file.material({{"doubleSided", true}});
  const std::size_t mesh =
      file.mesh({{"attributes", {{"POSITION", file.positions(vertices)}}}, {"material", material}});
  file.node({{"mesh", mesh}});
  return scene::test::loaded_geometry(file.text());
}

void add_light(scene::Scene& scene, const Vec3d& place, double range_m) {
  scene::Node node;
  node.translation = place;
  scene.nodes.push_back(node);
  scene::Light light;
  light.node = static_cast<int>(scene.nodes.size()) - 1;
  light.range_m = range_m;
  scene.lights.push_back(light);
}

scene::CameraPath path_at(const std::vector<Vec3d>& eyes) {
  scene::CameraPath path;
  for (const Vec3d& eye : eyes) {
    scene::Shot shot;
    shot.pose.eye = eye;
    path.shots.push_back(shot);
  }
  return path;
}

std::vector<bool> kept(const LoadedGeometry& from, const scene::CameraPath& path, const VisibleSetStep& step,
                       int threads = 1, std::uint64_t seed = 1) {
  const VisibleSets sets(from.scene, from.geometry, path, step, seed, threads);
  const std::vector<scene::WorldLight> lights = scene::world_lights(from.scene, 0.0);
  std::vector<bool> out;
  for (const scene::Shot& shot : path.shots) {
    const VisibleSets::ViewCell* cell = sets.at(shot.pose.eye);
    for (std::uint32_t i = 0; i < lights.size(); ++i) out.push_back(sets.keeps(*cell, i, lights[i]));
  }
  return out;
}

constexpr VisibleSetStep k_fine{2.0, 0.5, 20000};
const Vec3d k_eye(0.3, 0.2, 0.4);

TEST(VisibleSets, a_wall_hides_a_light_and_a_window_lets_it_through) {
  for (const bool has_window : {false, true}) {
    LoadedGeometry from = room(has_window);
    add_light(from.scene, {0.0, 0.0, -15.0}, 3.0);   // behind the window
    add_light(from.scene, {40.0, 0.0, -9.0}, 3.0);   // behind the wall, where no way through the window leads
    add_light(from.scene, {0.0, 0.0, -1.0}, 1.0);    // before the wall
    add_light(from.scene, {30.0, 0.0, -7.0}, 2.25);  // behind the wall, and through it
    EXPECT_EQ(kept(from, path_at({k_eye}), k_fine), (std::vector<bool>{has_window, false, true, true})) << has_window;
  }
}

TEST(VisibleSets, seen_from_its_back_a_surface_of_one_side_hides_nothing) {
  MeshFile file;
  const std::vector<Vec3f> corners{{-90, -90, -5}, {90, -90, -5}, {0, 90, -5}};  // faces +z
  const std::size_t mesh = file.mesh({{"attributes", {{"POSITION", file.positions(corners)}}}});
  file.node({{"mesh", mesh}});
  LoadedGeometry from = scene::test::loaded_geometry(file.text());
  add_light(from.scene, {0.0, 0.0, -15.0}, 3.0);
  add_light(from.scene, {0.0, 0.0, 5.0}, 3.0);
  const auto eyes = path_at({k_eye, {0.3, 0.2, -17.0}});
  EXPECT_EQ(kept(from, eyes, k_fine), (std::vector<bool>{false, true, true, true}));
}

TEST(VisibleSets, of_lights_that_end_nowhere_or_at_once) {
  LoadedGeometry from = room(false);
  add_light(from.scene, {0.0, 0.0, -500.0}, std::numeric_limits<double>::infinity());
  add_light(from.scene, {0.0, 0.0, 0.0}, 0.0);
  add_light(from.scene, {0.0, 0.0, -1.0}, 1.0);
  EXPECT_EQ(kept(from, path_at({k_eye}), k_fine), (std::vector<bool>{true, false, true}));
}

TEST(VisibleSets, a_spots_ball_is_the_one_around_its_cone) {
  SplitMix64 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    scene::WorldLight spot;
    spot.type = scene::LightType::spot;
    spot.range_m = random.between(0.5, 9.0);
    spot.outer_cone_rad = random.between(0.0, M_PI / 2);
    spot.direction = {0.0, 0.6, -0.8};
    const grid::WorldBall ball = grid::ball_around(spot);
    EXPECT_LE(ball.radius_m, spot.range_m * (1.0 + 1e-12));
    const Vec3d across(1.0, 0.0, 0.0);
    for (double angle = -1.0; angle <= 1.0; angle += 0.125)
      for (double share = 0.0; share <= 1.0; share += 0.25) {
        const double a = angle * spot.outer_cone_rad;
        const Vec3d point = share * spot.range_m * (std::cos(a) * spot.direction + std::sin(a) * across);
        EXPECT_LE(glm::length(point - ball.center), ball.radius_m * (1.0 + 1e-12)) << trial;
      }
  }
}

TEST(VisibleSets, a_light_that_moves_is_looked_up_where_it_is) {
  LoadedGeometry from = room(false);
  add_light(from.scene, {0.0, 0.0, -15.0}, 2.0);
  add_light(from.scene, {0.0, 0.0, -1.0}, 1.0);
  scene::Channel channel;  // through the wall
  channel.node = from.scene.lights[0].node;
  channel.times_s = {0.0, 1.0};
  channel.values = {{0.0, 0.0, -15.0, 0.0}, {0.0, 0.0, -3.0, 0.0}};
  from.scene.channels.push_back(channel);
  scene::CameraPath path = path_at({k_eye, k_eye});
  path.shots[1].time_s = 1.0;
  const VisibleSets sets(from.scene, from.geometry, path, k_fine, 1, 1);
  const VisibleSets::ViewCell* cell = sets.at(k_eye);
  for (const double time_s : {0.0, 1.0}) {
    const std::vector<scene::WorldLight> lights = scene::world_lights(from.scene, time_s);
    EXPECT_EQ(sets.keeps(*cell, 0, lights[0]), time_s > 0.0);
    EXPECT_TRUE(sets.keeps(*cell, 1, lights[1]));
  }
  EXPECT_GT(sets.bytes(), 100u) << "the voxels stay";
}

TEST(VisibleSets, an_eye_elsewhere_has_no_set) {
  LoadedGeometry from = room(false);
  add_light(from.scene, {0.0, 0.0, -1.0}, 1.0);
  const VisibleSets sets(from.scene, from.geometry, path_at({k_eye}), k_fine, 1, 1);
  EXPECT_NE(sets.at(k_eye), nullptr);
  EXPECT_NE(sets.at({1.9, 1.9, 1.9}), nullptr);
  EXPECT_EQ(sets.at({-0.1, 0.1, 0.1}), nullptr);
  EXPECT_EQ(sets.view_cell_count(), 1u);
  EXPECT_EQ(sets.bytes(), 8u) << "a word of bits";
}

// The scene's triangles in world space, in double precision.
struct Corners {
  Vec3d a, b, c;
  bool double_sided;
};

std::vector<Corners> opaque_triangles(const scene::Scene& scene, const scene::Geometry& geometry) {
  const std::vector<Mat4d> transforms = world_transforms(scene, 0.0);
  std::vector<Corners> out;
  for (const scene::SurfaceInstance& instance : geometry.instances) {
    const scene::Surface& surface = geometry.surfaces[instance.surface];
    if (surface.blends) continue;
    const Mat4d& world = transforms[static_cast<std::size_t>(instance.node)];
    const bool mirrored = glm::determinant(Mat3d(world)) < 0.0;
    for (const scene::Triangle& triangle : surface.triangles) {
      const auto at = [&](std::size_t k) {
        return Vec3d(world * Vec4d(surface.origin + Vec3d(surface.vertices[triangle[k]]), 1.0));
      };
      out.push_back({at(0), mirrored ? at(2) : at(1), mirrored ? at(1) : at(2), surface.double_sided});
    }
  }
  return out;
}

// Moller and Trumbore 1997. `is_sure` is false where the way goes by an edge too closely to tell.
double free_way(const std::vector<Corners>& triangles, const Vec3d& from, const Vec3d& along, bool& is_sure) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Corners& t : triangles) {
    const Vec3d ab = t.b - t.a, ac = t.c - t.a, p = glm::cross(along, ac);
    const double det = glm::dot(ab, p);
    if (det == 0.0 || (det < 0.0 && !t.double_sided)) continue;
    const Vec3d to = from - t.a, q = glm::cross(to, ab);
    const double u = glm::dot(to, p) / det, v = glm::dot(along, q) / det, way = glm::dot(ac, q) / det;
    if (way < 1e-4 || std::min({u, v, 1.0 - u - v}) < -1e-4) {
      if (std::abs(way) < 1e-4) is_sure = false;
      continue;
    }
    if (std::min({u, v, 1.0 - u - v}) < 1e-4) is_sure = false;
    nearest = std::min(nearest, way);
  }
  return nearest;
}

class OnScene : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::filesystem::path file = std::filesystem::path(test::source_dir()) / "scenes" / GetParam();
    from_.scene = scene::load_gltf(file);
    from_.geometry = scene::load_geometry(from_.scene);
    scene::resolve_ranges(from_.scene, {});
    scene::PathRequest request;
    request.count = 6;
    path_ = scene::camera_paths(from_.scene, request).front();
    ASSERT_GT(from_.geometry.triangle_count(), 0u);
  }

  LoadedGeometry from_;
  scene::CameraPath path_;
};

TEST_P(OnScene, rays_end_where_a_loop_over_all_triangles_says) {
  const std::vector<Corners> triangles = opaque_triangles(from_.scene, from_.geometry);
  depth::RayCaster caster(from_.scene, from_.geometry);
  view::Frame frame;
  frame.view_space.origin = path_.shots.front().pose.eye;
  frame.projection.near_m = 1.0;
  caster.pose(frame);
  const std::vector<Vec3d> eyes{frame.view_space.origin};
  const VisibleSetStep step{4.0, 2.0, 300};
  int sure = 0, hits = 0;
  for (const depth::WorldRay& ray : view_rays(voxel_of(eyes[0], 4.0), eyes, step, caster, 1, 1)) {
    bool is_sure = true;
    const double way = free_way(triangles, ray.from, ray.along, is_sure);
    if (!is_sure) continue;
    ++sure;
    hits += std::isfinite(way) ? 1 : 0;
    EXPECT_TRUE(ray.most_m == way || std::abs(ray.most_m - way) < 1e-3 * (1.0 + way)) << ray.most_m << " " << way;
    // A ray's beginning is seen from the eye.
    const Vec3d to = ray.from - eyes[0];
    const double length = glm::length(to);
    bool is_certain = true;
    const double seen = free_way(triangles, eyes[0], to / length, is_certain);
    EXPECT_TRUE(!is_certain || seen >= length * (1.0 - 1e-6));
  }
  EXPECT_GT(sure, 200);
  EXPECT_GT(hits, 30);
}

// The voxels of a way: between every two neighbours of all planes that it crosses.
void add_voxels(std::set<VoxelIndex>& out, const depth::WorldRay& ray, double size_m, double longest_m) {
  const double end = std::min(ray.most_m - 1e-3 * size_m, longest_m);
  std::vector<double> crossings{0.0, end};
  for (int axis = 0; axis < 3; ++axis) {
    const double a = ray.from[axis], b = a + end * ray.along[axis];
    for (double plane = std::ceil(std::min(a, b) / size_m); plane * size_m <= std::max(a, b); ++plane)
      crossings.push_back((plane * size_m - a) / ray.along[axis]);
  }
  std::ranges::sort(crossings);
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i)
    if (crossings[i + 1] > crossings[i] && crossings[i + 1] <= end)
      out.insert(voxel_of(ray.from + 0.5 * (crossings[i] + crossings[i + 1]) * ray.along, size_m));
}

TEST_P(OnScene, a_set_is_what_its_rays_pass_through) {
  const VisibleSetStep step{8.0, 4.0, 500};
  const std::vector<bool> found = kept(from_, path_, step);
  const std::vector<scene::WorldLight> lights = scene::world_lights(from_.scene, path_.shots.front().time_s);
  double farthest = 0.0;  // no light reaches farther from an eye
  std::map<VoxelIndex, std::vector<Vec3d>> eyes;
  for (const scene::Shot& shot : path_.shots) {
    eyes[voxel_of(shot.pose.eye, step.view_cell_m)].push_back(shot.pose.eye);
    for (const scene::WorldLight& light : lights)
      farthest = std::max(farthest, glm::length(light.position - shot.pose.eye) + light.range_m + 20.0);
  }
  depth::RayCaster caster(from_.scene, from_.geometry);
  std::size_t next = 0, hidden = 0, unsure = 0;
  for (const scene::Shot& shot : path_.shots) {
    view::Frame frame;
    frame.time_s = path_.shots.front().time_s;
    frame.view_space.origin = shot.pose.eye;
    frame.projection.near_m = 1.0;
    caster.pose(frame);
    const VoxelIndex cell = voxel_of(shot.pose.eye, step.view_cell_m);
    std::set<VoxelIndex> voxels;
    for (const depth::WorldRay& ray : view_rays(cell, eyes[cell], step, caster, 1, 1))
      add_voxels(voxels, ray, step.voxel_m, farthest);
    for (const scene::WorldLight& light : lights) {
      const grid::WorldBall ball = grid::ball_around(light);
      double nearest = std::numeric_limits<double>::infinity();
      for (const VoxelIndex& voxel : voxels) {
        const Vec3d lo = step.voxel_m * Vec3d(static_cast<double>(voxel[0]), static_cast<double>(voxel[1]),
                                              static_cast<double>(voxel[2]));
        const Vec3d apart = glm::max(glm::max(lo - ball.center, ball.center - (lo + step.voxel_m)), Vec3d(0.0));
        nearest = std::min(nearest, glm::length(apart));
      }
      if (std::abs(nearest - ball.radius_m) < 1e-6) {
        ++unsure;
        ++next;
        continue;
      }
      EXPECT_EQ(found[next++], nearest < ball.radius_m);
      hidden += nearest < ball.radius_m ? 0 : 1;
    }
  }
  EXPECT_EQ(next, found.size());
  EXPECT_LT(unsure, found.size() / 20);
  ::testing::Test::RecordProperty("hidden", static_cast<int>(hidden));
}

TEST_P(OnScene, threads_change_nothing) {
  const VisibleSetStep step{4.0, 1.0, 64};
  const std::vector<bool> one = kept(from_, path_, step, 1);
  EXPECT_EQ(kept(from_, path_, step, 3), one);
}

// Of lights and voxels that are wider than the rays lie apart, 0.03 rad; what is smaller in the picture is met by
// chance.
TEST_P(OnScene, nearly_every_light_that_an_eye_sees_is_kept) {
  const std::vector<Corners> triangles = opaque_triangles(from_.scene, from_.geometry);
  const std::vector<bool> found = kept(from_, path_, {4.0, 2.0, 16384});
  const std::vector<scene::WorldLight> lights = scene::world_lights(from_.scene, path_.shots.front().time_s);
  SplitMix64 random(5);
  int seen = 0, lost = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const std::size_t shot = random.below(path_.shots.size()), light = random.below(lights.size());
    const grid::WorldBall ball = grid::ball_around(lights[light]);
    const double x = random.between(-0.5, 0.5), y = random.between(-0.5, 0.5), z = random.between(-0.5, 0.5);
    const Vec3d eye = path_.shots[shot].pose.eye, to = ball.center + ball.radius_m * Vec3d(x, y, z) - eye;
    bool is_sure = true;
    if (ball.radius_m + 1.0 < 0.06 * glm::length(to)) continue;
    if (free_way(triangles, eye, glm::normalize(to), is_sure) < glm::length(to) || !is_sure) continue;
    ++seen;
    lost += found[shot * lights.size() + light] ? 0 : 1;
  }
  EXPECT_GT(seen, 40);
  EXPECT_LE(lost, seen / 50) << lost << " of " << seen;
}

INSTANTIATE_TEST_SUITE_P(VisibleSets, OnScene, ::testing::Values("mix.glb", "steps.glb", "slope.glb"),
                         [](const auto& scene) { return std::filesystem::path(scene.param).stem().string(); });

}  // namespace
}  // namespace clusterbench::cull
