// Lights, cameras and ranges of small documents, against positions worked out by hand.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "core/text.h"
#include "gltf_fixture.h"

namespace clusterbench::scene::test {
namespace {

constexpr double k_pi = std::numbers::pi;
constexpr double k_tiny = 1e-12;

#define EXPECT_VEC3(found, x0, y0, z0)   \
  do {                                   \
    const Vec3d found_ = (found);        \
    EXPECT_NEAR(found_.x, (x0), k_tiny); \
    EXPECT_NEAR(found_.y, (y0), k_tiny); \
    EXPECT_NEAR(found_.z, (z0), k_tiny); \
  } while (false)

const std::string k_point = R"({"type": "point", "range": 5, "intensity": 8})";
const std::string k_spot = R"({"type": "spot", "range": 7, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}})";

std::string lights(const std::string& definitions) {
  return R"("extensions": {"KHR_lights_punctual": {"lights": [)" + definitions + "]}}";
}

std::string lit(int light, const std::string& rest = "") {
  return R"({"extensions": {"KHR_lights_punctual": {"light": )" + std::to_string(light) + "}}" +
         (rest.empty() ? "" : ", " + rest) + "}";
}

std::string nodes(const std::string& list) {
  return R"("nodes": [)" + list + "]";
}

std::string spot_scene(const std::string& transform) {
  return document(nodes(lit(0, transform)) + ", " + lights(k_spot));
}

TEST(GltfLights, a_nested_light_stands_where_the_transforms_above_it_put_it) {
  // Parent: turned 90° about y (x -> -z), scaled 2, moved by (10, 0, 0). Child at (1, 2, 3): scaled (2, 4, 6), turned
  // to (6, 4, -2), moved to (16, 4, -2).
  const Scene scene = loaded(document(
      nodes(R"({"children": [1], "translation": [10, 0, 0], "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476],
              "scale": [2, 2, 2]}, )" +
            lit(0, R"("translation": [1, 2, 3])")) +
      ", " + lights(k_point)));
  const WorldLight light = world_lights(scene, 0.0).at(0);
  EXPECT_VEC3(light.position, 16, 4, -2);
  EXPECT_EQ(light.range_m, 5.0);  // not scaled
  EXPECT_EQ(scene.lights[0].intensity, 8.0);
}

TEST(GltfLights, a_lights_luminous_intensity_is_its_intensity_times_its_colours_luminance) {
  const auto intensity = [](const std::string& keys) {
    return world_lights(loaded(document(nodes(lit(0, "")) + ", " + lights(R"({"type": "point", )" + keys + "}"))), 0.0)
        .at(0)
        .luminous_intensity_cd;
  };
  EXPECT_DOUBLE_EQ(intensity(R"("range": 1)"), 1.0);
  EXPECT_DOUBLE_EQ(intensity(R"("intensity": 1000000)"), 1e6);
  EXPECT_DOUBLE_EQ(intensity(R"("intensity": 10, "color": [1, 0, 0])"), 2.126);
  EXPECT_DOUBLE_EQ(intensity(R"("intensity": 10, "color": [0, 1, 0])"), 7.152);
  EXPECT_DOUBLE_EQ(intensity(R"("intensity": 10, "color": [0, 0, 0.5])"), 0.361);
}

TEST(GltfLights, a_spots_inner_cone_goes_with_it) {
  const WorldLight spot = world_lights(loaded(spot_scene("")), 0.0).at(0);
  EXPECT_EQ(spot.inner_cone_rad, 0.1);
  EXPECT_EQ(spot.outer_cone_rad, 0.5);
}

TEST(GltfLights, a_spot_shines_along_its_nodes_minus_z_through_the_whole_matrix) {
  EXPECT_VEC3(world_lights(loaded(spot_scene("")), 0).at(0).direction, 0, 0, -1);
  EXPECT_VEC3(world_lights(loaded(spot_scene(R"("scale": [1, 1, -3])")), 0).at(0).direction, 0, 0, 1);
  EXPECT_VEC3(world_lights(loaded(spot_scene(R"("scale": [-1, 1, 1])")), 0).at(0).direction, 0, 0, -1);
  // A quarter turn about x takes -z to +y.
  EXPECT_VEC3(world_lights(loaded(spot_scene(R"("rotation": [0.7071067811865476, 0, 0, 0.7071067811865476])")), 0)
                  .at(0)
                  .direction,
              0, 1, 0);
}

TEST(GltfLights, a_non_uniform_scale_above_a_turned_spot_bends_its_direction) {
  // The child turns -z by 45° about y to (-1, 0, -1)/√2; the parent stretches x by 3: (-3, 0, -1)/√10.
  const double half = k_pi / 8.0;
  const Scene scene = loaded(document(nodes(R"({"children": [1], "scale": [3, 1, 1]}, )" +
                                            lit(0, R"("rotation": [0, )" + std::to_string(std::sin(half)) + ", 0, " +
                                                       std::to_string(std::cos(half)) + "]")) +
                                      ", " + lights(k_spot)));
  const Vec3d direction = world_lights(scene, 0.0).at(0).direction;
  EXPECT_NEAR(direction.x, -3.0 / std::sqrt(10.0), 1e-6);
  EXPECT_NEAR(direction.z, -1.0 / std::sqrt(10.0), 1e-6);
  EXPECT_NEAR(glm::length(direction), 1.0, 1e-15);
}

TEST(GltfLights, a_mirroring_matrix_moves_and_turns_its_lights) {
  const Scene scene = loaded(document(
      nodes(R"({"children": [1], "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 5,0,0,1]}, )" +
            lit(0, R"("translation": [1, 0, 0], "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476])")) +
      ", " + lights(k_spot)));
  const WorldLight light = world_lights(scene, 0.0).at(0);
  EXPECT_VEC3(light.position, 4, 0, 0);
  EXPECT_VEC3(light.direction, 1, 0, 0);  // -z turned to -x, mirrored to +x
}

TEST(GltfLights, a_spot_on_a_node_scaled_to_nothing_still_has_a_unit_direction) {
  EXPECT_VEC3(world_lights(loaded(spot_scene(R"("scale": [0, 0, 0])")), 0).at(0).direction, 0, 0, -1);
}

TEST(GltfLights, a_spot_deep_under_tiny_or_huge_scales_still_has_its_direction) {
  for (const char* scale : {"1e-30", "1e30"}) {
    std::string list;
    for (int i = 0; i < 6; ++i) {
      list += R"({"scale": [)" + std::string(scale) + ", " + scale + ", " + scale + R"(], "children": [)" +
              std::to_string(i + 1) + "]}, ";
    }
    const std::string quarter = R"("rotation": [0.7071067811865476, 0, 0, 0.7071067811865476])";
    EXPECT_VEC3(
        world_lights(loaded(document(nodes(list + lit(0, quarter)) + ", " + lights(k_spot))), 0).at(0).direction, 0, 1,
        0);
  }
}

TEST(GltfLights, one_definition_may_be_used_by_many_nodes) {
  const Scene scene =
      loaded(document(nodes(lit(0, R"("name": "a")") + ", " + lit(0, R"("translation": [0, 3, 0])") + ", " + lit(1)) +
                      ", " + lights(R"({"type": "point", "name": "lamp"}, )" + k_spot)));
  ASSERT_EQ(scene.lights.size(), 3U);
  EXPECT_EQ(scene.lights[0].name, "a");
  EXPECT_EQ(scene.lights[1].name, "lamp");
  EXPECT_EQ(scene.lights[2].name, "light 2");
  EXPECT_VEC3(world_lights(scene, 0).at(1).position, 0, 3, 0);
}

TEST(GltfLights, points_come_before_spots_and_directional_lights_are_left_out_of_the_world) {
  const Scene scene = loaded(document(nodes(lit(1) + ", " + lit(2) + ", " + lit(0)) + ", " +
                                      lights(k_point + ", " + k_spot + R"(, {"type": "directional"})")));
  const std::vector<WorldLight> world = world_lights(scene, 0.0);
  ASSERT_EQ(world.size(), 2U);
  EXPECT_EQ(world[0].type, LightType::point);
  EXPECT_EQ(world[0].rig_index, 2);
  EXPECT_EQ(world[1].type, LightType::spot);
  EXPECT_EQ(world[1].rig_index, 0);
  EXPECT_EQ(world[1].outer_cone_rad, 0.5);
  EXPECT_TRUE(std::isinf(scene.lights[1].range_m));
}

TEST(GltfLights, a_spot_without_angles_gets_the_extensions_defaults) {
  for (const char* spot : {R"({"type": "spot", "spot": {}})", R"({"type": "spot"})"}) {
    const Light light = loaded(document(nodes(lit(0)) + ", " + lights(spot))).lights.at(0);
    EXPECT_EQ(light.inner_cone_rad, 0.0);
    EXPECT_EQ(light.outer_cone_rad, k_pi / 4.0);
  }
}

TEST(GltfLights, half_a_turn_in_single_precision_is_a_half_space) {
  const Light light =
      loaded(document(nodes(lit(0)) + ", " + lights(R"({"type": "spot", "spot": {"outerConeAngle": 1.5707964}})")))
          .lights.at(0);
  EXPECT_EQ(light.outer_cone_rad, k_pi / 2.0);
}

TEST(GltfLights, a_light_of_an_unknown_type_is_left_out_with_a_warning) {
  const Scene scene = loaded(document(nodes(lit(0)) + ", " + lights(R"({"type": "area"})")));
  EXPECT_TRUE(scene.lights.empty());
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_NE(scene.warnings[0].find("/extensions/KHR_lights_punctual/lights/0/type"), std::string::npos);
}

TEST(GltfScenes, only_what_the_default_scene_holds_is_there) {
  const std::string two = nodes(lit(0, R"("name": "a")") + ", " + lit(0, R"("name": "b")")) + ", " + lights(k_point);
  const std::string scenes = R"(, "scenes": [{"nodes": [0]}, {"nodes": [1]}])";
  EXPECT_EQ(loaded(document(two + scenes + R"(, "scene": 1)")).lights.at(0).name, "b");
  EXPECT_EQ(loaded(document(two + scenes)).lights.at(0).name, "a");
  EXPECT_EQ(loaded(document(two)).lights.size(), 2U);
}

TEST(GltfScenes, parents_stand_before_their_children_whatever_the_files_order) {
  const Scene scene = loaded(
      document(nodes(R"({"name": "leaf"}, {"name": "middle", "children": [0]}, {"name": "root", "children": [1]})")));
  ASSERT_EQ(scene.nodes.size(), 3U);
  EXPECT_EQ(scene.nodes[0].name, "root");
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) EXPECT_LT(scene.nodes[i].parent, static_cast<int>(i));
}

TEST(GltfScenes, misspelt_extras_of_this_tool_are_told_with_what_was_meant) {
  const auto warning = [](const std::string& key) {
    const Scene scene =
        loaded(document(nodes(R"({"extras": {"mass": 3, ")" + key + R"(": {"half_extents": [1, 2, 3]}}})")));
    EXPECT_TRUE(scene.boxes.empty() || key == "clusterbench_box");
    return scene.warnings.empty() ? "none" : scene.warnings.front();
  };
  const std::string rest = "; nodes can have clusterbench_box, cameras clusterbench_sides";
  EXPECT_EQ(warning("clusterbench_box"), "none");
  EXPECT_EQ(warning("clusterbench_bxo"),
            "/nodes/0/extras/clusterbench_bxo: is not read (did you mean 'clusterbench_box'?)" + rest);
  EXPECT_EQ(warning("clusterbnch_box"),
            "/nodes/0/extras/clusterbnch_box: is not read (did you mean 'clusterbench_box'?)" + rest);
  EXPECT_NE(warning("Clusterbench-Box").find("is not read"), std::string::npos);
  EXPECT_EQ(warning("clusterbench_volume"),
            "/nodes/0/extras/clusterbench_volume: is not read (did you mean 'clusterbench_box'?)" + rest);
  EXPECT_EQ(warning("clusterbench_side"),
            "/nodes/0/extras/clusterbench_side: is not read (did you mean 'clusterbench_sides'?)" + rest);
  EXPECT_EQ(warning("clusterbench_sides"), "/nodes/0/extras/clusterbench_sides: is not read" + rest) << "on a node";
  EXPECT_EQ(warning("cluster"), "none") << "another program's";
  const Scene light = loaded(document(
      R"("extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "extras": {"clusterbench_range": 3}}]}})"));
  ASSERT_EQ(light.warnings.size(), 1u);
  EXPECT_NE(light.warnings[0].find("/lights/0/extras/clusterbench_range: is not read"), std::string::npos);
}

TEST(GltfScenes, a_box_comes_from_a_nodes_extras) {
  const Scene scene =
      loaded(document(nodes(R"({"name": "decal", "extras": {"clusterbench_box": {"half_extents": [1, 2, 0.5]}}})")));
  ASSERT_EQ(scene.boxes.size(), 1U);
  EXPECT_EQ(scene.boxes[0].half_extents_m, Vec3d(1, 2, 0.5));
  EXPECT_EQ(scene.boxes[0].name, "decal");
}

TEST(GltfScenes, images_materials_and_missing_buffers_that_nothing_reads_do_no_harm) {
  EXPECT_EQ(refusal(document(R"("images": [{"uri": "gone.ktx2"}, 7], "materials": "none", "meshes": [{}],
    "buffers": [{"uri": "gone.bin", "byteLength": 99}], "extensionsRequired": ["KHR_texture_basisu"])")),
            "loads");
}

TEST(GltfScenes, the_hash_is_that_of_the_file_and_of_the_external_buffers_it_reads) {
  const Folder folder;
  Animation keys = animation("translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 2, 3});
  keys.uri = "camera%20keys.bin";
  const std::string text =
      document(nodes(R"({"camera": 0})") + ", " + keys.text() +
               R"(, "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  folder.write("camera keys.bin", keys.times + keys.values);
  const Scene scene = load_gltf(folder.write("scene.gltf", text));
  EXPECT_EQ(scene.sha256, sha256_hex(text + keys.times + keys.values));
  EXPECT_EQ(scene.duration_s, 1.0);
  EXPECT_TRUE(scene.cameras.at(0).animated);
  EXPECT_EQ(scene.name, "scene");
}

TEST(GltfContainer, a_glb_gives_its_binary_chunk_to_the_buffer_without_a_uri) {
  const Animation keys = animation("translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 2, 3});
  std::string text = document(nodes("{}") + ", " + keys.text());
  const std::size_t uri = text.find(R"(, "uri": )");
  text.erase(uri, text.find("\"}]", uri) + 1 - uri);
  const Scene scene =
      loaded(glb(chunk("JSON", text, ' ') + chunk(std::string("BIN\0", 4), keys.times + keys.values, '\0')), "a.glb");
  EXPECT_VEC3(Vec3d(world_transforms(scene, 0.5).at(0)[3]), 0.5, 1, 1.5);
  EXPECT_EQ(refusal(glb(chunk("JSON", text, ' ')), "a.glb"),
            "/buffers/0: has no uri, and there is no BIN chunk for it");
}

TEST(GltfAnimations, an_animated_light_moves_with_the_node_above_it) {
  const Scene scene = loaded(
      document(nodes(R"({"children": [1], "scale": [2, 2, 2]}, )" + lit(0, R"("translation": [1, 0, 0])")) + ", " +
               lights(k_point) + ", " + animation("translation", "LINEAR", {1, 3}, {0, 0, 0, 0, 8, 0}).text()));
  EXPECT_VEC3(world_lights(scene, 0.0).at(0).position, 2, 0, 0);
  EXPECT_VEC3(world_lights(scene, 2.0).at(0).position, 2, 4, 0);
  EXPECT_VEC3(world_lights(scene, 9.0).at(0).position, 2, 8, 0);
  EXPECT_EQ(scene.duration_s, 3.0);
}

TEST(GltfAnimations, rotations_may_be_normalized_integers) {
  Animation keys = animation("rotation", "LINEAR", {0}, {0, 0, 0, 1});
  const auto direction = [&] {
    return world_lights(loaded(document(nodes(lit(0)) + ", " + lights(k_spot) + ", " + keys.text())), 0)
        .at(0)
        .direction;
  };
  // A half turn about y: -z becomes +z.
  keys.values = bytes_of<std::int8_t>({0, -127, 0, 0});
  keys.values_format = R"("componentType": 5120, "normalized": true, "type": "VEC4")";
  EXPECT_VEC3(direction(), 0, 0, 1);
  keys.values = bytes_of<std::int16_t>({0, -32768, 0, 0});
  keys.values_format = R"("componentType": 5122, "normalized": true, "type": "VEC4")";
  EXPECT_VEC3(direction(), 0, 0, 1);
  keys.values = bytes_of<std::uint16_t>({65535, 0, 0, 0});  // about x: -z becomes +z as well
  keys.values_format = R"("componentType": 5123, "normalized": true, "type": "VEC4")";
  EXPECT_VEC3(direction(), 0, 0, 1);
}

TEST(GltfAnimations, sparse_values_replace_those_they_name) {
  Animation keys = animation("translation", "STEP", {0, 1, 2}, {1, 1, 1, 2, 2, 2, 3, 3, 3});
  const std::string index = base64(std::string("\x01\0\0\0", 4)), value = base64(bytes_of<float>({7, 8, 9}));
  std::string text = keys.text();
  text.insert(text.find("}], \"bufferViews\""),
              R"(, "sparse": {"count": 1, "indices": {"bufferView": 2, "componentType": 5121},
    "values": {"bufferView": 3}})");
  text.insert(text.find("], \"buffers\""), R"(, {"buffer": 1, "byteLength": 4}, {"buffer": 2, "byteLength": 12})");
  text.insert(text.rfind(']'), R"(, {"byteLength": 4, "uri": "data:application/octet-stream;base64,)" + index +
                                   R"("}, {"byteLength": 12, "uri": "data:application/octet-stream;base64,)" + value +
                                   R"("})");
  const Scene scene = loaded(document(nodes("{}") + ", " + text));
  EXPECT_VEC3(Vec3d(scene.channels.at(0).values.at(0)), 1, 1, 1);
  EXPECT_VEC3(Vec3d(scene.channels.at(0).values.at(1)), 7, 8, 9);
  EXPECT_VEC3(Vec3d(scene.channels.at(0).values.at(2)), 3, 3, 3);
}

TEST(GltfAnimations, of_two_animations_of_the_same_thing_the_later_wins_with_a_warning) {
  std::string text = animation("translation", "STEP", {0, 1}, {1, 0, 0, 2, 0, 0}).text();
  text.insert(text.find("], \"accessors\""),
              R"(, {"samplers": [{"input": 0, "output": 1}], "channels": [{"sampler": 0, "target":
    {"node": 0, "path": "translation"}}]})");
  const Scene scene = loaded(document(nodes("{}") + ", " + text));
  ASSERT_EQ(scene.channels.size(), 1U);
  EXPECT_EQ(scene.channels[0].interpolation, Interpolation::linear);
  ASSERT_EQ(scene.warnings.size(), 2U);
  EXPECT_NE(scene.warnings[0].find("/animations/1"), std::string::npos);
  EXPECT_NE(scene.warnings[1].find("/animations: 2 animations, played together"), std::string::npos);
}

TEST(GltfAnimations, weights_and_pointers_are_ignored_with_a_warning) {
  for (const char* path : {"weights", "pointer"}) {
    Animation keys = animation("translation", "LINEAR", {0}, {0, 0, 0});
    keys.path = path;
    const Scene scene = loaded(document(nodes("{}") + ", " + keys.text()));
    EXPECT_TRUE(scene.channels.empty());
    EXPECT_EQ(scene.warnings.size(), 1U) << path;
  }
}

Scene camera_scene(const std::string& node, const std::string& projection) {
  return loaded(document(nodes(node) + R"(, "cameras": [)" + projection + "]"));
}

const std::string k_projection = R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}})";

TEST(GltfCameras, a_projection_is_as_the_file_gives_it) {
  const CameraProjection open = camera_scene(R"({"camera": 0})", k_projection).cameras.at(0).projection;
  EXPECT_FALSE(open.orthographic);
  EXPECT_EQ(open.yfov_rad, 1.0);
  EXPECT_EQ(open.near_m, 0.1);
  EXPECT_TRUE(std::isinf(open.far_m));
  const CameraProjection closed =
      camera_scene(R"({"camera": 0})",
                   R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 50}})")
          .cameras.at(0)
          .projection;
  EXPECT_EQ(closed.far_m, 50.0);
  const CameraProjection flat =
      camera_scene(R"({"camera": 0})",
                   R"({"type": "orthographic", "orthographic": {"xmag": 4, "ymag": 3, "znear": 0, "zfar": 9}})")
          .cameras.at(0)
          .projection;
  EXPECT_TRUE(flat.orthographic);
  EXPECT_EQ(flat.xmag_m, 4.0);
  EXPECT_EQ(flat.ymag_m, 3.0);
  EXPECT_EQ(flat.near_m, 0.0);
  EXPECT_EQ(flat.far_m, 9.0);
}

void expect_orthonormal(const Mat3d& m) {
  const Mat3d square = m * glm::transpose(m);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(square[i][k], i == k ? 1.0 : 0.0, 1e-15);
  }
  EXPECT_NEAR(glm::determinant(m), 1.0, 1e-14);  // right-handed: nothing mirrored
}

TEST(GltfCameras, scale_shear_and_mirroring_are_taken_out_of_a_pose) {
  const std::string turned =
      R"({"camera": 0, "rotation": [0.1825741858350554, 0.3651483716701107, 0.5477225575051661, 0.7302967433402214]})";
  for (const char* above : {R"("scale": [3, 0.2, 7])", R"("scale": [-1, 1, 1])", R"("scale": [1e-30, 1e30, -5])",
                            R"("scale": [1, 1, 1])", R"("scale": [0, 0, 0])", R"("scale": [1, 0, 1])"}) {
    const Scene scene = camera_scene(std::string(R"({"children": [1], )") + above + "}, " + turned, k_projection);
    const CameraPose pose = camera_pose(scene, scene.cameras.at(0), 0.0);
    expect_orthonormal(pose.view_from_world);
    if (std::string(above).find("[0") != std::string::npos || std::string(above).find(" 0,") != std::string::npos)
      continue;
    const Vec3d z(world_transforms(scene, 0.0).at(1)[2]);
    const Vec3d seen = pose.view_from_world * (z / glm::length(z));
    EXPECT_VEC3(seen, 0, 0, 1);  // it looks along the world matrix's -z
  }
}

TEST(GltfCameras, a_scale_of_zero_turns_no_camera_and_no_light) {
  const std::string rotation = R"("rotation": [0, 0.7071067811865476, 0, 0.7071067811865476])";
  const std::string lamp = R"(, "extensions": {"KHR_lights_punctual": {"light": 0}})";
  for (const char* scale : {"[0, 0, 0]", "[1, 1, 0]", "[0, 1, 1]", "[1, 0, 1]", "[1, 1, 1]"}) {
    const std::string flat = std::string(R"("scale": )") + scale;
    for (const std::string& both :
         {R"({"children": [1], )" + flat + "}, {" + rotation, R"({"children": [1], )" + rotation + "}, {" + flat}) {
      SCOPED_TRACE(both);
      const Scene camera = camera_scene(both + R"(, "camera": 0})", k_projection);
      const CameraPose pose = camera_pose(camera, camera.cameras.at(0), 0.0);
      EXPECT_VEC3(pose.view_from_world * Vec3d(-1, 0, 0), 0, 0, -1);
      EXPECT_VEC3(pose.view_from_world * Vec3d(0, 1, 0), 0, 1, 0);
      const Scene light = loaded(document(nodes(both + lamp + "}") + ", " + lights(R"({"type": "spot", "range": 5})")));
      EXPECT_VEC3(world_lights(light, 0.0).at(0).direction, -1, 0, 0);
    }
  }
}

TEST(GltfCameras, an_unscaled_pose_is_the_inverse_of_the_nodes_rotation) {
  const Scene scene = camera_scene(
      R"({"camera": 0, "translation": [1, 2, 3], "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476]})",
      k_projection);
  const CameraPose pose = camera_pose(scene, scene.cameras.at(0), 0.0);
  EXPECT_VEC3(pose.eye, 1, 2, 3);
  EXPECT_VEC3(pose.view_from_world * Vec3d(-1, 0, 0), 0, 0, -1);  // it looks along world -x
  EXPECT_VEC3(pose.view_from_world * Vec3d(0, 1, 0), 0, 1, 0);
  EXPECT_VEC3(pose.view_from_world * Vec3d(0, 0, -1), 1, 0, 0);
}

TEST(Ranges, a_given_range_stays_and_a_missing_one_comes_from_intensity_and_cutoff) {
  Scene scene = loaded(document(
      nodes(lit(0) + ", " + lit(1) + ", " + lit(2) + ", " + lit(3) + ", " + lit(4)) + ", " +
      lights(
          R"({"type": "point", "range": 1000}, {"type": "point", "intensity": 20, "color": [0.1, 0.2, 0]}, {"type": "point", "intensity": 1e9},
         {"type": "point", "color": [0, 0, 0]}, {"type": "directional"})")));
  resolve_ranges(scene, RangeRule{0.01, 50.0});
  EXPECT_EQ(scene.lights[0].range_m, 1000.0);
  EXPECT_EQ(scene.lights[0].range_source, RangeSource::given);
  EXPECT_NEAR(scene.lights[1].range_m, 20.0, k_tiny);  // 20 cd * 0.2 / 20² m² = 0.01 lx
  EXPECT_EQ(scene.lights[1].range_source, RangeSource::from_intensity);
  EXPECT_EQ(scene.lights[2].range_m, 50.0);
  EXPECT_EQ(scene.lights[2].range_source, RangeSource::clamped_to_max);
  EXPECT_EQ(scene.lights[3].range_m, 0.0);
  EXPECT_TRUE(std::isinf(scene.lights[4].range_m));
}

TEST(Ranges, a_range_of_zero_is_that_of_the_rule_with_a_warning) {
  Scene scene = loaded(document(nodes(lit(0)) + ", " + lights(R"({"type": "point", "range": 0})")));
  EXPECT_EQ(scene.warnings.size(), 1U);
  resolve_ranges(scene, RangeRule{1.0, 100.0});
  EXPECT_EQ(scene.lights[0].range_m, 1.0);
  EXPECT_EQ(scene.lights[0].range_source, RangeSource::from_intensity);
}

}  // namespace
}  // namespace clusterbench::scene::test
