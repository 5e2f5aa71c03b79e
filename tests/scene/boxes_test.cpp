// Oriented boxes of nodes as lights.

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "scene/domain_check.h"
#include "scene/gltf_fixture.h"

namespace clusterbench::scene {
namespace {

// One box under a node; `parent` and `node` are members of the two.
Scene scene_with_box(const std::string& parent, const std::string& node,
                     const std::string& half_extents = "[1, 2, 3]") {
  Scene scene = test::loaded(test::document(
      R"("scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"children": [1])" + parent + R"(}, {"name": "decal")" +
      node + R"(, "extras": {"clusterbench_box": {"half_extents": )" + half_extents + "}}}]"));
  assign_boxes(scene);
  return scene;
}

WorldLight only_box(const Scene& scene) {
  const std::vector<WorldLight> lights = world_lights(scene, 0.0);
  EXPECT_EQ(lights.size(), 1u);
  EXPECT_EQ(lights[0].type, LightType::box);
  return lights[0];
}

TEST(Boxes, are_counted_and_no_lights_unless_they_are_assigned) {
  const Scene counted = test::loaded(test::document(
      R"("scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"extras": {"clusterbench_box": {"half_extents": [1, 2, 3]}}}])"));
  EXPECT_EQ(counted.boxes.size(), 1u);
  EXPECT_TRUE(world_lights(counted, 0.0).empty());
}

TEST(Boxes, are_where_their_nodes_transform_puts_them) {
  const WorldLight box = only_box(
      scene_with_box(R"(, "translation": [10, 0, 0], "scale": [2, 2, 2])",
                     R"(, "translation": [1, 1, 1], "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476])"));
  EXPECT_EQ(box.position, Vec3d(12, 2, 2));
  // A quarter turn about z takes x to y.
  EXPECT_NEAR(glm::length(box.half_axes_m[0] - Vec3d(0, 2, 0)), 0.0, 1e-14);
  EXPECT_NEAR(glm::length(box.half_axes_m[1] - Vec3d(-4, 0, 0)), 0.0, 1e-14);
  EXPECT_NEAR(glm::length(box.half_axes_m[2] - Vec3d(0, 0, 6)), 0.0, 1e-14);
  const double corner = std::sqrt(4.0 + 16.0 + 36.0);
  EXPECT_GE(box.range_m, corner);
  EXPECT_LE(box.range_m, corner * (1.0 + 1e-12));
  EXPECT_EQ(box.luminous_intensity_cd, 0.0);
}

TEST(Boxes, under_a_sheared_node_are_parallelepipeds_as_far_as_their_farthest_corner) {
  // Stretched along x after an eighth of a turn.
  const WorldLight box = only_box(scene_with_box(
      R"(, "scale": [3, 1, 1])", R"(, "rotation": [0, 0, 0.3826834323650898, 0.9238795325112867])", "[1, 1, 0]"));
  EXPECT_GT(glm::dot(box.half_axes_m[0], box.half_axes_m[1]), -9.0);
  EXPECT_LT(glm::dot(box.half_axes_m[0], box.half_axes_m[1]), -3.9);
  EXPECT_EQ(box.half_axes_m[2], Vec3d(0.0));
  const double farthest = std::max(glm::length(box.half_axes_m[0] + box.half_axes_m[1]),
                                   glm::length(box.half_axes_m[0] - box.half_axes_m[1]));
  EXPECT_NEAR(box.range_m, farthest, 1e-12 * farthest);
  EXPECT_GE(box.range_m, farthest);
}

TEST(Boxes, without_any_extent_and_of_hidden_nodes_reach_nothing) {
  EXPECT_EQ(only_box(scene_with_box("", "", "[0, 0, 0]")).range_m, 0.0);
  EXPECT_EQ(only_box(scene_with_box(R"(, "scale": [0, 0, 0])", "")).range_m, 0.0);
  EXPECT_GT(only_box(scene_with_box("", "", "[0, 0, 1]")).range_m, 0.0);
}

TEST(Boxes, larger_than_the_domain_are_refused_by_name) {
  const Scene scene = scene_with_box("", "", "[1e16, 1, 1]");
  try {
    check_domain(scene, world_lights(scene, 0.0), 0.0);
    FAIL() << "is not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "/nodes/1");
    EXPECT_NE(error.message().find("the box 'decal' reaches farther"), std::string::npos) << error.message();
  }
}

TEST(Boxes, distance_of_the_farthest_corner_neither_overflows_nor_vanishes) {
  for (const double size : {1e-300, 1e-200, 1.0, 1e200}) {
    const double found = corner_distance_m({size * Vec3d(1, 0, 0), size * Vec3d(0, 2, 0), size * Vec3d(0, 0, 2)});
    EXPECT_GE(found, 3.0 * size);
    EXPECT_LE(found, 3.0 * size * (1.0 + 1e-12));
  }
  EXPECT_EQ(corner_distance_m({}), 0.0);
}

}  // namespace
}  // namespace clusterbench::scene
