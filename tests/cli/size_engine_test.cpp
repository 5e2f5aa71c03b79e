// `clusterbench size --engine`: which clustering of the engine is sized, and in which grid.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <utility>

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

// So many points at the eye, whose ranges hold every cell.
std::string lights_everywhere(int count) {
  Json scene = Json::parse(lights_in_view_and_behind(count, 0));
  for (Json& light : scene["extensions"]["KHR_lights_punctual"]["lights"]) light["range"] = 500.0;
  return scene.dump();
}

TEST(SizeEngine, keeps_an_engines_method_where_flags_name_another_grid_that_it_can_be_set_to) {
  const std::string flags = " --viewport 640x360 --set scenes.*.frames=5 " + test::source_file("scenes/street.glb");
  const auto structures = [&](const std::string& more) {
    const Outcome done = tool("size -q --format json " + more + flags);
    EXPECT_EQ(done.code, 0) << done.err;
    return Json::parse(done.out)["structures"];
  };
  const Json tiles = structures("--engine unreal --tiles 32,128 --slices 16");
  ASSERT_EQ(tiles.size(), 2u);
  EXPECT_EQ(tiles[0]["settings"]["grid"], "r.Forward.LightGridPixelSize 32, r.Forward.LightGridSizeZ 16");
  EXPECT_EQ(tiles[1]["settings"]["grid"], "r.Forward.LightGridPixelSize 128, r.Forward.LightGridSizeZ 16");
  for (const Json& structure : tiles) {
    EXPECT_EQ(structure["assigner"], "brute-force");
    EXPECT_EQ(structure["storage"], "linked");
    EXPECT_EQ(structure["settings"]["limits"][0]["value_for_all"], structure["settings"]["limits"][0]["value"])
        << "grids that differ are alternatives";
  }
  const Outcome told = tool("size -q --engine unreal --tiles 32,128" + flags);
  EXPECT_NE(told.out.find("\nTake one of these grids and set its values"), std::string::npos) << told.out;
  const Json cells = structures("--engine playcanvas --grid world --set 'grids.0.cells=[[12,4,12]]'");
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_EQ(cells[0]["settings"]["grid"], "scene.lighting.cells = new pc.Vec3(12, 4, 12)");
  EXPECT_EQ(structures("--engine bevy --tiles 8x4t --slices 12")[0]["settings"]["grid"],
            "ClusterConfig::XYZ { dimensions: UVec3::new(8, 4, 12), .. }");
}

// Its own pool, which is full, does not say what would be enough.
TEST(SizeEngine, a_full_pool_is_told_with_what_it_would_need) {
  const Folder folder;
  for (const int lights : {31, 33, 60}) {
    const std::string scene = folder.write("level.gltf", lights_everywhere(lights)).string();
    const Outcome done = tool("size -q --engine unreal --margin 1 --format json --viewport 320x180 " + scene);
    ASSERT_EQ(done.code, 0) << done.err;
    const Json limit = Json::parse(done.out)["structures"][0]["settings"]["limits"][0];
    EXPECT_EQ(limit["seen"], lights) << limit;
    EXPECT_EQ(limit["value"], lights) << limit;
  }
}

TEST(SizeEngine, refuses_of_an_engines_clustering_what_it_has_no_setting_for) {
  const std::pair<const char*, const char*> refused[] = {
      {"--engine unreal --set 'grids.*.slices.far=4000'",
       "--set 'scenes.*.far=METRES' sets that; of the grid of Unreal"},
      {"--engine unreal --tiles 16x9t",
       "--tiles=16x9t: is no setting of it; of the grid of Unreal Engine can be set: "
       "--tiles N (pixels of a square tile), --slices N"},
      {"--engine unreal --tiles 64x32", "its tiles are square, and [64,32] is not"},
      {"--engine unreal --scheme linear", "--scheme=linear: is no setting of it"},
      {"--engine unreal --grid world", "--grid=world: is no setting of it"},
      {"--engine unreal --assigner exact-fast", "names another method or other lists"},
      {"--engine godot --slices 16", "of the grid of Godot 4 nothing can be set"},
      {"--engine bevy --tiles 32", "can be set: --tiles XxYt (tiles across and down), --slices N"},
      {"--engine unreal --slices 0", "--slices=0"}};
  for (const auto& [flags, message] : refused) {
    const Outcome done = tool(std::string("size -q ") + flags + " " + test::source_file("scenes/street.glb"));
    EXPECT_EQ(done.code, 2) << flags;
    EXPECT_NE(done.err.find(message), std::string::npos) << flags << ": " << done.err;
  }
}

// Without a far plane, and with one that is a game's: what Unreal's pool needs does not change with it, which its
// slices do not follow, and the end of the others' is a far plane that is told.
TEST(SizeEngine, an_engines_setting_does_not_come_of_a_far_plane_that_is_made_up) {
  const Folder folder;
  Json scene = Json::parse(lights_in_view_and_behind(60, 0));
  scene["cameras"][0]["perspective"].erase("zfar");
  const std::string endless = folder.write("endless.gltf", scene.dump()).string();
  const auto seen = [&](const std::string& more) {
    const Outcome done = tool("size -q --format json --viewport 640x360 " + more + " " + endless);
    EXPECT_EQ(done.code, 0) << done.err;
    return Json::parse(done.out)["structures"][0];
  };
  EXPECT_EQ(seen("--engine unreal")["buffers"], seen("--engine unreal --set scenes.*.far=4000")["buffers"]);
  const Json three = seen("--engine three-js"), near = seen("--engine three-js --set scenes.*.far=20");
  const std::string note = three["grid_notes"][0];
  EXPECT_NE(note.find("the camera has no far plane: the grid ends at 2000 m"), std::string::npos) << note;
  EXPECT_NE(note.find("--set 'scenes.*.far=METRES'"), std::string::npos) << note;
  EXPECT_FALSE(near.contains("grid_notes")) << near["grid_notes"];
}

TEST(SizeEngine, a_search_keeps_the_end_that_an_engine_gives_slices_of_a_camera_without_a_far_plane) {
  const Folder folder;
  Json scene = Json::parse(lights_in_view_and_behind(3, 0));
  scene["cameras"][0]["perspective"].erase("zfar");
  const std::string endless = folder.write("endless.gltf", scene.dump()).string(),
                    found = (folder / "found.json").string();
  for (const auto& [preset, end] : {std::pair("filament", "..at most 100"), std::pair("three-js", "..far or 2000")}) {
    const Outcome done = tool(std::string("worst-case -q --viewport 640x360 --evaluations 2 --random 0 --preset ") +
                              preset + " -o " + found + " " + endless);
    ASSERT_EQ(done.code, 0) << done.err;
    const std::string grid = Json::parse(file_text(found))["case"]["grid"];
    EXPECT_NE(grid.find(end), std::string::npos) << grid;
  }
}

}  // namespace
}  // namespace clusterbench
