// `clusterbench size --engine`: an engine's own limits and settings.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/lights_in_view.h"
#include "cli/tool.h"

namespace clusterbench {
namespace {

using Json = nlohmann::json;
using test::file_text;
using test::Folder;
using test::lights_in_view_and_behind;
using test::Outcome;
using test::tool;

Json limits_of(const std::string& engine, const std::string& scene) {
  const Outcome done = tool("size -q --format json --viewport 640x360 --engine " + engine + " " + scene);
  EXPECT_EQ(done.code, 0) << done.err;
  return Json::parse(done.out)["structures"][0]["settings"]["limits"];
}

TEST(SizeCommand, speaks_in_an_engines_own_settings) {
  const std::string street = test::source_file("scenes/street.glb");
  const Outcome godot = tool("size -q --engine godot --set scenes.*.frames=10 " + street);
  ASSERT_EQ(godot.code, 0) << godot.err;
  EXPECT_NE(godot.out.find("rendering/limits/cluster_builder/max_clustered_elements: "), std::string::npos)
      << godot.out;
  EXPECT_NE(godot.out.find("lights of one type in view in 10 frames"), std::string::npos) << godot.out;
  const Outcome cells = tool("size -q --engine playcanvas --format json --set scenes.*.frames=10 " + street);
  const Json settings = Json::parse(cells.out)["structures"][0]["settings"];
  EXPECT_EQ(settings["grid"], "scene.lighting.cells = new pc.Vec3(10, 3, 10)");
  EXPECT_EQ(settings["limits"][0]["name"], "scene.lighting.maxLightsPerCell");
  const Outcome none = tool("size -q --engine filament " + street), unknown = tool("size -q --engine godto " + street);
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("CONFIG_MAX_LIGHT_COUNT"), std::string::npos) << none.err;
  EXPECT_NE(unknown.err.find("did you mean 'godot'"), std::string::npos) << unknown.err;
}

TEST(SizeCommand, judges_an_engines_settings_by_lists_and_lights_without_the_engines_own_limit) {
  const Folder folder;
  const std::string scene = folder.write("many.gltf", lights_in_view_and_behind(300, 0)).string();
  const Json limits = limits_of("playcanvas", scene);
  EXPECT_EQ(limits[0]["seen"], 300);
  EXPECT_EQ(limits[0]["is_too_much"], true);
  EXPECT_EQ(limits[1]["seen"], 300);
  EXPECT_EQ(limits[1]["lost"], 45);
  EXPECT_EQ(limits[1]["value"], Json());
  const Outcome told = tool("size -q --viewport 640x360 --engine playcanvas " + scene);
  EXPECT_NE(told.out.find("such a frame loses 45 lights"), std::string::npos) << told.out;
  EXPECT_EQ(told.out.find("is enough"), std::string::npos) << told.out;
  EXPECT_EQ(told.out.find("Set these values"), std::string::npos) << told.out;
  const Outcome urp = tool("size -q --viewport 640x360 --engine unity-urp " + scene);
  EXPECT_EQ(urp.out.find("is enough"), std::string::npos) << urp.out;
  EXPECT_NE(urp.out.find("such a frame loses 44 lights"), std::string::npos) << urp.out;
}

TEST(SizeCommand, a_result_behind_an_engines_limit_does_not_say_how_long_its_lists_would_be) {
  const Folder folder;
  const std::string scene = folder.write("many.gltf", lights_in_view_and_behind(300, 0)).string(),
                    result = (folder / "result.json").string();
  ASSERT_EQ(tool("run -q --no-timing --preset playcanvas --viewport 640x360 -o " + result + " " + scene).code, 0);
  const Outcome told = tool("size --engine playcanvas " + result);
  EXPECT_NE(told.out.find("maxLightsPerCell: unknown"), std::string::npos) << told.out;
  EXPECT_NE(told.out.find("such a frame loses 45 lights"), std::string::npos) << told.out;
}

TEST(SizeCommand, an_engines_limit_of_the_scene_or_of_a_type_is_held_against_those) {
  const Folder folder;
  const std::string far = folder.write("far.gltf", lights_in_view_and_behind(10, 1200)).string();
  const Json limits = limits_of("three-js", far);
  EXPECT_EQ(limits[0]["name"], "maxLights");
  EXPECT_EQ(limits[0]["seen"], 1210);
  EXPECT_EQ(limits[0]["value"], 1210);
  Json mixed = Json::parse(lights_in_view_and_behind(120, 0));
  Json& lights = mixed["extensions"]["KHR_lights_punctual"]["lights"];
  for (std::size_t i = 0; i < 50; ++i) lights[i]["type"] = "spot";
  const Json of_type = limits_of("godot", folder.write("mixed.gltf", mixed.dump()).string());
  EXPECT_EQ(of_type[0]["seen"], 70);
  EXPECT_EQ(of_type[0]["value"], 96) << "the 70 points, up to a multiple of 32; 120 are of both types";
}

TEST(SizeCommand, an_engines_room_for_a_mean_of_entries_is_all_entries_by_the_cells) {
  const std::string flags = " --viewport 640x360 --set scenes.*.frames=10 " + test::source_file("scenes/street.glb");
  const Json structure =
      Json::parse(tool("size -q --format json --margin 1 --engine unreal" + flags).out)["structures"][0];
  const double entries = structure["buffers"][0]["high_water"].get<double>();
  const Json& limit = structure["settings"]["limits"][0];
  EXPECT_EQ(structure["settings"]["grid"], "r.Forward.LightGridPixelSize 64, r.Forward.LightGridSizeZ 32");
  EXPECT_EQ(limit["name"], "r.Forward.MaxCulledLightsPerCell");
  EXPECT_EQ(limit["seen"].get<double>(), std::ceil(entries / (10 * 6 * 32)));
  EXPECT_EQ(limit["value"], limit["seen"]);
  const Outcome told = tool("size -q --engine unreal" + flags);
  EXPECT_NE(told.out.find("(the engine's own 32 is enough: leave it)"), std::string::npos) << told.out;
  EXPECT_NE(told.out.find("Nothing to set"), std::string::npos) << told.out;
}

TEST(SizeCommand, limits_of_an_engine_that_nothing_sets_are_not_called_values) {
  const Folder folder;
  const std::string scene = folder.write("many.gltf", lights_in_view_and_behind(300, 0)).string();
  const Outcome urp = tool("size -q --viewport 640x360 --engine unity-urp " + scene);
  EXPECT_EQ(urp.out.find("these values"), std::string::npos) << urp.out;
  EXPECT_NE(urp.out.find("has no setting with which it does not"), std::string::npos) << urp.out;
}

TEST(SizeCommand, views_of_an_engine_are_refused_since_its_limits_hold_for_each) {
  const Outcome done = tool("size -q --engine bevy --views a,b " + test::source_file("scenes/street.glb"));
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("--views: adds what cameras need of one buffer"), std::string::npos) << done.err;
}

// Forty lights that fill the view, in more cells together than Bevy has indices for: it then draws in fewer tiles.
TEST(SizeCommand, an_engines_room_for_indices_is_that_of_tiles_that_have_not_grown_for_want_of_it) {
  const Folder folder;
  const std::string scene = test::source_file("scenes/lattice.glb"), result = (folder / "result.json").string(),
                    frames = " --set scenes.*.frames=6 ";
  const Outcome run = tool("run -q --no-timing --preset bevy --set accuracy.check=false -o " + result + frames + scene);
  ASSERT_EQ(run.code, 0) << run.err;
  const Json react = Json::parse(file_text(result))["cases"][0]["react"];
  ASSERT_GT(react["fixed"]["index_entries"], react["reacting"]["index_entries"]) << "what the test is about";
  const auto sized = [](const std::string& arguments) {
    const Outcome done = tool("size -q --engine bevy --format json --margin 1 --round none " + arguments);
    EXPECT_EQ(done.code, 0) << done.err;
    return Json::parse(done.out)["structures"][0];
  };
  const Json of_level = sized(frames + scene), of_result = sized(result);
  EXPECT_EQ(of_level["settings"], of_result["settings"]);
  const Json limit = of_level["settings"]["limits"][0];
  EXPECT_EQ(limit["seen"], react["fixed"]["index_entries"]);
  EXPECT_EQ(limit["value"], limit["seen"]);
  EXPECT_EQ(of_level["buffers"][0]["capacity"], limit["seen"]) << "the buffers are those of the same tiles";
  EXPECT_EQ(of_level["settings"]["grid"], "ClusterConfig::XYZ { dimensions: UVec3::new(17, 9, 24), .. }");
  const Outcome jam = tool("size -q --engine bevy" + frames + test::source_file("scenes/jam.glb"));
  EXPECT_NE(jam.out.find("its default makes these 17 x 9 x 24 clusters"), std::string::npos) << jam.out;
  EXPECT_NE(jam.out.find("from 17x9 to 2x1 at most"), std::string::npos) << jam.out;
  const Json with_own = limit["with_own_value"];
  EXPECT_EQ(with_own["value"], 16384);
  EXPECT_EQ(with_own["frames"], 6);
  EXPECT_EQ(with_own["frames_with_grown_tiles"], react["frames"]["reacted"]);
  EXPECT_EQ(with_own["frames_over"], react["frames"]["over"]);
  EXPECT_EQ(with_own["fewest_tiles"], react["tiles"]["fewest"]);
  const Outcome told = tool("size -q --engine bevy " + frames + scene);
  const std::string own = "with its own 16384: tiles grow in " + react["frames"]["reacted"].dump() + " of 6 frames";
  EXPECT_NE(told.out.find(own), std::string::npos) << told.out;
}

TEST(SizeCommand, says_of_a_preset_that_reached_its_own_limit_that_its_buffers_are_of_what_is_left) {
  const Folder folder;
  const std::string scene = folder.write("many.gltf", lights_in_view_and_behind(300, 0)).string(),
                    flags = "size -q --viewport 640x360 --preset filament --format ";
  const Json notes = Json::parse(tool(flags + "json " + scene).out)["structures"][0]["limit_notes"];
  ASSERT_EQ(notes.size(), 1u);
  const auto note = notes[0].get<std::string>();
  EXPECT_NE(note.find("took up to 44 lights from a frame"), std::string::npos) << note;
  for (const std::string format : {"table", "glsl", "cpp"})
    EXPECT_NE(tool(flags + format + " " + scene).out.find("LIMIT: " + note), std::string::npos) << format;
  const Json below =
      Json::parse(tool(flags + "json " + folder.write("few.gltf", lights_in_view_and_behind(200, 0)).string()).out);
  EXPECT_FALSE(below["structures"][0].contains("limit_notes"));
}

TEST(SizeCommand, says_what_frames_lose_with_the_value_that_the_engine_comes_with) {
  const Folder folder;
  const std::string scene = folder.write("many.gltf", lights_in_view_and_behind(100, 0)).string();
  const Json limits = limits_of("three-js", scene);
  EXPECT_EQ(limits[0]["with_own_value"], Json({{"value", 1024}, {"lost", 0}}));
  EXPECT_EQ(limits[1]["with_own_value"], Json({{"value", 64}, {"lost", 36}}));
  const Outcome told = tool("size -q --viewport 640x360 --engine three-js " + scene);
  EXPECT_NE(told.out.find("with its own 64: the longest list loses 36 lights"), std::string::npos) << told.out;
}

}  // namespace
}  // namespace clusterbench
