// What is broken in a part that is read is refused with its place; hostile files neither crash nor fill the memory.

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "gltf_fixture.h"

namespace clusterbench::scene::test {
namespace {

struct Broken {
  const char* members;  // beside the asset
  const char* where;
  const char* says;  // a part of the message
};

void expect_refused(const std::string& text, const std::string& where, const std::string& says) {
  const std::string found = refusal(text);
  EXPECT_TRUE(found.starts_with(where + ": ")) << "found '" << found << "'\nfor " << text;
  EXPECT_NE(found.find(says), std::string::npos) << found;
  EXPECT_EQ(found.find('\n'), std::string::npos) << found;
}

TEST(GltfRefusals, a_broken_node_names_its_pointer) {
  const Broken cases[] = {
      {R"("nodes": {})", "/nodes", "an array"},
      {R"("nodes": [7])", "/nodes/0", "an object"},
      {R"("nodes": [{"camera": 0}])", "/nodes/0/camera", "camera 0"},
      {R"("nodes": [{"camera": "x"}])", "/nodes/0/camera", "whole number"},
      {R"("nodes": [{"camera": -1}])", "/nodes/0/camera", "whole number"},
      {R"("nodes": [{"name": 3}])", "/nodes/0/name", "a string"},
      {R"("nodes": [{"children": [1]}])", "/nodes/0/children/0", "node 1"},
      {R"("nodes": [{"children": [0]}])", "/nodes/0", "ancestor"},
      {R"("nodes": [{"children": [1]}, {"children": [0]}])", "/nodes/0", "ancestor"},
      {R"("nodes": [{"children": [2]}, {"children": [2]}, {}])", "/nodes/1/children/0", "parent 0"},
      {R"("nodes": [{"children": [1, 1]}, {}])", "/nodes/0/children/1", "parent 0"},
      {R"("nodes": [{"translation": [1, 2]}])", "/nodes/0/translation", "3 numbers"},
      {R"("nodes": [{"translation": [1, null, 3]}])", "/nodes/0/translation/1", "a number"},
      {R"("nodes": [{"scale": [1, 2, 1e39]}])", "/nodes/0/scale/2", "single precision"},
      {R"("nodes": [{"rotation": [0, 0, 0, 1.01]}])", "/nodes/0/rotation", "length 1"},
      {R"("nodes": [{"rotation": [0, 0, 0, 0]}])", "/nodes/0/rotation", "length 1"},
      {R"("nodes": [{"matrix": [1]}])", "/nodes/0/matrix", "16 numbers"},
      {R"("nodes": [{"matrix": [1,0,0,0, 1,1,0,0, 0,0,1,0, 0,0,0,1]}])", "/nodes/0/matrix", "orthogonal"},
      {R"("nodes": [{"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,2]}])", "/nodes/0/matrix", "last row"},
      {R"("nodes": [{"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], "scale": [1, 1, 1]}])", "/nodes/0/matrix",
       "not both"},
      {R"("nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}])", "/nodes/0/extensions/KHR_lights_punctual",
       "defines no lights"},
      {R"("nodes": [{"extras": {"clusterbench_box": {"half_extents": [1, -1, 1]}}}])",
       "/nodes/0/extras/clusterbench_box/half_extents", "negative"},
      {R"("nodes": [{}], "scenes": [{"nodes": [1]}])", "/scenes/0/nodes/0", "node 1"},
      {R"("nodes": [{}], "scenes": [{"nodes": [0, 0]}])", "/scenes/0/nodes/1", "twice"},
      {R"("nodes": [{"children": [1]}, {}], "scenes": [{"nodes": [0, 1]}])", "/scenes/0/nodes/1", "parent"},
      {R"("scene": 0)", "/scene", "scene 0"},
  };
  for (const Broken& broken : cases) expect_refused(document(broken.members), broken.where, broken.says);
}

TEST(GltfRefusals, a_broken_light_names_its_pointer) {
  const Broken cases[] = {
      {R"({"type": "point", "range": -1})", "/range", "0 or more"},
      {R"({"type": "point", "range": "far"})", "/range", "a number"},
      {R"({"type": "point", "range": null})", "/range", "found null"},
      {R"({"type": "point", "intensity": -0.5})", "/intensity", "0 or more"},
      {R"({"type": "point", "color": [1, 1]})", "/color", "3 numbers"},
      {R"({"type": "point", "color": [1, 1, 1, 1, 1]})", "/color", "3 numbers"},
      {R"({"type": "point", "range": 3.5e38})", "/range", "single precision"},
      {R"({"type": "point", "color": [1, -1, 1]})", "/color/1", "0 to 1"},
      {R"({})", "", "'type' is missing"},
      {R"({"type": "spot", "spot": 3})", "/spot", "an object"},
      {R"({"type": "spot", "spot": {"innerConeAngle": -0.1}})", "/spot/innerConeAngle", "0 or more"},
      {R"({"type": "spot", "spot": {"outerConeAngle": 1.6}})", "/spot/outerConeAngle", "pi/2"},
      {R"({"type": "spot", "spot": {"outerConeAngle": 0}})", "/spot/outerConeAngle", "more than 0"},
      {R"({"type": "spot", "spot": {"outerConeAngle": -1e-30}})", "/spot/outerConeAngle", "found -1e-30,"},
      {R"({"type": "spot", "spot": {"innerConeAngle": 0.51, "outerConeAngle": 0.5}})", "/spot/outerConeAngle",
       "not be more than"},
      {R"({"type": "spot", "spot": {"innerConeAngle": 0.9}})", "/spot/innerConeAngle", "not be more than"},
  };
  for (const Broken& broken : cases) {
    expect_refused(
        document(R"("extensions": {"KHR_lights_punctual": {"lights": [)" + std::string(broken.members) + "]}}"),
        "/extensions/KHR_lights_punctual/lights/0" + std::string(broken.where), broken.says);
  }
}

TEST(GltfRefusals, a_broken_camera_names_its_pointer) {
  const Broken cases[] = {
      {R"({"perspective": {}})", "", "'type' is missing"},
      {R"({"type": "perspective"})", "", "'perspective' is missing"},
      {R"({"type": "perspective", "perspective": {"yfov": 1}})", "/perspective", "'znear' is missing"},
      {R"({"type": "perspective", "perspective": {"yfov": 0, "znear": 1}})", "/perspective/yfov", "more than 0"},
      {R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 0}})", "/perspective/znear", "more than 0"},
      {R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 2, "zfar": 2}})", "/perspective", "greater"},
      {R"({"type": "orthographic", "orthographic": {"xmag": 0, "ymag": 1, "znear": 0, "zfar": 1}})",
       "/orthographic/xmag", "found 0"},
      {R"({"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": -1, "zfar": 1}})",
       "/orthographic/znear", "0 or more"},
      {R"({"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 1, "zfar": 1}})", "/orthographic",
       "greater"},
  };
  for (const Broken& broken : cases) {
    expect_refused(document(R"("cameras": [)" + std::string(broken.members) + "]"),
                   "/cameras/0" + std::string(broken.where), broken.says);
  }
}

// A sound animation of node 0 with one part of its text replaced.
std::string spoilt(const Animation& sound, const std::string& part, const std::string& by) {
  std::string text = document(R"("nodes": [{}], )" + sound.text());
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), by);
}

TEST(GltfRefusals, a_broken_animation_names_its_pointer) {
  const Animation sound = animation("translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 1, 1});
  ASSERT_EQ(refusal(document(R"("nodes": [{}], )" + sound.text())), "loads");
  const struct {
    const char *part, *by, *where, *says;
  } cases[] = {
      {R"("node": 0)", R"("node": 1)", "/animations/0/channels/0/target/node", "node 1"},
      {R"("sampler": 0)", R"("sampler": 1)", "/animations/0/channels/0/sampler", "sampler 1"},
      {R"("input": 0)", R"("input": 5)", "/animations/0/samplers/0/input", "accessor 5"},
      {R"("output": 1)", R"("output": 0)", "/animations/0/samplers/0/output", "VEC3"},
      {"LINEAR", "BEZIER", "/animations/0/samplers/0/interpolation", "CUBICSPLINE"},
      {"LINEAR", "a\\nb", "/animations/0/samplers/0/interpolation", "a?b"},
      {"LINEAR", "CUBICSPLINE", "/animations/0/samplers/0/output", "6"},
      {R"("bufferView": 1)", R"("bufferView": 2)", "/accessors/1/bufferView", "bufferView 2"},
      {R"("count": 2)", R"("count": 0)", "/animations/0/samplers/0/output", "0 are needed"},
      {R"("count": 2)", R"("count": 3)", "/animations/0/samplers/0/output", "3"},
      {R"("min": [0])", R"("min": [0, 0])", "/accessors/0/min", "1 numbers"},
      {R"("componentType": 5126)", R"("componentType": 5124)", "/accessors/0/componentType", "5126"},
      {R"("byteLength": 8)", R"("byteLength": 4)", "/accessors/0", "do not fit"},
      {R"("byteLength": 8)", R"("byteStride": 256, "byteLength": 8)", "/bufferViews/0/byteStride", "4 to 252"},
      {R"("byteOffset": 8)", R"("byteOffset": 9)", "/bufferViews/1", "do not fit"},
      {R"("byteOffset": 8)", R"("byteOffset": 6)", "/accessors/1/bufferView", "begins at byte 6"},
      {R"("byteOffset": 8)", R"("byteOffset": 9007199254740992)", "/bufferViews/1", "do not fit"},
      {R"("byteLength": 32)", R"("byteLength": 33)", "/buffers/0", "33"},
      {"base64,", "base64,*", "/buffers/0/uri", "base64"},
      {R"("uri": "data:)", R"("uri": "https:)", "/buffers/0/uri", "only files"},
      {R"("nodes": [{}])", R"("nodes": [{"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])",
       "/animations/0/channels/0/target", "matrix"},
  };
  for (const auto& broken : cases) expect_refused(spoilt(sound, broken.part, broken.by), broken.where, broken.says);
}

TEST(GltfRefusals, broken_key_values_name_their_sampler) {
  const auto text = [](const Animation& keys) {
    return document(R"("nodes": [{"children": [1]}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}, )" +
                    keys.text());
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expect_refused(text(animation("scale", "LINEAR", {1, 1}, {0, 0, 0, 1, 1, 1})), "/animations/0/samplers/0/input",
                 "ascend");
  expect_refused(text(animation("scale", "LINEAR", {2, 1}, {0, 0, 0, 1, 1, 1})), "/animations/0/samplers/0/input",
                 "ascend");
  expect_refused(text(animation("scale", "LINEAR", {-1, 1}, {0, 0, 0, 1, 1, 1})), "/animations/0/samplers/0/input",
                 "0 or more");
  expect_refused(text(animation("scale", "LINEAR", {0, nan}, {0, 0, 0, 1, 1, 1})), "/accessors/0", "none at all");
  expect_refused(text(animation("scale", "LINEAR", {0}, {0, nan, 0})), "/accessors/1", "none at all");
  expect_refused(text(animation("rotation", "LINEAR", {0}, {0, 0, 0, 0.9F})), "/animations/0/samplers/0/output",
                 "length 1");
  expect_refused(text(animation("scale", "CUBICSPLINE", {0}, std::vector<float>(9))), "/animations/0/samplers/0/input",
                 "two keys");
}

TEST(GltfRefusals, a_visibility_that_is_neither_true_nor_false_names_its_pointer) {
  expect_refused(document(R"("nodes": [{"extensions": {"KHR_node_visibility": {"visible": 0}}}])"),
                 "/nodes/0/extensions/KHR_node_visibility/visible", "true or false");
}

TEST(GltfRefusals, a_buffer_beside_the_folder_of_the_file_is_not_read) {
  const Folder folder;
  folder.write("keys.bin", bytes_of(std::vector<float>{0, 0, 0, 0}));
  std::filesystem::create_directory(folder.path() / "deep");
  Animation keys = animation("translation", "LINEAR", {0}, {0, 0, 0});
  const auto outcome = [&](const std::string& uri) {
    keys.uri = uri;
    const std::string text = document(R"("nodes": [{}], )" + keys.text());
    try {
      load_gltf(folder.write("deep/scene.gltf", text));
    } catch (const Error& error) {
      return error.where() + ": " + error.message();
    }
    return std::string("loads");
  };
  const std::string absolute = (folder.path() / "keys.bin").string();
  for (const std::string& uri : {std::string("../keys.bin"), std::string("a/../../keys.bin"),
                                 std::string("%2e%2e/keys.bin"), std::string("..%2Fkeys.bin"), absolute}) {
    EXPECT_EQ(outcome(uri).find("/buffers/0/uri: "), 0U) << uri << ": " << outcome(uri);
    EXPECT_NE(outcome(uri).find("beside this one or below"), std::string::npos) << uri << ": " << outcome(uri);
  }
  EXPECT_NE(outcome("keys%00.bin").find("beside this one or below"), std::string::npos);
  folder.write("deep/keys.bin", bytes_of(std::vector<float>{0, 0, 0, 0}));
  EXPECT_EQ(outcome("keys.bin"), "loads");
  EXPECT_EQ(outcome("./keys.bin"), "loads");
  EXPECT_EQ(outcome("a/../keys.bin"), "loads");
}

TEST(GltfRefusals, a_missing_external_buffer_is_named_when_an_animation_needs_it) {
  Animation keys = animation("translation", "LINEAR", {0}, {0, 0, 0});
  keys.uri = "keys.bin";
  expect_refused(document(R"("nodes": [{}], )" + keys.text()), "/buffers/0/uri", "does not exist");
}

TEST(GltfRefusals, a_broken_container_names_its_byte) {
  const std::string json_chunk = chunk("JSON", document(""), ' ');
  EXPECT_EQ(refusal(glb(json_chunk), "a.glb"), "loads");
  EXPECT_TRUE(refusal("", "a.gltf").starts_with("byte 0: "));
  EXPECT_TRUE(refusal("glTF", "a.glb").starts_with("byte 4: "));
  EXPECT_TRUE(refusal("{}", "a.glb").starts_with("/: is JSON, but no glTF"));  // known by its content
  EXPECT_TRUE(refusal("glTF" + little_endian(1) + little_endian(12), "a.glb").starts_with("byte 4: "));
  EXPECT_TRUE(refusal(glb(json_chunk).substr(0, 30), "a.glb").starts_with("byte 8: "));
  EXPECT_TRUE(refusal(glb(""), "a.glb").starts_with("byte 12: "));
  EXPECT_TRUE(refusal(glb(chunk("JSOM", "{}", ' ')), "a.glb").starts_with("byte 16: "));
  EXPECT_TRUE(refusal(glb(json_chunk + json_chunk), "a.glb").starts_with("byte "));
  EXPECT_TRUE(refusal(glb(little_endian(0xFFFFFFFF) + "JSON"), "a.glb").starts_with("byte 12: "));
  EXPECT_TRUE(refusal("{\"asset\": }").starts_with("byte 10: is not JSON"));
  EXPECT_TRUE(refusal("{\"asset\": {\"version\": 1e999}}").starts_with("byte 22: "));
  EXPECT_TRUE(refusal("[]").starts_with("byte 0: is neither a glb"));
  EXPECT_TRUE(refusal("{}").starts_with("/: is JSON, but no glTF"));
  EXPECT_TRUE(refusal(R"({"asset": {"version": "1.0"}})").starts_with("/asset/version: "));
  EXPECT_TRUE(refusal(R"({"asset": {"version": 2}})").starts_with("/asset/version: "));
}

TEST(GltfRefusals, a_file_that_is_not_there_is_named) {
  EXPECT_THROW(load_gltf("/no/such/file.gltf"), Error);
  EXPECT_THROW(load_gltf(std::filesystem::temp_directory_path()), Error);
}

TEST(GltfHostile, transforms_that_multiply_to_infinity_are_refused) {
  std::string list;
  for (int i = 0; i < 12; ++i)
    list += R"({"scale": [1e38, 1e38, 1e38], "children": [)" + std::to_string(i + 1) + "]}, ";
  expect_refused(document("\"nodes\": [" + list + "{}]"), "/nodes/8", "too large");
}

TEST(GltfHostile, deep_nesting_is_refused_and_a_deep_node_chain_loads) {
  const std::string deep(100000, '[');
  EXPECT_NE(refusal(document("\"extras\": " + deep)).find("nested deeper"), std::string::npos);
  std::string list;
  for (int i = 0; i < 20000; ++i) list += R"({"children": [)" + std::to_string(i + 1) + "]}, ";
  EXPECT_EQ(loaded(document("\"nodes\": [" + list + "{}]")).nodes.size(), 20001U);
}

TEST(GltfHostile, huge_counts_are_refused_before_memory_is_taken) {
  Animation keys = animation("translation", "LINEAR", {0}, {0, 0, 0});
  keys.keys = keys.elements = 9000000000000000ULL;
  std::string text = document(R"("nodes": [{}], )" + keys.text());
  EXPECT_NE(refusal(text), "loads");
  for (const char* view : {R"("bufferView": 0, )", R"("bufferView": 1, )"})
    text.erase(text.find(view), std::string(view).size());
  expect_refused(text, "/accessors/1/count", "more than");
}

// Any change of a byte either loads or is refused; the sanitizer build of this test looks for worse.
TEST(GltfHostile, changed_bytes_never_do_more_than_be_refused) {
  const std::string sound =
      document(R"("nodes": [{"camera": 0, "children": [1]}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}], "scenes": [{"nodes": [0]}], "scene": 0,
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "range": 4, "spot": {"outerConeAngle": 0.5}}]}}, )" +
               animation("rotation", "CUBICSPLINE", {0, 1},
                         {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0})
                   .text());
  ASSERT_EQ(refusal(sound), "loads");
  const std::string sound_glb = glb(chunk("JSON", sound, ' ') + chunk(std::string("BIN\0", 4), "1234", '\0'));
  std::mt19937_64 random(1);
  const std::string interesting = "{}[]\",:0123456789-eE. nullt\\\xFF\x80";
  const Folder folder;
  int loads = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool binary = i % 2 == 0;
    std::string text = binary ? sound_glb : sound;
    const std::size_t changes = 1 + random() % 3;
    for (std::size_t k = 0; k < changes; ++k) text[random() % text.size()] = interesting[random() % interesting.size()];
    if (random() % 10 == 0) text.resize(random() % text.size());
    try {
      const Scene scene = load_gltf(folder.write(binary ? "x.glb" : "x.gltf", text));
      world_lights(scene, 0.5);
      ++loads;
    } catch (const Error& error) {
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(loads, 100);
  EXPECT_LT(loads, 2900);
}

}  // namespace
}  // namespace clusterbench::scene::test
