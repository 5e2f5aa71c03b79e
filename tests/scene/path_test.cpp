#include "scene/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace clusterbench::scene {
namespace {

Node node_at(const Vec3d& place) {
  Node node;
  node.translation = place;
  return node;
}

Channel move(int node, std::vector<double> times, std::vector<Vec3d> places) {
  Channel channel;
  channel.node = node;
  channel.times_s = std::move(times);
  for (const Vec3d& place : places) channel.values.emplace_back(place, 0.0);
  return channel;
}

// Node 0: a camera that stands; node 1: one that moves from (0,0,0) to (9,0,0) in 3 s by way of (1,0,0); node 2: a
// light.
Scene scene_with_cameras(bool second_moves) {
  Scene scene;
  scene.path = "a.glb";
  scene.nodes = {node_at({5, 6, 7}), node_at({0, 0, 0}), node_at({2, 3, 4})};
  scene.cameras = {{"standing", 0, {}, false}, {"moving", 1, {}, second_moves}};
  if (second_moves) scene.channels = {move(1, {1.0, 2.0, 4.0}, {{0, 0, 0}, {1, 0, 0}, {9, 0, 0}})};
  Light light;
  light.name = "lamp";
  light.node = 2;
  light.range_m = 5.0;
  scene.lights = {light};
  scene.duration_s = second_moves ? 4.0 : 0.0;
  return scene;
}

std::vector<double> times_of(const CameraPath& path) {
  std::vector<double> times;
  for (const Shot& shot : path.shots) times.push_back(shot.time_s);
  return times;
}

TEST(CameraPaths, the_first_animated_camera_is_taken_when_none_is_named) {
  const auto paths = camera_paths(scene_with_cameras(true), {});
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0].camera, "moving");
  EXPECT_FALSE(paths[0].made);
}

TEST(CameraPaths, a_star_takes_every_camera) {
  PathRequest request;
  request.camera = "*";
  const auto paths = camera_paths(scene_with_cameras(true), request);
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0].camera, "standing");
  EXPECT_EQ(paths[1].camera, "moving");
  Scene without = scene_with_cameras(true);
  without.cameras.clear();
  EXPECT_EQ(camera_paths(without, request).at(0).camera, "around-lights");
}

TEST(CameraPaths, cameras_that_the_default_leaves_out_are_known_by_name) {
  EXPECT_TRUE(cameras_left_out(scene_with_cameras(false), {}).empty()) << "static ones are all measured";
  Scene scene = scene_with_cameras(true);
  EXPECT_EQ(cameras_left_out(scene, {}), (std::vector<std::string>{"standing (static)"}));
  for (const char* name : {"third", "fourth"}) {
    scene.cameras.push_back(scene.cameras[1]);
    scene.cameras.back().name = name;
  }
  EXPECT_EQ(cameras_left_out(scene, {}), (std::vector<std::string>{"standing (static)", "third", "fourth"}));
  PathRequest named;
  named.camera = "third";
  EXPECT_TRUE(cameras_left_out(scene, named).empty()) << "somebody has chosen";
}

TEST(CameraPaths, a_field_of_view_is_degrees_across_or_up_and_down) {
  ASSERT_TRUE(field_of_view("90h"));
  EXPECT_NEAR(field_of_view("90h")->angle_rad, 1.5707963267948966, 1e-15);
  EXPECT_TRUE(field_of_view("90h")->is_horizontal);
  ASSERT_TRUE(field_of_view("59.5v"));
  EXPECT_FALSE(field_of_view("59.5v")->is_horizontal);
  for (const char* text : {"", "90", "h", "0h", "180v", "-5h", "90 h", "90hv", "1e2h", "90.h"})
    EXPECT_FALSE(field_of_view(text)) << text;
}

TEST(CameraPaths, a_far_plane_that_is_asked_for_is_that_of_all_cameras_and_lies_behind_the_near_plane) {
  PathRequest request;
  request.camera = "*";
  request.far_m = 400.0;
  Scene scene = scene_with_cameras(true);
  scene.cameras[1].projection.orthographic = true;
  for (const CameraPath& path : camera_paths(scene, request))
    for (const Shot& shot : path.shots) EXPECT_EQ(shot.projection.far_m, 400.0);
  scene.cameras.clear();
  EXPECT_EQ(camera_paths(scene, request).at(0).shots.at(0).projection.far_m, 400.0) << "of a made path";
  request.far_m = 0.1;
  try {
    camera_paths(scene_with_cameras(true), request);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "far");
    EXPECT_NE(std::string(error.what()).find("0.1 m is not behind the near plane of camera 'standing', 0.1 m"),
              std::string::npos)
        << error.what();
  }
}

TEST(CameraPaths, jitter_is_gone_through_frame_by_frame_and_again_from_its_first) {
  PathRequest request;
  request.count = 5;
  request.jitter_px = {{0.25, 0.0}, {0.0, -0.5}};
  std::vector<Vec2d> seen;
  const std::vector<CameraPath> paths = camera_paths(scene_with_cameras(true), request);
  for (const Shot& shot : paths.at(0).shots) seen.push_back(shot.jitter_px);
  const Vec2d a{0.25, 0.0}, b{0.0, -0.5};
  EXPECT_EQ(seen, (std::vector<Vec2d>{a, b, a, b, a}));
}

TEST(CameraPaths, without_an_animated_camera_each_static_one_gives_one_frame) {
  const auto paths = camera_paths(scene_with_cameras(false), {});
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0].camera, "standing");
  ASSERT_EQ(paths[0].shots.size(), 1u);
  EXPECT_EQ(paths[0].shots[0].pose.eye, Vec3d(5, 6, 7));
}

TEST(CameraPaths, equal_steps_run_from_the_first_key_to_the_last) {
  PathRequest request;
  request.count = 4;
  const CameraPath path = camera_paths(scene_with_cameras(true), request).front();
  EXPECT_EQ(times_of(path), (std::vector<double>{1.0, 2.0, 3.0, 4.0}));
  EXPECT_EQ(path.shots[2].pose.eye, Vec3d(5, 0, 0));
  request.count = 1;
  EXPECT_EQ(times_of(camera_paths(scene_with_cameras(true), request).front()), std::vector<double>{1.0});
}

TEST(CameraPaths, a_rate_counts_from_the_first_key_and_stays_within_the_last) {
  PathRequest request;
  request.choice = FrameChoice::rate;
  request.rate_hz = 0.8;
  EXPECT_EQ(times_of(camera_paths(scene_with_cameras(true), request).front()), (std::vector<double>{1.0, 2.25, 3.5}));
}

TEST(CameraPaths, keys_are_the_cameras_own) {
  Scene scene = scene_with_cameras(true);
  scene.channels.push_back(move(2, {0.0, 0.5}, {{0, 0, 0}, {1, 1, 1}}));
  PathRequest request;
  request.choice = FrameChoice::keys;
  EXPECT_EQ(times_of(camera_paths(scene, request).front()), (std::vector<double>{1.0, 2.0, 4.0}));
}

TEST(CameraPaths, a_standing_camera_sees_lights_move) {
  Scene scene = scene_with_cameras(false);
  scene.channels = {move(2, {0.0, 6.0}, {{0, 0, 0}, {1, 1, 1}})};
  PathRequest request;
  request.camera = "standing";
  request.count = 3;
  EXPECT_EQ(times_of(camera_paths(scene, request).front()), (std::vector<double>{0.0, 3.0, 6.0}));
}

TEST(CameraPaths, an_unknown_camera_is_answered_with_those_that_exist) {
  PathRequest request;
  request.camera = "movin";
  try {
    camera_paths(scene_with_cameras(true), request);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "a.glb: camera: has no camera 'movin' (did you mean 'moving'?); it has: standing, moving");
  }
}

TEST(CameraPaths, without_a_camera_a_walk_among_the_lights_is_made_and_declared) {
  Scene scene = scene_with_cameras(false);
  scene.cameras.clear();
  scene.nodes.push_back(node_at({40, 8, 60}));
  scene.lights.push_back(scene.lights[0]);
  scene.lights[1].node = 3;
  PathRequest request;
  request.count = 12;
  const CameraPath path = camera_paths(scene, request).front();
  EXPECT_TRUE(path.made);
  EXPECT_EQ(path.camera, "around-lights");
  ASSERT_EQ(path.shots.size(), 12u);
  for (std::size_t i = 0; i < path.shots.size(); ++i) {
    const CameraPose &here = path.shots[i].pose, &next = path.shots[(i + 1) % 12].pose;
    EXPECT_GT(here.eye.x, 2.0);
    EXPECT_LT(here.eye.x, 40.0);
    const Vec3d ahead = here.view_from_world * (next.eye - here.eye);
    EXPECT_LT(ahead.z, 0.0) << "looks along its way";
    EXPECT_NEAR(glm::determinant(here.view_from_world), 1.0, 1e-12);
  }
}

TEST(CameraPaths, a_scene_with_neither_camera_nor_light_is_refused) {
  Scene scene;
  scene.path = "empty.glb";
  EXPECT_THROW(camera_paths(scene, {}), Error);
}

}  // namespace
}  // namespace clusterbench::scene
