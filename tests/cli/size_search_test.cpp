// `clusterbench size --worst-case`: the search for frames, and sizes with room for them.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/three_cameras.h"
#include "cli/tool.h"

namespace clusterbench {
namespace {

using Json = nlohmann::json;
using test::file_text;
using test::Folder;
using test::Outcome;
using test::three_cameras;
using test::tool;

TEST(SizeCommand, worst_case_is_searched_first_and_the_capacity_has_room_for_what_it_finds) {
  const Folder folder;
  const std::string scene = folder.write("level.gltf", three_cameras()).string();
  const std::string flags = " --grid frustum --tiles 120 --slices 8 --assigner exact-fast --set storages=packed,fixed ";
  for (const std::string margin : {"1", "2"}) {
    const Outcome done = tool("size -q --all --worst-case --evaluations 300 --margin " + margin + " --format json" +
                              flags + "--set scenes.0.camera=before " + scene);
    ASSERT_EQ(done.code, 0) << done.err;
    const Json sized = Json::parse(done.out);
    for (const Json& structure : sized["structures"]) {
      const Json& buffer = structure["buffers"][0];
      EXPECT_EQ(structure["search"]["evaluations"], 300);
      EXPECT_GT(buffer["found"], buffer["high_water"]) << "the camera stands before the lights";
      EXPECT_GE(buffer["capacity"], buffer["found"]);
    }
  }
  const std::string found = (folder / "found.json").string(), result = (folder / "result.json").string();
  const std::string one = " --grid frustum --tiles 120 --slices 8 --assigner exact-fast --set scenes.*.camera=before ";
  ASSERT_EQ(tool("worst-case -q --evaluations 300 --random 0 -o " + found + one + scene).code, 0);
  ASSERT_EQ(tool("run -q --no-timing -o " + result + one + scene).code, 0);
  const Outcome by_file = tool("size --found " + found + " " + result);
  EXPECT_NE(by_file.out.find("found by the search x 2"), std::string::npos) << by_file.out << by_file.err;
  EXPECT_EQ(tool("size --worst-case " + result).code, 2) << "a result holds no scene";
}

// Of methods with the same lists only one is searched, and its find makes it the larger one.
TEST(SizeCommand, what_was_searched_is_what_is_printed) {
  const Folder folder;
  const std::string scene = folder.write("level.gltf", three_cameras()).string(),
                    methods =
                        " --grid frustum --tiles 120 --slices 8 --assigner exact,exact-fast,brute-force "
                        "--set scenes.*.camera=before ";
  for (const char* format : {"table", "hlsl"}) {
    const Outcome done =
        tool(std::string("size -q --worst-case --evaluations 300 --format ") + format + methods + scene);
    ASSERT_EQ(done.code, 0) << done.err;
    EXPECT_EQ(done.out.find("not searched"), std::string::npos) << done.out;
    EXPECT_NE(done.out.find("in 300 frames tried (seed 1)"), std::string::npos) << done.out;
  }
}

TEST(SizeCommand, budgets_hold_what_a_search_found) {
  const Folder folder;
  const std::string scene = folder.write("level.gltf", three_cameras()).string(),
                    flags =
                        " --grid frustum --tiles 120 --slices 8 --assigner exact-fast --set scenes.*.camera=before "
                        "--worst-case --evaluations 300 ";
  const Json buffer = Json::parse(tool("size -q --format json" + flags + scene).out)["structures"][0]["buffers"][0];
  const auto seen = buffer["high_water"].get<int>(), found = buffer["found"].get<int>();
  ASSERT_GT(found, seen);
  const auto gated = [&](const std::string& figure, int limit) {
    return tool("size -q --fail-if '" + figure + " > " + std::to_string(limit) + "'" + flags + scene);
  };
  EXPECT_EQ(gated("index_entries", found).code, 0);
  const Outcome broken = gated("index_entries", found - 1);
  EXPECT_EQ(broken.code, 1) << broken.err;
  EXPECT_NE(broken.err.find("index_entries is " + std::to_string(found) + ", "), std::string::npos) << broken.err;
  EXPECT_NE(broken.err.find("; found by a search"), std::string::npos) << broken.err;
  EXPECT_NE(broken.err.find("budgets also hold what a search for entries found, in 1 of 1 case"), std::string::npos)
      << broken.err;
  const Outcome recorded = gated("index_entries", seen - 1);
  EXPECT_EQ(recorded.code, 1);
}

TEST(SizeCommand, shares_the_seconds_of_a_search_among_all) {
  const std::string street = test::source_file("scenes/street.glb");
  const Outcome done = tool(
      "size -q --worst-case --seconds 0.001 --engine playcanvas --format json --viewport 640x360 "
      "--set scenes.*.frames=3 " +
      street);
  ASSERT_EQ(done.code, 0) << done.err;
  const Json sized = Json::parse(done.out);
  for (const Json& limit : sized["structures"][0]["settings"]["limits"]) {
    const Json& search = limit.at("search");
    if (search.contains("refusal"))  // on a machine where not one frame takes so little
      EXPECT_EQ(search["refusal"], "its seconds were over before its first frame; allow more (--seconds)") << limit;
    else
      EXPECT_LT(search.at("evaluations"), 5000) << limit;
  }
}

// Three cameras of which none sees all forty lights.
TEST(SizeCommand, searches_for_what_an_engines_settings_have_to_have_room_for) {
  const Folder folder;
  const std::string scene = folder.write("level.gltf", three_cameras()).string(),
                    camera = "--viewport 640x360 --set scenes.0.camera=before " + scene;
  const auto limits = [&](const std::string& engine) {
    const Outcome done =
        tool("size -q --worst-case --evaluations 300 --margin 1 --format json --engine " + engine + " " + camera);
    EXPECT_EQ(done.code, 0) << done.err;
    return Json::parse(done.out)["structures"][0]["settings"]["limits"];
  };
  const Json cells = limits("playcanvas"), types = limits("godot"), bevy = limits("bevy");
  EXPECT_EQ(cells[0]["search"]["measure"], "longest");
  EXPECT_EQ(cells[1]["search"]["measure"], "lights");
  EXPECT_EQ(types[0]["search"]["measure"], "lights-of-type");
  EXPECT_EQ(bevy[0]["search"]["measure"], "entries");
  for (const Json& limit : {cells[0], cells[1], types[0], bevy[0]}) {
    EXPECT_EQ(limit["search"]["evaluations"], 300);
    EXPECT_GE(limit["found"], limit["seen"]) << limit;
    EXPECT_TRUE(limit["value"].is_null() || limit["value"] >= limit["found"]) << limit;
  }
  EXPECT_EQ(cells[1]["found"], 40) << "one place sees all lights";
  const std::string found = (folder / "found.json").string();
  ASSERT_EQ(tool("worst-case -q --evaluations 300 --random 0 --measure lights --preset playcanvas --filter playcanvas "
                 "-o " +
                 found + " " + camera)
                .code,
            0);
  EXPECT_EQ(Json::parse(file_text(found))["frames"][0]["value"], cells[1]["found"]);
  const Outcome told = tool("size --worst-case --evaluations 300 --engine playcanvas " + camera);
  EXPECT_NE(told.out.find("the most found by a search: 40 lights in view in 300 frames tried"), std::string::npos)
      << told.out;
  EXPECT_NE(told.err.find(", then searches 300 frames for worse ones, 2 times, "), std::string::npos) << told.err;
  EXPECT_NE(told.err.find("--evaluations N"), std::string::npos) << told.err;
}

}  // namespace
}  // namespace clusterbench
