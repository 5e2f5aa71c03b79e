#include "scene/summary.h"

#include <gtest/gtest.h>

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
  camera.lens.yfov_rad = 1.0;
  camera.lens.far_m = 1000.0;
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

TEST(Summary, a_light_that_no_camera_reaches_is_named) {
  Scene scene = scene_with({1.0, 2.0, 2.0});
  scene.nodes[2].translation = {0.0, 0.0, 10.0};
  EXPECT_TRUE(warns_of(summarise(scene), "1 light never within any camera's reach"));
  scene.lights[1].range_m = 11.0;
  EXPECT_FALSE(warns_of(summarise(scene), "never within"));
}

}  // namespace
}  // namespace clusterbench::scene
