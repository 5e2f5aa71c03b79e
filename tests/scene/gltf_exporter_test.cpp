// Files as exporters write them: what is wrong by the letter of glTF but clear is loaded with a warning.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "gltf_fixture.h"
#include "scene/camera_path.h"
#include "scene/summary.h"

namespace clusterbench::scene::test {
namespace {

// One node per light definition, and what else the document has.
std::string lit_scene(const std::string& definitions, std::size_t count = 1, const std::string& more = "") {
  std::string list;
  for (std::size_t i = 0; i < count; ++i)
    list += (i > 0 ? ", " : "") + (R"({"extensions": {"KHR_lights_punctual": {"light": )" + std::to_string(i)) + "}}}";
  return document(R"("nodes": [)" + list + R"(], "extensions": {"KHR_lights_punctual": {"lights": [)" + definitions +
                  "]}}" + (more.empty() ? "" : ", " + more));
}

void expect_one_warning(const Scene& scene, const std::string& says) {
  ASSERT_EQ(scene.warnings.size(), 1U) << says;
  EXPECT_NE(scene.warnings[0].find(says), std::string::npos) << scene.warnings[0];
}

TEST(GltfAsExported, a_spot_with_a_hard_edge_has_equal_angles) {
  for (const char* inner : {"0.5", "0.5000004"}) {
    const Scene scene = loaded(lit_scene(R"({"type": "spot", "spot": {"outerConeAngle": 0.5, "innerConeAngle": )" +
                                         std::string(inner) + "}}"));
    EXPECT_EQ(scene.lights.at(0).outer_cone_rad, 0.5);
    EXPECT_EQ(scene.lights.at(0).inner_cone_rad, 0.5);
    expect_one_warning(scene, "/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle: innerConeAngle is");
  }
  const std::string half_space =
      R"({"type": "spot", "spot": {"innerConeAngle": 1.5707964, "outerConeAngle": 1.5707964}})";
  EXPECT_EQ(loaded(lit_scene(half_space)).lights.at(0).inner_cone_rad, std::numbers::pi / 2.0);
}

TEST(GltfAsExported, a_range_of_the_largest_float_is_no_range) {
  for (const char* range : {"3.4028235e+38", "3.4028234663852886e+38"}) {
    const Scene scene = loaded(lit_scene(R"({"type": "point", "range": )" + std::string(range) + "}"));
    EXPECT_FALSE(scene.lights.at(0).range_given_m);
    expect_one_warning(scene, "/lights/0/range: the largest number of single precision; read as no range");
  }
  EXPECT_EQ(loaded(lit_scene(R"({"type": "point", "range": 3.4e38})")).lights.at(0).range_given_m, 3.4e38);
}

TEST(GltfAsExported, a_zfar_of_the_largest_float_is_infinitely_far) {
  for (const char* camera :
       {R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 3.4028235e+38}})",
        R"({"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 3.4028235e+38}})"}) {
    const Scene scene = loaded(document(R"("nodes": [{"camera": 0}], "cameras": [)" + std::string(camera) + "]"));
    EXPECT_TRUE(std::isinf(scene.cameras.at(0).projection.far_m));
    expect_one_warning(scene, "zfar: the largest number of single precision; read as infinitely far");
  }
}

TEST(GltfAsExported, what_only_a_strict_schema_minds_is_loaded_with_a_warning) {
  const struct {
    const char *members, *says;
  } cases[] = {
      {R"("nodes": [])", "/nodes: an empty array"},
      {R"("nodes": [{"children": []}])", "/nodes/0/children: an empty array"},
      {R"("nodes": [{"name": null}])", "/nodes/0/name: null"},
      {R"("scenes": [])", "/scenes: an empty array"},
      {R"("scenes": [{"nodes": []}])", "/scenes/0/nodes: an empty array"},
      {R"("cameras": [])", "/cameras: an empty array"},
      {R"("animations": [])", "/animations: an empty array"},
      {R"("animations": [{"samplers": [], "channels": []}])", "/animations/0/samplers: an empty array"},
      {R"("extensionsRequired": [])", "/extensionsRequired: an empty array"},
      {R"("extensions": {"KHR_lights_punctual": {"lights": []}})",
       "/extensions/KHR_lights_punctual/lights: an empty array"},
      {R"("extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "color": [1, 1, 1, 1]}]}})",
       "/extensions/KHR_lights_punctual/lights/0/color: found 4 numbers"},
  };
  for (const auto& element : cases) {
    const Scene scene = loaded(document(element.members));
    ASSERT_FALSE(scene.warnings.empty()) << element.says;
    EXPECT_EQ(scene.warnings[0].find(element.says), 0U) << scene.warnings[0];
  }
}

TEST(GltfAsExported, key_times_without_bounds_and_animations_without_keys_load_with_a_warning) {
  Animation keys = animation("translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 1, 1});
  keys.times_format = R"("componentType": 5126, "type": "SCALAR", "max": [1])";
  Scene scene = loaded(document(R"("nodes": [{}], )" + keys.text()));
  EXPECT_EQ(scene.channels.size(), 1U);
  expect_one_warning(scene, "/accessors/0: 'min' is missing");
  keys = animation("translation", "LINEAR", {0}, {0, 0, 0});
  keys.keys = keys.elements = 0;
  scene = loaded(document(R"("nodes": [{}], )" + keys.text()));
  EXPECT_TRUE(scene.channels.empty());
  expect_one_warning(scene, "/animations/0/samplers/0: its accessors hold no data");
}

TEST(GltfAsExported, faults_of_nodes_that_are_not_loaded_are_warnings) {
  const auto two_scenes = [](const std::string& others, const std::string& second) {
    return document(R"("nodes": [{"translation": [1, 2, 3]}, )" + others +
                    R"(], "scene": 0, "scenes": [{"nodes": [0]}, )" + second + "]");
  };
  const struct {
    std::string text, says;
  } cases[] = {
      {two_scenes(R"({"rotation": [0, 0, 0, 2]})", R"({"nodes": [1]})"),
       "/nodes/1: /nodes/1/rotation: a rotation must"},
      {two_scenes(R"({"children": [9]})", R"({"nodes": [1]})"), "/nodes/1: /nodes/1/children/0: refers to node 9"},
      {two_scenes(R"({"children": [2]}, {"children": [1]})", R"({})"), "/nodes/1: the node is its own ancestor"},
      {two_scenes(R"({"children": [3]}, {"children": [3]}, {})", R"({})"), "/nodes/2/children/0: node 3 already has"},
      {two_scenes("{}", R"({"nodes": [7]})"), "/scenes/1: /scenes/1/nodes/0: refers to node 7"},
      {two_scenes("{}", "7"), "/scenes/1: /scenes/1: found the number 7"},
  };
  for (const auto& element : cases) {
    const Scene scene = loaded(element.text);
    ASSERT_EQ(scene.nodes.size(), 1U);
    EXPECT_EQ(scene.nodes[0].translation.z, 3.0);
    ASSERT_FALSE(scene.warnings.empty()) << element.says;
    EXPECT_EQ(scene.warnings[0].find(element.says), 0U) << scene.warnings[0];
  }
}

TEST(GltfAsExported, faults_of_nodes_that_are_loaded_are_refused_whatever_the_number_of_scenes) {
  const std::string scenes = R"(, "scenes": [{"nodes": [0]}, {"nodes": [1]}], "scene": 1)";
  EXPECT_EQ(refusal(document(R"("nodes": [{}, {"rotation": [0, 0, 0, 2]}])" + scenes)).find("/nodes/1/rotation"), 0U);
  EXPECT_EQ(refusal(document(R"("nodes": [{}, {"children": [2]}, {"rotation": [0, 0, 0, 2]}])" + scenes))
                .find("/nodes/2/rotation"),
            0U);
  // A root below a node that the scene holds, too, would stand there twice.
  EXPECT_EQ(refusal(document(R"("nodes": [{"children": [1]}, {}], "scenes": [{"nodes": [0, 1]}])"))
                .find("/scenes/0/nodes/1: node 1 has a parent"),
            0U);
}

TEST(GltfAsExported, a_root_below_a_node_that_the_scene_does_not_hold_is_a_root) {
  const std::string scenes = R"(, "scenes": [{"nodes": [1]}])";
  Scene scene = loaded(document(R"("nodes": [{"children": [1]}, {"translation": [1, 2, 3]}])" + scenes));
  ASSERT_EQ(scene.nodes.size(), 1U);
  EXPECT_EQ(world_transforms(scene, 0.0)[0][3].z, 3.0);
  expect_one_warning(scene,
                     "/scenes/0/nodes/0: node 1 has the parent 0, which does not stand in the scene; read as a "
                     "root");
  EXPECT_EQ(scene.warnings[0].find("transform"), std::string::npos);
  scene = loaded(document(R"("nodes": [{"children": [1], "scale": [2, 2, 2]}, {"translation": [1, 2, 3]}])" + scenes));
  EXPECT_EQ(world_transforms(scene, 0.0)[0][3].z, 3.0);
  expect_one_warning(scene, "read as a root, without that parent's transform");
}

TEST(GltfAsExported, keys_of_an_animation_with_a_stride_are_read_by_it) {
  Animation keys = animation("translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 2, 3});
  const auto strided = [&](const std::string& stride) {
    std::string text = document(R"("nodes": [{}], )" + keys.text());
    const std::string part = R"("byteOffset": 8, )";
    return text.replace(text.find(part), part.size(), part + R"("byteStride": )" + stride + ", ");
  };
  for (const auto& [stride, says] : {std::pair("12", "/bufferViews/1/byteStride: a stride on keys of an animation"),
                                     std::pair("0", "/bufferViews/1/byteStride: found 0, where glTF asks")}) {
    const Scene scene = loaded(strided(stride));
    EXPECT_EQ(world_transforms(scene, 1.0)[0][3].z, 3.0) << stride;
    expect_one_warning(scene, says);
  }
  keys = animation("translation", "LINEAR", {0, 1}, {0, 0, 0, 9, 1, 2, 3});
  keys.elements = 2;
  EXPECT_EQ(world_transforms(loaded(strided("16")), 1.0)[0][3].x, 1.0);
  EXPECT_EQ(refusal(strided("8")).find("/accessors/1: elements of 12 bytes do not fit into a byteStride of 8"), 0U);
}

TEST(GltfAsExported, odd_key_times_are_refused_only_where_a_light_or_a_camera_moves) {
  const auto text = [](const std::string& nodes, const std::vector<float>& times, const std::string& how = "LINEAR") {
    std::vector<float> values;
    for (std::size_t i = 0; i < times.size() * (how == "CUBICSPLINE" ? 3 : 1); ++i)
      values.insert(values.end(), {static_cast<float>(i), 0, 0});
    return document(R"("nodes": [)" + nodes + R"(], "cameras": [{"type": "perspective", "perspective": {"yfov": 1, )" +
                    R"("znear": 1}}], )" + animation("translation", how, times, values).text());
  };
  const std::string mesh = "{}", carrier = R"({"children": [1]}, {"camera": 0})";
  Scene scene = loaded(text(mesh, {0, 1, 1, 2}));
  expect_one_warning(scene,
                     "/animations/0/samplers/0/input: key times must ascend: key 2 is at 1.000000 s, the one "
                     "before at 1.000000 s; it moves neither light nor camera, so the later of the two holds");
  EXPECT_EQ(world_transforms(scene, 0.5)[0][3].x, 0.5);
  EXPECT_EQ(world_transforms(scene, 1.0)[0][3].x, 2.0);
  EXPECT_EQ(world_transforms(scene, 1.5)[0][3].x, 2.5);
  scene = loaded(text(mesh, {0, 0, 1}, "CUBICSPLINE"));
  EXPECT_TRUE(std::isfinite(world_transforms(scene, 0.0)[0][3].x));
  scene = loaded(text(mesh, {-1, 1}));
  expect_one_warning(scene, "the first key time is -1.000000, 0 or more is needed; it moves neither");
  EXPECT_EQ(world_transforms(scene, 0.0)[0][3].x, 0.5);
  scene = loaded(text(mesh, {0, 2, 1}));
  expect_one_warning(scene, "so the channel is ignored");
  EXPECT_TRUE(scene.channels.empty());
  for (const std::vector<float>& times : {std::vector<float>{0, 1, 1}, std::vector<float>{-1, 1}})
    EXPECT_EQ(refusal(text(carrier, times)).find("/animations/0/samplers/0/input: "), 0U);
}

TEST(GltfAsExported, a_byte_order_mark_is_skipped) {
  const std::string mark = "\xEF\xBB\xBF";
  expect_one_warning(loaded(mark + document("")), "/: begins with a byte order mark");
  EXPECT_EQ(refusal(mark + "{").find("byte 4: is not JSON"), 0U);
}

TEST(GltfAsExported, cone_angles_beside_the_spot_are_read) {
  Scene scene = loaded(lit_scene(R"({"type": "spot", "innerConeAngle": 0.02, "outerConeAngle": 0.05})"));
  EXPECT_EQ(scene.lights.at(0).outer_cone_rad, 0.05);
  EXPECT_EQ(scene.lights.at(0).inner_cone_rad, 0.02);
  expect_one_warning(scene, "/extensions/KHR_lights_punctual/lights/0: cone angles beside 'spot'");
  scene = loaded(lit_scene(R"({"type": "spot", "outerConeAngle": 0.05, "spot": {"outerConeAngle": 0.5}})"));
  EXPECT_EQ(scene.lights.at(0).outer_cone_rad, 0.5);
  expect_one_warning(scene, "cone angles both in 'spot' and beside it");
  EXPECT_EQ(refusal(lit_scene(R"({"type": "spot", "outerConeAngle": 5})"))
                .find("/extensions/KHR_lights_punctual/lights/0/outerConeAngle: found 5"),
            0U);
  EXPECT_EQ(refusal(lit_scene(R"({"type": "spot", "spot": 5})")).find("/extensions/KHR_lights_punctual/lights/0/spot"),
            0U);
}

TEST(GltfWarnings, that_differ_in_numbers_alone_are_one_with_a_count) {
  std::string list;
  for (int i = 0; i < 70; ++i) list += std::string(i > 0 ? ", " : "") + R"({"type": "point", "range": 0})";
  expect_one_warning(
      loaded(lit_scene(list, 70)),
      "/extensions/KHR_lights_punctual/lights/0/range: a range of 0, where glTF asks for more; read as no "
      "range, so that the range rule gives one (and 69 more like it)");
}

TEST(GltfWarnings, of_different_kinds_end_in_a_count_after_a_hundred) {
  std::string list;
  for (char a = 'a'; a <= 'z'; ++a)
    for (char b = 'a'; b <= 'e'; ++b) list += std::string(list.empty() ? "\"" : ", \"") + a + b + "\"";
  const Scene scene = loaded(document(R"("extensionsRequired": [)" + list + "]"));
  ASSERT_EQ(scene.warnings.size(), 101U);
  EXPECT_EQ(scene.warnings.back(), "and 30 more warnings");
}

TEST(GltfNames, cameras_of_one_name_are_told_apart) {
  const Scene scene = loaded(document(
      R"("nodes": [{"name": "a", "camera": 0}, {"name": "a", "camera": 0}, {"name": "a-2", "camera": 0}],
         "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])"));
  ASSERT_EQ(scene.cameras.size(), 3U);
  EXPECT_EQ(scene.cameras[0].name, "a");
  EXPECT_EQ(scene.cameras[1].name, "a-2");
  EXPECT_EQ(scene.cameras[2].name, "a-2-2");
}

// Node 0 above node 1 with a light; `upper` and `lower` are what KHR_node_visibility says of them.
std::string hidden_scene(const std::string& upper, const std::string& lower, const std::string& more = "") {
  return document(R"("nodes": [{"children": [1], "extensions": {"KHR_node_visibility": )" + upper +
                  R"(}}, {"name": "lamp", "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0},
      "KHR_node_visibility": )" +
                  lower + R"(}}], "extensionsRequired": ["KHR_node_visibility"],
      "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "range": 5}]}})" +
                  (more.empty() ? "" : ", " + more));
}

TEST(GltfVisibility, lights_of_invisible_nodes_and_of_nodes_below_them_are_left_out_and_cameras_stay) {
  const std::string no = R"({"visible": false})", yes = R"({"visible": true})", unsaid = "{}";
  for (const auto& [upper, lower] : {std::pair(no, yes), std::pair(no, unsaid), std::pair(yes, no)}) {
    const Scene scene = loaded(hidden_scene(upper, lower));
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_EQ(scene.cameras.size(), 1U);
    expect_one_warning(scene, "1 light of invisible nodes (KHR_node_visibility) not rendered, so left out: 'lamp'");
  }
  const Scene scene = loaded(hidden_scene(yes, unsaid));
  EXPECT_EQ(scene.lights.size(), 1U);
  EXPECT_TRUE(scene.warnings.empty());
}

// An animation by a pointer; scalars unless `components` says otherwise.
Animation pointed(const std::string& pointer, const std::string& interpolation, const std::vector<float>& times,
                  const std::vector<float>& values, std::size_t components = 1) {
  Animation out = animation("pointer", interpolation, times, values);
  out.pointer = pointer;
  out.elements = values.size() / components;
  out.values_format = R"("componentType": 5126, "type": )" + std::string(components == 1   ? R"("SCALAR")"
                                                                         : components == 3 ? R"("VEC3")"
                                                                                           : R"("VEC4")");
  return out;
}

TEST(GltfVisibility, a_light_of_a_node_that_hides_has_a_range_of_zero_while_it_is_hidden) {
  Animation keys = pointed("/nodes/0/extensions/KHR_node_visibility/visible", "STEP", {0, 1, 2}, {0, 0, 0});
  keys.values = std::string("\0\1\0", 3);
  keys.elements = 3;
  keys.values_format = R"("componentType": 5121, "type": "SCALAR")";
  const Scene scene = loaded(hidden_scene("{}", "{}", keys.text()));
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_FALSE(scene.cameras.at(0).animated);
  for (const auto& [time, range] : {std::pair(0.0, 0.0), std::pair(1.0, 5.0), std::pair(1.9, 5.0), std::pair(2.0, 0.0)})
    EXPECT_EQ(world_lights(scene, time).at(0).range_m, range) << time;
  PathRequest every_key;
  every_key.choice = FrameChoice::keys;
  EXPECT_EQ(camera_paths(scene, every_key).at(0).shots.size(), 3U);
}

TEST(GltfVisibility, of_a_node_that_shows_itself_does_not_help_below_one_that_hides) {
  Animation keys = pointed("/nodes/1/extensions/KHR_node_visibility/visible", "STEP", {0}, {0});
  keys.values = std::string("\1", 1);
  keys.elements = 1;
  keys.values_format = R"("componentType": 5121, "type": "SCALAR")";
  EXPECT_TRUE(loaded(hidden_scene(R"({"visible": false})", "{}", keys.text())).lights.empty());
  const Scene shown = loaded(hidden_scene("{}", R"({"visible": false})", keys.text()));
  EXPECT_EQ(world_lights(shown, 0.0).at(0).range_m, 5.0);
  keys.values = std::string("\0", 1);
  EXPECT_EQ(world_lights(loaded(hidden_scene("{}", "{}", keys.text())), 0.0).at(0).range_m, 0.0);
}

TEST(GltfVisibility, that_would_lie_between_two_values_is_refused) {
  Animation keys = pointed("/nodes/0/extensions/KHR_node_visibility/visible", "LINEAR", {0, 1}, {0});
  keys.values = std::string("\0\1", 2);
  keys.elements = 2;
  keys.values_format = R"("componentType": 5121, "type": "SCALAR")";
  EXPECT_EQ(refusal(hidden_scene("{}", "{}", keys.text())).find("/animations/0/samplers/0: visibility"), 0U);
  keys.interpolation = "STEP";
  keys.values_format = R"("componentType": 5121, "normalized": true, "type": "SCALAR")";
  EXPECT_EQ(refusal(hidden_scene("{}", "{}", keys.text())).find("/animations/0/samplers/0/output: visibility"), 0U);
}

const std::string k_eight_candela =
    R"({"type": "spot", "intensity": 8, "spot": {"innerConeAngle": 0.4, "outerConeAngle": 0.5}})";
const std::string k_first_light = "/extensions/KHR_lights_punctual/lights/0/";

// The first light at a time, after a channel to that pointer.
WorldLight moved(const Animation& keys, double time_s, const std::string& light = k_eight_candela) {
  Scene scene = loaded(lit_scene(light, 1, keys.text()));
  EXPECT_TRUE(scene.warnings.empty());
  resolve_ranges(scene, RangeRule{0.02, 100.0});
  return world_lights(scene, time_s).at(0);
}

TEST(GltfPointers, to_a_node_move_it_like_a_core_channel) {
  EXPECT_EQ(moved(pointed("/nodes/0/translation", "LINEAR", {0, 2}, {0, 0, 0, 4, 0, 8}, 3), 1.0).position.z, 4.0);
  const float h = std::sqrt(0.5F);
  const Vec3d turned = moved(pointed("/nodes/0/rotation", "STEP", {0}, {h, 0, 0, h}, 4), 0.0).direction;
  EXPECT_NEAR(turned.y, 1.0, 1e-6);
  EXPECT_EQ(moved(pointed("/nodes/0/scale", "STEP", {0}, {1, 1, -1}, 3), 0.0).direction.z, 1.0);
}

TEST(GltfPointers, to_a_light_change_its_range_and_cone_in_every_frame) {
  const Animation range = pointed(k_first_light + "range", "LINEAR", {0, 2}, {2, 6});
  EXPECT_EQ(moved(range, 0.0).range_m, 2.0);
  EXPECT_EQ(moved(range, 1.0).range_m, 4.0);
  EXPECT_EQ(moved(range, 9.0).range_m, 6.0);
  const Animation cone = pointed(k_first_light + "spot/outerConeAngle", "LINEAR", {0, 2}, {0.5F, 1.5F});
  EXPECT_EQ(moved(cone, 1.0).outer_cone_rad, 1.0);
  EXPECT_EQ(moved(pointed(k_first_light + "spot/innerConeAngle", "STEP", {0}, {0.1F}), 0.0).outer_cone_rad, 0.5);
}

TEST(GltfPointers, to_intensity_and_colour_change_the_range_that_follows_from_them) {
  EXPECT_DOUBLE_EQ(moved(pointed(k_first_light + "intensity", "LINEAR", {0, 2}, {0, 64}), 0.5).range_m,
                   std::sqrt(16.0 / 0.02));
  EXPECT_DOUBLE_EQ(moved(pointed(k_first_light + "intensity", "STEP", {0}, {1e9F}), 0.5).range_m, 100.0);
  const Animation colour = pointed(k_first_light + "color", "STEP", {0, 1}, {1, 1, 1, 0, 0.25F, 0}, 3);
  EXPECT_DOUBLE_EQ(moved(colour, 1.0).range_m, std::sqrt(2.0 / 0.02));
  const std::string given = R"({"type": "point", "range": 3})";
  EXPECT_EQ(moved(pointed(k_first_light + "intensity", "STEP", {0}, {64}), 0.0, given).range_m, 3.0);
}

TEST(GltfPointers, to_lights_are_seen_by_a_standing_camera) {
  const Scene scene = loaded(document(R"("nodes": [{"camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}, )" +
                                      pointed(k_first_light + "range", "LINEAR", {1, 3}, {2, 6}).text()));
  EXPECT_FALSE(scene.cameras.at(0).animated);
  EXPECT_EQ(scene.duration_s, 3.0);
  PathRequest request;
  request.count = 3;
  const std::vector<Shot> shots = camera_paths(scene, request).at(0).shots;
  ASSERT_EQ(shots.size(), 3U);
  EXPECT_EQ(shots[0].time_s, 1.0);
  EXPECT_EQ(shots[2].time_s, 3.0);
}

TEST(GltfPointers, move_every_light_of_a_definition_and_no_other) {
  const std::string keys = pointed(k_first_light + "range", "STEP", {0}, {9}).text();
  const std::string text = document(
      R"("nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}, {"extensions": {"KHR_lights_punctual": {"light": 1}}},
        {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "range": 1}, {"type": "point", "range": 2}]}}, )" +
      keys);
  const std::vector<WorldLight> lights = world_lights(loaded(text), 0.0);
  EXPECT_EQ(lights.at(0).range_m, 9.0);
  EXPECT_EQ(lights.at(1).range_m, 2.0);
  EXPECT_EQ(lights.at(2).range_m, 9.0);
}

TEST(GltfPointers, that_swing_below_nothing_in_a_spline_stop_at_nothing) {
  const Animation range = pointed(k_first_light + "range", "CUBICSPLINE", {0, 1}, {0, 1, -50, 50, 1, 0});
  EXPECT_EQ(moved(range, 0.5).range_m, 0.0);
  const Animation cone = pointed(k_first_light + "spot/outerConeAngle", "CUBICSPLINE", {0, 1}, {0, 1, 50, -50, 1, 0});
  EXPECT_EQ(moved(cone, 0.5).outer_cone_rad, std::numbers::pi / 2.0);
  const Animation shut = pointed(k_first_light + "spot/outerConeAngle", "STEP", {0}, {0});
  EXPECT_EQ(moved(shut, 0.5).range_m, 0.0);
}

TEST(GltfPointers, to_an_endless_range_leave_it_to_the_rule) {
  const float endless = std::numeric_limits<float>::max();
  EXPECT_DOUBLE_EQ(moved(pointed(k_first_light + "range", "STEP", {0, 1}, {3, endless}), 1.0).range_m,
                   std::sqrt(8.0 / 0.02));
}

TEST(GltfPointers, to_values_that_no_light_can_have_are_refused_at_their_sampler) {
  const auto outcome = [](const Animation& keys) { return refusal(lit_scene(k_eight_candela, 1, keys.text())); };
  const std::string place = "/animations/0/samplers/0/output: ";
  EXPECT_EQ(outcome(pointed(k_first_light + "range", "STEP", {0}, {-1})).find(place + "found -1"), 0U);
  EXPECT_EQ(outcome(pointed(k_first_light + "color", "STEP", {0}, {1, -1, 1}, 3)).find(place + "found -1"), 0U);
  EXPECT_EQ(outcome(pointed(k_first_light + "spot/outerConeAngle", "STEP", {0}, {1.6F})).find(place), 0U);
  EXPECT_EQ(outcome(pointed(k_first_light + "range", "STEP", {0}, {1, 1, 1}, 3)).find(place), 0U);
  EXPECT_EQ(outcome(pointed("/nodes/0/translation", "STEP", {0}, {1})).find(place), 0U);
}

// A camera seen by a channel to one of its numbers.
Scene zoomed(const Animation& keys, const std::string& projection) {
  return loaded(
      document(R"("nodes": [{"name": "eye", "camera": 0}], "cameras": [)" + projection + "], " + keys.text()));
}

TEST(GltfPointers, to_a_camera_change_its_projection_in_every_frame) {
  const std::string perspective = R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.5, "zfar": 8}})";
  const std::string orthographic =
      R"({"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 8}})";
  Scene scene = zoomed(pointed("/cameras/0/perspective/yfov", "LINEAR", {0, 2}, {1, 2}), perspective);
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_TRUE(scene.cameras.at(0).animated);
  PathRequest request;
  request.count = 3;
  request.fit = CameraFit::vertical;
  const std::vector<Shot> shots = camera_paths(scene, request).at(0).shots;
  ASSERT_EQ(shots.size(), 3U);
  EXPECT_EQ(shots[1].projection.yfov_rad, 1.5);
  EXPECT_EQ(shots[1].projection.fit, CameraFit::vertical);
  scene = zoomed(pointed("/cameras/0/orthographic/xmag", "STEP", {0}, {-7}), orthographic);
  EXPECT_EQ(projection_at(scene, scene.cameras.at(0), 0.0).xmag_m, 7.0);
  const float endless = std::numeric_limits<float>::max();
  scene = zoomed(pointed("/cameras/0/orthographic/zfar", "STEP", {0}, {endless}), orthographic);
  EXPECT_TRUE(std::isinf(projection_at(scene, scene.cameras.at(0), 0.0).far_m));
  expect_one_warning(zoomed(pointed("/cameras/0/orthographic/xmag", "STEP", {0}, {1}), perspective),
                     "camera 0 has no xmag");
}

TEST(GltfPointers, to_a_projection_that_shows_nothing_are_refused_at_the_camera_and_the_time) {
  const std::string perspective = R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.5, "zfar": 8}})";
  for (const auto& [path, value] : {std::pair("yfov", 3.2F), std::pair("yfov", 0.0F), std::pair("zfar", 0.5F),
                                    std::pair("znear", 8.0F), std::pair("aspectRatio", 0.0F)}) {
    const Scene scene =
        zoomed(pointed(std::string("/cameras/0/perspective/") + path, "STEP", {0, 2}, {1, value}), perspective);
    EXPECT_NO_THROW(projection_at(scene, scene.cameras.at(0), 1.0)) << path;
    try {
      camera_paths(scene, {});
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.where(), "camera 'eye'");
      EXPECT_NE(error.message().find("at 2.000000 s"), std::string::npos) << error.message();
    }
  }
}

TEST(GltfPointers, that_lead_nowhere_or_where_nothing_is_are_told) {
  const auto text = [](const std::string& pointer) {
    return lit_scene(R"({"type": "point"})", 1, pointed(pointer, "STEP", {0}, {1}).text());
  };
  const std::string place = "/animations/0/channels/0/target";
  EXPECT_EQ(refusal(text("/nodes/1/translation")).find(place + "/extensions/KHR_animation_pointer/pointer: "), 0U);
  EXPECT_EQ(refusal(text("/extensions/KHR_lights_punctual/lights/1/range")).find(place), 0U);
  expect_one_warning(loaded(text(k_first_light + "spot/outerConeAngle")), "light 0 has no outerConeAngle");
}

TEST(GltfPointers, that_are_not_known_are_refused_where_the_file_requires_them_and_else_ignored_with_a_warning) {
  const std::string required = R"(, "extensionsRequired": ["KHR_animation_pointer"])";
  const std::string place = "/animations/0/channels/0/target/extensions/KHR_animation_pointer/pointer: ";
  for (const char* unknown : {"/cameras/0/name", "/nodes/0/translation/0", "/nodes//translation",
                              "/nodes/99999999999999999999/scale", "nonsense"}) {
    const std::string keys = pointed(unknown, "STEP", {0}, {1}).text();
    expect_one_warning(loaded(lit_scene(k_eight_candela, 1, keys)), "is not known and is ignored");
    EXPECT_EQ(refusal(lit_scene(k_eight_candela, 1, keys + required)).find(place), 0U) << unknown;
  }
  for (const char* looks : {"/materials/0/emissiveFactor", "/nodes/0/weights/1", "/meshes/0/weights"}) {
    const std::string keys = pointed(looks, "STEP", {0}, {1}).text();
    expect_one_warning(loaded(lit_scene(k_eight_candela, 1, keys + required)),
                       "moves neither light nor camera and is ignored");
  }
  EXPECT_EQ(
      refusal(lit_scene(k_eight_candela, 1, pointed(k_first_light + "range", "STEP", {0}, {1}).text() + required)),
      "loads");
}

}  // namespace
}  // namespace clusterbench::scene::test
