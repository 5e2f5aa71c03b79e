// Which of a file's scenes and animations are read, and what is said of lights that are not.

#include <gtest/gtest.h>

#include <algorithm>

#include "gltf_fixture.h"
#include "scene/summary.h"

namespace clusterbench::scene::test {
namespace {

const std::string k_lights = R"("extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "range": 3}]}})";
const std::string k_lamp = R"({"name": "lamp", "extensions": {"KHR_lights_punctual": {"light": 0}}})";

std::string two_scenes(const std::string& more = "") {
  return document(R"("nodes": [{"name": "room"}, )" + k_lamp + R"(, {"name": "lamp 2", "children": [1]}], )" +
                  k_lights + R"(, "scenes": [{"name": "Assets", "nodes": [0]}, {"name": "Level", "nodes": [2]}])" +
                  more);
}

Scene chosen(const std::string& text, const GltfChoice& choice) {
  const Folder folder;
  return load_gltf(folder.write("scene.gltf", text), choice);
}

std::string refusal_of(const std::string& text, const GltfChoice& choice) {
  try {
    chosen(text, choice);
  } catch (const Error& error) {
    return error.where() + ": " + error.message();
  }
  return "loads";
}

bool says(const std::vector<std::string>& warnings, const std::string& part) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& warning) { return warning.find(part) != std::string::npos; });
}

TEST(GltfChoices, a_scene_is_chosen_by_its_name_or_its_number) {
  for (const char* scene : {"Level", "1"}) {
    const Scene read = chosen(two_scenes(R"(, "scene": 0)"), {scene, ""});
    EXPECT_EQ(read.lights.size(), 1U) << scene;
    EXPECT_EQ(read.contents.scene, 1U);
    EXPECT_TRUE(read.warnings.empty()) << read.warnings.front();
  }
  EXPECT_EQ(refusal_of(two_scenes(), {"Levl", ""}),
            "/: has no scene 'Levl' (did you mean 'Level'?); it has: 0 'Assets', 1 'Level'");
  EXPECT_EQ(refusal_of(two_scenes(), {"2", ""}), "/: has no scene '2'; it has: 0 'Assets', 1 'Level'");
  EXPECT_EQ(refusal_of(document("\"nodes\": [{}]"), {"0", ""}), "/: has no scene '0'; it has none");
  EXPECT_EQ(refusal_of(document(R"("nodes": [{}], "scenes": [{"name": "a"}, {"name": "a"}])"), {"a", ""}),
            "/: 2 of its scenes are called 'a'; choose one by its number, with a #, as in #0: 0 'a', 1 'a'");
}

TEST(GltfChoices, a_name_that_is_the_number_of_another_scene_takes_neither_without_a_word) {
  const std::string crossed = document(R"("nodes": [{}], "scenes": [{"name": "1"}, {"name": "0"}, {"name": "2"}])");
  EXPECT_EQ(
      refusal_of(crossed, {"0", ""}),
      "/: '0' is the name of one of its scenes and the number of another; choose one by its number, with a #: #1 is "
      "the one of this name, #0 the other");
  EXPECT_EQ(chosen(crossed, {"#0", ""}).contents.scene, 0U);
  EXPECT_EQ(chosen(crossed, {"#1", ""}).contents.scene, 1U);
  EXPECT_EQ(chosen(crossed, {"2", ""}).contents.scene, 2U);
  const std::string twins = document(R"("nodes": [{}], "scenes": [{"name": "1"}, {"name": "1"}])");
  EXPECT_EQ(chosen(twins, {"#1", ""}).contents.scene, 1U);
  EXPECT_EQ(refusal_of(crossed, {"4", ""}), "/: has no scene '4'; it has: 0 '1', 1 '0', 2 '2'");
  EXPECT_EQ(refusal_of(twins, {"#2", ""}), "/: has no scene '#2'; it has: 0 '1', 1 '1'");
}

TEST(GltfChoices, without_one_a_warning_names_the_scenes_and_counts_the_lights_of_others) {
  const Scene first = loaded(two_scenes());
  ASSERT_EQ(first.warnings.size(), 2U);
  EXPECT_EQ(first.warnings[0],
            "/scenes: 2 scenes: 0 'Assets', 1 'Level'; read is 0, the first, since the file names no default; the key "
            "scene (--scene) chooses another");
  EXPECT_EQ(first.warnings[1].find("/nodes/1: 1 light of nodes that do not stand in the scene that is read"), 0U);
  EXPECT_EQ(first.contents.unread_lights, 1U);
  EXPECT_TRUE(says(loaded(two_scenes(R"(, "scene": 1)")).warnings, "read is 1, the file's default"));
  EXPECT_TRUE(says(summarise(first).warnings, "no lights that are read: 1 light stands in other scenes or extensions"));
}

std::string two_clips() {
  std::string text =
      document(R"("nodes": [{}], )" + animation("translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0}).text());
  const std::string first = R"("animations": [{)", channels = R"("channels": [{"sampler": 0, "target": {"node": 0, )"
                                                              R"("path": "translation"}}]})";
  text.replace(text.find(first), first.size(), first + R"("name": "idle", )");
  const std::size_t end = text.find("]}]", text.find("\"channels\"")) + 2;
  return text.insert(end, R"(, {"name": "walk", "samplers": [{"input": 0, "output": 1}], )" + channels);
}

TEST(GltfChoices, an_animation_is_chosen_by_its_name_or_its_number) {
  const Scene both = loaded(two_clips());
  EXPECT_TRUE(says(both.warnings, "moves node 0 (translation) again; this animation wins"));
  EXPECT_TRUE(says(both.warnings,
                   "/animations: 2 animations, played together: 0 'idle', 1 'walk'; the key animation (--animation)"));
  for (const char* name : {"idle", "0", "walk", "1"}) {
    const Scene one = chosen(two_clips(), {"", name});
    EXPECT_EQ(one.channels.size(), 1U);
    EXPECT_TRUE(one.warnings.empty()) << one.warnings.front();
  }
  EXPECT_EQ(refusal_of(two_clips(), {"", "run"}), "/: has no animation 'run'; it has: 0 'idle', 1 'walk'");
}

TEST(UnreadLights, of_other_extensions_are_counted) {
  const std::string ies = R"("EXT_lights_ies": {"lightProfile": 0})";
  const Scene scene = loaded(document(
      R"("nodes": [{"extensions": {)" + ies + R"(}}, {"extensions": {)" + ies + R"(}}, {"extensions": {)" + ies +
      R"(, "KHR_lights_punctual": {"light": 0}}}, {"extensions": {"KHR_lights": {"light": 0}}}], )" + k_lights));
  EXPECT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.contents.unread_lights, 3U);
  ASSERT_EQ(scene.warnings.size(), 3U);
  EXPECT_EQ(scene.warnings[0],
            "/nodes/0: 2 nodes with lights of EXT_lights_ies, which is not read; lights are those of "
            "KHR_lights_punctual");
  EXPECT_EQ(scene.warnings[1].find("/nodes: 1 light also with EXT_lights_ies, which is not read"), 0U);
  EXPECT_EQ(scene.warnings[2].find("/nodes/3: 1 node with lights of KHR_lights, which is not read"), 0U);
}

TEST(NoLights, are_said_with_the_switch_of_the_exporter) {
  const auto said = [](const std::string& generator) {
    const std::string text = R"({"asset": {"version": "2.0", "generator": ")" + generator + R"("}, "nodes": [{}]})";
    return summarise(loaded(text)).warnings.at(0);
  };
  EXPECT_EQ(said("Khronos glTF Blender I/O v4.0.44")
                .find("no lights (KHR_lights_punctual) in the file; in Blender's "
                      "glTF export tick Include > Data > Punctual Lights"),
            0U);
  EXPECT_NE(said("UnityGLTF").find("KHR_lights_punctual"), std::string::npos);
  EXPECT_NE(said("Unreal Engine 5.3").find("Export Lights"), std::string::npos);
  EXPECT_NE(said("mine").find("tick Punctual Lights in Blender's"), std::string::npos);
  EXPECT_TRUE(summarise(loaded(document(R"("nodes": [)" + k_lamp + "], " + k_lights))).warnings.empty());
}

TEST(RangeRules, that_cut_most_lights_off_are_a_warning) {
  Scene scene = loaded(document(R"("nodes": [)" + k_lamp + ", " + k_lamp + ", " + k_lamp +
                                R"(], "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", )"
                                R"("intensity": 1e6}]}})"));
  resolve_ranges(scene, RangeRule{});
  EXPECT_TRUE(says(summarise(scene).warnings, "most ranges are the range rule's longest (--max-range): 3 lights"));
  resolve_ranges(scene, RangeRule{0.05, 1e5});
  EXPECT_FALSE(says(summarise(scene).warnings, "most ranges"));
}

}  // namespace
}  // namespace clusterbench::scene::test
