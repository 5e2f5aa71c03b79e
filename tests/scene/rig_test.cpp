#include "scene/rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace clusterbench::scene {
namespace {

Scene rig(int lights, double spots, std::uint64_t seed = 1) {
  RigSpec spec;
  spec.lights = lights;
  spec.spots = spots;
  spec.seed = seed;
  Scene scene = make_rig(spec);
  resolve_ranges(scene, {});
  return scene;
}

int spots_of(const Scene& scene) {
  return static_cast<int>(std::count_if(scene.lights.begin(), scene.lights.end(),
                                        [](const Light& light) { return light.type == LightType::spot; }));
}

TEST(Rig, is_the_same_to_the_bit_on_every_machine) {
  EXPECT_EQ(rig(1000, 0.25).sha256, "993d2130f6155803c37130258796d5e945df0fcf71225d4ebd6730f6b3c67f09");
}

TEST(Rig, another_seed_share_range_or_size_gives_another_hash_and_name) {
  const RigSpec plain;
  RigSpec others[4];
  others[0].seed = 2;
  others[1].spots = 0.5;
  others[2].range_m = 3.0;
  others[3].size_m = {20.0, 5.0, 20.5};
  for (const RigSpec& other : others) {
    EXPECT_NE(make_rig(other).sha256, make_rig(plain).sha256);
    EXPECT_NE(other.name(), plain.name());
  }
  EXPECT_EQ(plain.name(), "rig-1000-r2");
  EXPECT_EQ(others[3].name(), "rig-1000-r2-20x5x20.5");
}

TEST(Rig, has_its_lights_in_the_box_and_as_many_spots_as_asked_for) {
  const Scene scene = rig(1000, 0.25);
  ASSERT_EQ(scene.lights.size(), 1000u);
  EXPECT_EQ(spots_of(scene), 250);
  EXPECT_EQ(spots_of(rig(1000, 0.0)), 0);
  EXPECT_EQ(spots_of(rig(1000, 1.0)), 1000);
  for (const WorldLight& light : world_lights(scene, 0.0)) {
    EXPECT_EQ(light.range_m, 2.0);
    EXPECT_LE(std::abs(light.position.x), 100.0);
    EXPECT_GE(light.position.y, 0.0);
    EXPECT_LE(light.position.y, 55.0);
    EXPECT_LE(std::abs(light.position.z), 100.0);
    EXPECT_NEAR(glm::length(light.direction), 1.0, 1e-12);
  }
}

TEST(Rig, of_fewer_lights_is_the_beginning_of_one_with_more) {
  const Scene few = rig(10, 0.3), many = rig(100, 0.3);
  for (std::size_t i = 0; i < few.lights.size(); ++i) {
    EXPECT_EQ(few.nodes[i].translation, many.nodes[i].translation);
    EXPECT_EQ(few.nodes[i].rotation, many.nodes[i].rotation);
    EXPECT_EQ(few.lights[i].type, many.lights[i].type);
    EXPECT_EQ(few.lights[i].outer_cone_rad, many.lights[i].outer_cone_rad);
  }
}

TEST(Rig, is_seen_by_one_standing_camera_that_looks_through_the_box) {
  const Scene scene = rig(10, 0.0);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].name, "look");
  EXPECT_FALSE(scene.cameras[0].animated);
  const CameraPose pose = camera_pose(scene, scene.cameras[0], 0.0);
  EXPECT_EQ(pose.eye, Vec3d(0.0, 1.7, 100.0));
  EXPECT_EQ(pose.view_from_world, Mat3d(1.0));
}

}  // namespace
}  // namespace clusterbench::scene
