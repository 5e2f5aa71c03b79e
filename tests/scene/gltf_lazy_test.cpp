// Large files, whose nodes and lights are read one by one: the same as small ones, and in little memory.

#include "scene/gltf_document/gltf_lazy.h"

#include <gtest/gtest.h>

#include "gltf_fixture.h"
#include "scene/gltf_document/gltf_container.h"

namespace clusterbench::scene::test {
namespace {

// Lamps with a definition each, as Blender writes them, and a camera below the last; `filler`: what makes it large.
std::string level(std::size_t lamps, std::size_t filler, const std::string& last = "") {
  std::string nodes, lights, roots;
  for (std::size_t i = 0; i < lamps; ++i) {
    const std::string n = std::to_string(i), comma = i > 0 ? ",\n " : "";
    nodes += comma + R"({"name": "lamp \")" + n + R"(\"", "translation": [)" + n +
             R"(, 2.5, 0], "extensions": {"KHR_lights_punctual": {"light": )" + n + "}}, \"extras\": \"[" +
             std::string(filler, '{') + "\"}";
    lights += comma + R"({"type": "point", "name": "L", "intensity": )" + n + R"(, "range": 4})";
    roots += comma + n;
  }
  const std::string n = std::to_string(lamps);
  return document(R"("scenes": [{"nodes": [)" + roots + ", " + n + R"(]}], "nodes" : [)" + nodes + ", " +
                  (last.empty() ? R"({"camera": 0, "scale": [2, 2, 2]})" : last) +
                  R"(], "extensions": {"X": [{"nodes": []}], "KHR_lights_punctual": {"lights": [)" + lights +
                  R"(]}}, "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
}

constexpr std::size_t k_lamps = 300, k_large = 20'000;  // bytes a node: 6 MB

TEST(LargeFiles, are_read_like_small_ones) {
  const Scene small = loaded(level(k_lamps, 1)), large = loaded(level(k_lamps, k_large));
  ASSERT_EQ(large.lights.size(), k_lamps);
  ASSERT_EQ(large.nodes.size(), k_lamps + 1);
  EXPECT_EQ(large.cameras.size(), 1U);
  EXPECT_EQ(large.warnings, small.warnings);
  for (std::size_t i = 0; i < k_lamps; ++i) {
    EXPECT_EQ(large.lights[i].name, small.lights[i].name);
    EXPECT_EQ(large.lights[i].intensity, small.lights[i].intensity);
    EXPECT_EQ(large.nodes[i].translation, small.nodes[i].translation);
  }
}

TEST(LargeFiles, keep_only_the_places_of_their_nodes_and_lights) {
  const Folder folder;
  GltfFile file;
  read_gltf_file(folder.write("large.gltf", level(k_lamps, k_large)), file, k_lazy_from_bytes);
  EXPECT_TRUE(file.bytes.empty());
  EXPECT_EQ(file.lazy.nodes.size(), k_lamps + 1);
  EXPECT_EQ(file.lazy.lights.size(), k_lamps);
  EXPECT_EQ(file.lazy.nodes.element(7)["translation"][0], 7);
  EXPECT_TRUE(file.json["nodes"].empty());
  EXPECT_EQ(file.json["cameras"].size(), 1U);
}

TEST(LargeFiles, in_a_glb_with_a_binary_chunk_are_read_too) {
  const std::string text = level(k_lamps, k_large);
  const Scene scene = loaded(glb(chunk("JSON", text, ' ') + chunk(std::string("BIN\0", 4), "abcd", '\0')), "a.glb");
  EXPECT_EQ(scene.lights.size(), k_lamps);
  EXPECT_EQ(scene.lights[299].intensity, 299.0);
}

TEST(LargeFiles, are_refused_where_small_ones_are) {
  const struct {
    const char *last, *says;
  } cases[] = {
      {R"({"rotation": [0, 0, 0, 2]})", "/nodes/300/rotation: a rotation must have length 1"},
      {R"({"children": [301]})", "/nodes/300/children/0: refers to node 301"},
      {R"({"extensions": {"KHR_lights_punctual": {"light": 300}}})",
       "/nodes/300/extensions/KHR_lights_punctual/light: refers to light 300, but there are 300"},
  };
  for (const auto& broken : cases)
    EXPECT_EQ(refusal(level(k_lamps, k_large, broken.last)).find(broken.says), 0U)
        << refusal(level(k_lamps, k_large, broken.last));
  for (const char* last : {"{,}", "{\"a\": 1e999}", "{\"a\" 1}", "\"\\x\"", "{}, ", "[[]"}) {
    const std::string found = refusal(level(k_lamps, k_large, last));
    EXPECT_EQ(found.find("byte "), 0U) << last << ": " << found;
    EXPECT_GT(std::stoull(found.substr(5)), k_lamps * k_large) << last << ": " << found;
  }
  EXPECT_NE(refusal(level(k_lamps, k_large, std::string(300, '[') + std::string(300, ']'))).find("nested deeper"),
            std::string::npos);
  for (const std::size_t bytes : {std::size_t{1}, k_large}) {
    std::string twice = level(k_lamps, bytes);
    twice.insert(1, R"("nodes": [{"camera": 7}], )");
    EXPECT_EQ(refusal(twice), "loads");
    const std::vector<std::string> warnings = loaded(twice).warnings;
    EXPECT_TRUE(std::ranges::any_of(warnings, [](const std::string& warning) {
      return warning.find(R"(is the key "nodes" for the second time in its object; the later value counts)") !=
             std::string::npos;
    }));
  }
}

TEST(LargeFiles, tell_a_key_that_stands_twice_within_an_element_as_small_ones_do) {
  std::string many;  // more than are compared one by one
  for (int i = 0; i < 40; ++i) many += "\"k" + std::to_string(i) + "\": 0, ";
  const struct {
    std::string last, says;
  } cases[] = {
      {R"({"camera": 0, "name": "a", "name": "b"})", R"( is the key "name" for the second time in its object)"},
      {R"({"camera": 0, "name": "a", "na\u006de": "b"})", " has an object with a key twice, in different spellings"},
      {R"({"camera": 0, "extras": {"a": {"x": 1}, "b": {"x": 1, "y": 2, "x": 3}}})",
       R"( is the key "x" for the second)"},
      {R"({"camera": 0, "extras": {)" + many + R"("k3": 1}})", R"( is the key "k3" for the second time)"},
      {R"({"camera": 0, "extras": {)" + many + R"("a": {"a": 1}}})", ""},
  };
  for (const auto& twice : cases)
    for (const std::size_t bytes : {std::size_t{1}, k_large}) {
      const std::string text = level(k_lamps, bytes, twice.last);
      std::string told;
      for (const std::string& warning : loaded(text).warnings) told += warning + "\n";
      EXPECT_EQ(told.find("the later value counts") != std::string::npos, !twice.says.empty()) << told;
      EXPECT_NE(told.find(twice.says), std::string::npos) << twice.last << ": " << told;
      const std::size_t byte = told.find("byte ");
      if (byte == std::string::npos || told.find("for the second") == std::string::npos) continue;
      EXPECT_EQ(text[std::stoul(told.substr(byte + 5))], '"') << told;
    }
}

}  // namespace
}  // namespace clusterbench::scene::test
