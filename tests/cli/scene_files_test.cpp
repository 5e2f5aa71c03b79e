// Scene files as people have them: other endings, several scenes and clips, no lights.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/tool.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

const std::string k_fast = " --grid frustum --assigner exact-fast --no-timing -q -o -";

const std::string k_level = R"({"asset": {"version": "2.0", "generator": "Khronos glTF Blender I/O v4.0.44"},
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 80}]}},
  "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
  "nodes": [{"name": "eye", "camera": 0, "translation": [0, 1, 8]},
            {"name": "lamp", "extensions": {"KHR_lights_punctual": {"light": 0}}}],
  "scenes": [{"name": "Assets", "nodes": [0]}, {"name": "Level", "nodes": [0, 1]}]})";

Json first_scene(const std::string& command) {
  const Outcome done = tool(command);
  EXPECT_EQ(done.code, 0) << command << ": " << done.err;
  return done.code == 0 ? Json::parse(done.out)["scenes"][0] : Json();
}

TEST(SceneFiles, run_takes_a_scene_whatever_its_ending) {
  const Folder folder;
  for (const char* name : {"LEVEL.GLB", "level.vrm", "level.bin"}) {
    std::filesystem::copy_file(source_file("scenes/hall-512.glb"), folder / name);
    EXPECT_EQ(first_scene("run " + (folder / name).string() + k_fast + " --set scenes.0.frames=1")["lights"]["point"],
              512)
        << name;
  }
  const Outcome blend = tool("run " + folder.write("level.blend", "BLENDER-v401").string());
  EXPECT_EQ(blend.code, 2);
  EXPECT_NE(blend.err.find("File > Export > glTF 2.0"), std::string::npos) << blend.err;
}

TEST(SceneFiles, a_scene_is_chosen_on_the_command_line_and_in_a_configuration) {
  const Folder folder;
  const std::string file = folder.write("two.gltf", k_level).string();
  for (const char* flag : {"--scene Level", "--scene 1", "--set scenes.0.scene=1", "--set scenes.0.scene=Level"})
    EXPECT_EQ(first_scene("run " + file + k_fast + " " + flag)["lights"]["point"], 1) << flag;
  const Outcome info = tool("scene info --scene Level " + file);
  EXPECT_NE(info.out.find("1 point"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("  scenes   0 'Assets', 1 'Level'; read is 1\n"), std::string::npos) << info.out;
  EXPECT_NE(tool("run " + file + " --scene Levl").err.find("has no scene 'Levl' (did you mean 'Level'?)"),
            std::string::npos);
}

TEST(SceneFiles, no_lights_are_said_by_info_and_run) {
  const Folder folder;
  const std::string file = folder.write("two.gltf", k_level).string();
  const std::string unread = "1 light of nodes that do not stand in the scene that is read";
  EXPECT_NE(tool("scene info " + file).out.find(unread), std::string::npos);
  const Outcome run = tool("run " + file + " --grid frustum --assigner exact-fast --no-timing");
  EXPECT_NE(run.err.find(unread) + run.out.find(unread), 2 * std::string::npos) << run.out << run.err;
  const std::string empty =
      folder.write("empty.gltf", R"({"asset": {"version": "2.0", "generator": "Blender"}})").string();
  const Outcome refused = tool("run " + empty);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(
      refused.err.find("has neither a camera nor a point or spot light to look at: no lights (KHR_lights_punctual) "
                       "in the file; in Blender's glTF export tick Include > Data > Punctual Lights"),
      std::string::npos)
      << refused.err;
}

TEST(SceneFiles, the_range_rule_has_the_same_flags_everywhere) {
  const Folder folder;
  const std::string file =
      folder.write("two.gltf", k_level).string() + " --scene Level --cutoff-lux 0.5 --max-range 20";
  const Json info = Json::parse(tool("scene info --json " + file).out);
  const Json run = first_scene("run " + file + k_fast)["range_rule"];
  EXPECT_EQ(run["cutoff_lux"], 0.5);
  EXPECT_EQ(run["max_range"], 20.0);
  EXPECT_DOUBLE_EQ(run["ranges"]["greatest"].get<double>(), info["ranges"]["max_m"].get<double>());
  for (const char* flag : {" --cutoff-lux ", " --max-range "})
    for (const char* command : {"scene info ", "light-map ", "run -q --no-timing "}) {
      const Outcome refused = tool(command + file.substr(0, file.find(" --")) + flag + "1e300");
      EXPECT_EQ(refused.code, 2) << command << flag << refused.err;
      EXPECT_NE(refused.err.find("at most 1"), std::string::npos) << refused.err;
    }
  const Outcome clamped = tool("run " + folder.write("one.gltf", k_level).string() +
                               " --scene Level --max-range 2 --grid frustum --assigner exact-fast --no-timing");
  EXPECT_NE((clamped.out + clamped.err).find("1 of 1 lights have no range and shine farther than 2 m"),
            std::string::npos)
      << clamped.out << clamped.err;
}

}  // namespace
}  // namespace clusterbench::test
