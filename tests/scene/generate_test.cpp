#include "scene/generators/generate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/error.h"
#include "places.h"
#include "scene/scene.h"

namespace clusterbench::scene {
namespace {

std::string committed(const std::string& name) {
  return clusterbench::test::source_dir() + "/scenes/" + name + ".glb";
}

class Generated : public testing::TestWithParam<GeneratorRow> {};

TEST_P(Generated, scene_is_the_committed_one_to_the_byte) {
  std::ifstream file(committed(GetParam().name), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  EXPECT_TRUE(bytes == make_scene(GetParam(), 1, 0));
}

TEST_P(Generated, scene_loads_with_its_lights_and_one_moving_camera) {
  const Scene scene = load_gltf(committed(GetParam().name));
  EXPECT_GE(static_cast<int>(scene.lights.size()), GetParam().default_lights);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_TRUE(scene.cameras[0].animated);
  EXPECT_GE(scene.duration_s, 10.0);
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
}

TEST_P(Generated, another_seed_gives_another_scene) {
  EXPECT_FALSE(make_scene(GetParam(), 1, 0) == make_scene(GetParam(), 2, 0));
}

INSTANTIATE_TEST_SUITE_P(Rows, Generated, testing::ValuesIn(generators().begin(), generators().end()),
                         [](const auto& row) {
                           std::string name = row.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Generators, hall_has_the_rig_that_was_published) {
  const Scene scene = load_gltf(committed("hall-512"));
  ASSERT_EQ(scene.lights.size(), 512u);
  for (const WorldLight& light : world_lights(scene, 0.0)) {
    EXPECT_EQ(light.range_m, 13.0);
    EXPECT_LE(std::abs(light.position.x), 100.0);
    EXPECT_LE(std::abs(light.position.z), 100.0);
    EXPECT_GE(light.position.y, 0.0);
    EXPECT_LE(light.position.y, 55.0);
  }
}

TEST(Generators, open_world_has_lights_that_move_and_spots_from_narrow_to_wide) {
  const Scene scene = load_gltf(committed("open-world"));
  double narrowest = 2.0, widest = 0.0;
  for (const Light& light : scene.lights) {
    if (light.type != LightType::spot) continue;
    narrowest = std::min(narrowest, light.outer_cone_rad);
    widest = std::max(widest, light.outer_cone_rad);
  }
  EXPECT_LT(narrowest, 0.04);
  EXPECT_GT(widest, 1.0);
  const auto start = world_lights(scene, 0.0), later = world_lights(scene, 10.0);
  int moved = 0;
  for (std::size_t i = 0; i < start.size(); ++i) moved += start[i].position != later[i].position;
  EXPECT_GT(moved, 50);
}

TEST(Generators, an_unknown_name_is_refused) {
  EXPECT_THROW(make_scene("hall", 1, 0), Error);
}

}  // namespace
}  // namespace clusterbench::scene
