#include "scene/summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace clusterbench::scene {
namespace {

// Lights of the given ranges in a row along -z, ten metres apart from (0, 0, -10) on; a camera at the origin looks at
// them.
Scene scene_with(const std::vector<double>& ranges) {
  Scene scene;
  scene.nodes.push_back({});
  Camera camera;
  camera.name = "eye";
  camera.node = 0;
  camera.projection.yfov_rad = 1.0;
  camera.projection.far_m = 1000.0;
  scene.cameras = {camera};
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    Node node;
    node.translation = {0.0, 0.0, -10.0 * static_cast<double>(i + 1)};
    scene.nodes.push_back(node);
    Light light;
    light.name = "lamp " + std::to_string(i);
    light.node = static_cast<int>(i) + 1;
    light.range_m = ranges[i];
    light.range_given_m = ranges[i];
    scene.lights.push_back(light);
  }
  return scene;
}

bool warns_of(const Summary& summary, const std::string& text) {
  for (const std::string& warning : summary.warnings)
    if (warning.find(text) != std::string::npos) return true;
  return false;
}

TEST(Summary, counts_lights_and_ranges) {
  Scene scene = scene_with({1.0, 5.0, 3.0});
  scene.lights[1].type = LightType::spot;
  scene.lights[2].range_source = RangeSource::from_intensity;
  Light sun;
  sun.type = LightType::directional;
  sun.node = 1;
  sun.range_m = std::numeric_limits<double>::infinity();
  scene.lights.push_back(sun);
  const Summary summary = summarise(scene);
  EXPECT_EQ(summary.points, 2);
  EXPECT_EQ(summary.spots, 1);
  EXPECT_EQ(summary.directionals, 1);
  EXPECT_EQ(summary.ranges_given, 2);
  EXPECT_EQ(summary.ranges_from_intensity, 1);
  EXPECT_EQ(summary.range_median_m, 3.0);
  EXPECT_EQ(summary.range_max_m, 5.0);
  EXPECT_EQ(summary.made_range_min_m, 3.0);
  EXPECT_EQ(summary.made_range_max_m, 3.0);
}

TEST(Summary, bounds_hold_the_balls_over_the_animation) {
  Scene scene = scene_with({2.0});
  Channel channel;
  channel.node = 1;
  channel.times_s = {0.0, 1.0};
  channel.values = {{0, 0, -10, 0}, {30, 0, -10, 0}};
  scene.channels = {channel};
  scene.duration_s = 1.0;
  const Summary summary = summarise(scene);
  EXPECT_LT(glm::length(summary.bounds_lo - Vec3d(-2, -2, -12)), 1e-12);
  EXPECT_LT(glm::length(summary.bounds_hi - Vec3d(32, 2, -8)), 1e-12);
}

TEST(Summary, a_clean_scene_has_no_warnings_and_a_line_per_camera) {
  const Summary summary = summarise(scene_with({1.0, 2.0, 3.0}));
  EXPECT_TRUE(summary.warnings.empty());
  ASSERT_EQ(summary.cameras.size(), 1u);
  EXPECT_EQ(summary.cameras[0].substr(0, 17), "eye: perspective,");
}

TEST(Summary, lights_with_the_same_fault_share_one_warning) {
  Scene scene = scene_with({1.0, 2.0, 3.0});
  scene.lights[0].range_given_m.reset();
  scene.lights[2].range_given_m.reset();
  EXPECT_TRUE(warns_of(summarise(scene), "2 lights without range"));
}

TEST(Summary, a_range_beyond_all_lights_is_called_useless_for_clustering) {
  EXPECT_TRUE(warns_of(summarise(scene_with({1.0, 100.0, 1.0})), "'lamp 1'"));
  EXPECT_FALSE(warns_of(summarise(scene_with({1.0, 19.0, 1.0})), "useless"));
}

TEST(Summary, black_lights_and_lights_without_volume_are_named) {
  Scene scene = scene_with({1.0, 0.0, 1.0});
  scene.lights[2].intensity = 0.0;
  EXPECT_TRUE(warns_of(summarise(scene), "2 lights black or of no range: first 'lamp 1'"));
}

TEST(Summary, ranges_beyond_the_domain_and_cameras_that_cannot_be_measured_are_named) {
  Scene scene = scene_with({1e16, 2e16, 1e-16, 1.0, 0.0});
  scene.cameras[0].projection.yfov_rad = 3.14159;
  resolve_ranges(scene, {});
  const Summary summary = summarise(scene);
  EXPECT_TRUE(warns_of(summary, "2 lights with a range above 1e15 m, taken as endless: first 'lamp 0'"));
  EXPECT_TRUE(warns_of(summary, "1 light with a range below 1e-15 m, taken as none: 'lamp 2'"));
  EXPECT_TRUE(warns_of(summary, "camera 'eye' shows more than 89.9994 degrees"));
}

TEST(Summary, cameras_of_one_name_are_each_looked_through) {
  Scene scene = scene_with({1.0, 2.0});
  scene.nodes[2].translation = {0.0, 0.0, 10.0};
  Node behind;
  behind.rotation = {0.0, 1.0, 0.0, 0.0};  // looks along +z
  scene.nodes.push_back(behind);
  scene.cameras.push_back(scene.cameras[0]);
  scene.cameras[1].node = 3;
  scene.cameras[1].projection.yfov_rad = 0.5;
  const Summary summary = summarise(scene);
  ASSERT_EQ(summary.cameras.size(), 2U);
  EXPECT_NE(summary.cameras[0], summary.cameras[1]);
  EXPECT_FALSE(warns_of(summary, "never within"));
}

TEST(Summary, the_sides_of_an_off_centre_camera_are_its_view) {
  Scene scene = scene_with({1.0});
  scene.cameras[0].projection.sides = ProjectionSides{0.5, 0.6, -0.1, 0.1};
  EXPECT_TRUE(warns_of(summarise(scene), "never within"));
  scene.nodes[1].translation = {5.5, 0.0, -10.0};
  const Summary summary = summarise(scene);
  EXPECT_FALSE(warns_of(summary, "never within"));
  EXPECT_NE(summary.cameras[0].find("slopes 0.5 to 0.6 across, -0.1 to 0.1 up"), std::string::npos);
}

TEST(Summary, a_wide_camera_sees_what_a_picture_that_holds_it_shows) {
  Scene scene = scene_with({1.0});
  scene.cameras[0].projection.yfov_rad = 2.0 * std::atan(0.1);
  scene.nodes[1].translation = {0.0, 3.0, -10.0};
  EXPECT_TRUE(warns_of(summarise(scene), "never within"));
  scene.cameras[0].projection.aspect_ratio = 16.0;
  const Summary summary = summarise(scene);
  EXPECT_FALSE(warns_of(summary, "never within"));
  EXPECT_NE(summary.cameras[0].find("16 times as wide"), std::string::npos);
}

// A row of cameras and a row of lights behind them, all moving.
Scene crowd(int cameras, int lights) {
  Scene scene = scene_with(std::vector<double>(static_cast<std::size_t>(lights), 1.0));
  for (Node& node : scene.nodes) node.translation.z += 1000.0 + 10.0 * lights;
  for (int i = 1; i < cameras; ++i) scene.cameras.push_back(scene.cameras[0]);
  Channel channel;
  channel.node = 0;
  channel.times_s = {0.0, 1.0};
  channel.values = {{0, 0, 0, 0}, {1, 0, 0, 0}};
  scene.channels = {channel};
  scene.duration_s = 1.0;
  for (Camera& camera : scene.cameras) camera.animated = true;
  return scene;
}

TEST(Summary, what_would_take_long_is_looked_at_in_fewer_frames_and_says_so) {
  EXPECT_TRUE(warns_of(summarise(crowd(20, 20)), "never within any camera's reach, over the frames of its path"));
  EXPECT_TRUE(warns_of(summarise(crowd(1000, 1000)), "reach, over some evenly spaced frames of its path"));
  const Summary summary = summarise(crowd(5000, 5000));
  EXPECT_TRUE(warns_of(summary, "too many cameras and lights to tell"));
  EXPECT_FALSE(warns_of(summary, "never within"));
}

TEST(Summary, a_light_that_no_camera_reaches_is_named) {
  Scene scene = scene_with({1.0, 2.0, 2.0});
  scene.nodes[2].translation = {0.0, 0.0, 10.0};
  EXPECT_TRUE(warns_of(summarise(scene), "1 light never within any camera's reach"));
  scene.lights[1].range_m = 11.0;
  EXPECT_FALSE(warns_of(summarise(scene), "never within"));
}

}  // namespace
}  // namespace clusterbench::scene
