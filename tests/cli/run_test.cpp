// `clusterbench run`: from a configuration, scenes and flags to a result.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/lamps.h"
#include "cli/small_config.h"
#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

TEST(Run, a_configuration_gives_a_result_that_its_own_schema_accepts) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const std::string out = (folder / "result.json").string();
  const Outcome done = tool("run " + config + " -o " + out);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(tool("validate " + out).code, 0);
  const Json result = Json::parse(file_text(out));
  EXPECT_EQ(result["cases"].size(), 3u);
  for (const Json& entry : result["cases"]) {
    EXPECT_EQ(entry["error"]["false_negatives"], 0);
    EXPECT_GT(entry["error"]["true_pairs"], 0);
    EXPECT_GT(entry["timing"]["assign_ns"]["median"], 0);
  }
  EXPECT_EQ(result["skipped"].size(), 3u);
  EXPECT_FALSE(std::filesystem::exists(out + ".partial"));
}

TEST(Run, what_is_timed_says_when_and_how_it_was_made_and_what_is_counted_only_does_not) {
  const Folder folder;
  const std::string config = folder.write("small config.json", small_config()).string();
  const std::string out = (folder / "r.json").string(), command = "run -q '" + config + "' -o " + out;
  ASSERT_EQ(tool(command).code, 0);
  const Json timed = Json::parse(file_text(out));
  EXPECT_EQ(timed["command"], "clusterbench " + command);
  EXPECT_EQ(timed["date"].get<std::string>().size(), sizeof "2026-01-02T03:04:05Z" - 1);
  EXPECT_GE(timed["machine"]["load"]["end"], 0.0);
  ASSERT_EQ(tool(command + " --no-timing").code, 0);
  const Json counted = Json::parse(file_text(out));
  for (const char* key : {"date", "command"}) EXPECT_FALSE(counted.contains(key)) << key;
  for (const char* key : {"load", "clock_mhz"}) EXPECT_FALSE(counted["machine"].contains(key)) << key;
}

TEST(Run, several_processes_measure_cold_and_warm_times_by_default) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const std::string out = (folder / "result.json").string();
  const Outcome done = tool("run " + config + " --filter /frustum --rounds 6 --launches 3 -o " + out);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.err.find("with cold caches"), std::string::npos) << done.err;
  const Json result = Json::parse(file_text(out));
  ASSERT_EQ(result["cases"].size(), 2u);
  for (const Json& entry : result["cases"]) {
    const Json& timing = entry["timing"];
    EXPECT_EQ(timing["caches"], "cold");
    EXPECT_EQ(timing["launches"], 3);
    EXPECT_EQ(timing["frame_ns"]["samples"].size(), 6u);
    EXPECT_EQ(timing["warm"]["assign_ns"]["samples"].size(), 6u);
    EXPECT_GT(timing["warm"]["convert_ns"]["min"], 0.0);
  }
  const Outcome ratios = tool("ratio " + out + " --all-pairs --csv " + (folder / "r.csv").string());
  EXPECT_EQ(ratios.code, 0) << ratios.err;
  EXPECT_NE(ratios.out.find("aabb / packed"), std::string::npos) << ratios.out;
  const std::string csv = file_text(folder / "r.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3) << csv;

  ASSERT_EQ(tool("run -q " + config + " --filter /frustum --launches 1 --set timing.cold=false -o " + out).code, 0);
  const Json here = Json::parse(file_text(out))["cases"][0]["timing"];
  EXPECT_EQ(here["launches"], 1);
  EXPECT_EQ(here["caches"], "warm");
  EXPECT_FALSE(here.contains("warm"));
  EXPECT_EQ(here["frame_ns"]["samples"].size(), 3u);
}

TEST(Run, of_two_scenes_with_one_name_each_launch_measures_the_right_one) {
  const Folder folder;
  std::filesystem::create_directory(folder / "other");
  std::filesystem::copy_file(source_file("scenes/mirror.glb"), folder / "other" / "street.glb");
  const std::string out = (folder / "result.json").string(),
                    scenes = source_file("scenes/street.glb") + " " + (folder / "other" / "street.glb").string();
  const Outcome done = tool("run -q " + scenes + " --grid world --assigner world-grid-fast --filter '-2/' --rounds 2" +
                            " --launches 2 --set timing.min_time_ms=0.1 --set 'scenes.*.frames=2' -o " + out);
  ASSERT_EQ(done.code, 0) << done.err;
  const Json cases = Json::parse(file_text(out))["cases"];
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_EQ(cases[0]["timing"]["launches"], 2);
}

// Not in quiet runs alone: what estimates the duration meets the same obstacle before, in another case.
TEST(Run, what_cannot_be_counted_is_the_same_error_with_the_same_cases_on_any_number_of_threads) {
  const Folder folder;
  const std::string config = folder
                                 .write("large.json", R"({
      "scenes": [{"rig": {"lights": [100, 1000], "spots": 0.3, "range": [3, 15], "size": [60, 10, 60]}}],
      "viewports": [[320, 200]],
      "grids": [{"tiles": {"count": [4, 4]}}, {"kind": "world", "cells": [64, 16, 64]}],
      "assigners": ["exact-fast", "world-grid"], "limits": {"memory_mib": 1}})")
                                 .string();
  std::string first, cases;
  for (const char* threads : {"1", "2", "8", "64"}) {
    const std::string out = (folder / (std::string("r") + threads + ".json")).string();
    const Outcome done = tool("run " + config + " --no-timing --threads " + threads + " -o " + out);
    EXPECT_NE(done.code, 0);
    std::string error = done.err.substr(done.err.rfind("clusterbench: rig-100"));
    error = error.substr(0, error.find("; what was measured"));
    EXPECT_NE(error.find("/world 64x16x64/world-grid/packed: limits.memory_mib: "), std::string::npos) << done.err;
    const std::string kept = file_text(out + ".partial");
    if (first.empty()) first = error, cases = kept;
    EXPECT_EQ(error, first) << threads;
    EXPECT_EQ(kept, cases) << threads;
  }
}

TEST(Run, counts_are_byte_identical_on_any_number_of_threads) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const std::string text = (folder / "one.json").string(), two = (folder / "two.json").string();
  ASSERT_EQ(tool("run --no-timing --threads 1 " + config + " -o " + text).code, 0);
  ASSERT_EQ(tool("run --no-timing --threads 2 " + config + " -o " + two).code, 0);
  Json first = Json::parse(file_text(text)), second = Json::parse(file_text(two));
  first["config"].erase("threads");
  second["config"].erase("threads");
  EXPECT_EQ(first.dump(), second.dump());
}

// Structures without lists leave out what they do not have, and all that reads results takes that.
TEST(Run, light_structures_of_their_own_give_results_that_everything_reads) {
  const Folder folder;
  const std::string config =
      folder
          .write("own.json", R"({"scenes": [{"path": ")" + source_file("scenes/street.glb") + R"(", "frames": 2}],
              "viewport": [640, 360], "grids": [{"kind": "frustum"}, {"kind": "world", "cells": [16, 4, 16]}],
              "assigners": ["z-binning", "bvh"], "timing": {"sweep_mib": 4, "rounds": 2, "min_time_ms": 0.1, "frames": 1},
              "details": {}, "lookup": {"samples": 200}, "stability": {"steps": 3}})")
          .string();
  const std::string out = (folder / "own result.json").string(), quoted = "'" + out + "'";
  const Outcome done = tool("run " + config + " -o " + quoted);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(tool("validate " + quoted).code, 0) << tool("validate " + quoted).err;
  const Json result = Json::parse(file_text(out));
  ASSERT_EQ(result["cases"].size(), 4u) << "z-binning on one grid, bvh on two, and once by samples";
  for (const Json& entry : result["cases"]) {
    EXPECT_EQ(entry["storage"] == "own", !entry["timing"].contains("convert_ns")) << entry["name"];
    EXPECT_EQ(entry["storage"] == "own" && entry["assigner"]["name"] == "bvh", !entry.contains("error"))
        << entry["name"];
    EXPECT_EQ(entry.contains("error"),
              entry.contains("occupancy") && entry.contains("details") && entry.contains("stability"));
    if (entry.contains("error")) {
      EXPECT_EQ(entry["error"]["false_negatives"], 0) << entry["name"];
    }
    EXPECT_GT(entry["shading"]["needed"], 0) << entry["name"];
  }
  const std::string page = (folder / "page.html").string(), history = (folder / "history.jsonl").string();
  for (const std::string& command :
       {"compare " + quoted + " " + quoted, "size " + quoted, "export --format csv " + quoted, "merge " + quoted,
        "report -o " + page + " " + quoted, "history add " + quoted + " " + history})
    EXPECT_EQ(tool(command).code, 0) << command << ": " << tool(command).err;
}

TEST(Run, flags_change_what_is_measured_and_stand_in_the_result_and_in_the_journal) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const std::string out = (folder / "r.json").string();
  const std::string flags =
      " --grid frustum --tiles 32,128 --slices 4 --assigner \"*-fast\" --viewport 320x180"
      " --set \"scenes.*.frames=2\" --no-timing -q -o " +
      out;
  ASSERT_EQ(tool("run " + config + flags).code, 0);
  const Json result = Json::parse(file_text(out));
  EXPECT_EQ(result["config"]["grids"], Json::parse(R"([{"kind": "frustum", "tiles": {"pixels": [[32, 32], [128, 128]]},
    "slices": {"scheme": "exponential-first", "count": 4, "near": null, "first": 5, "far": 200}}])"));
  EXPECT_EQ(result["config"]["viewports"], Json::parse("[[320, 180]]"));
  EXPECT_EQ(result["config"]["scenes"][0]["frames"], 2);
  EXPECT_EQ(result["cases"].size(), 8u);
  std::string dry = tool("run --dry-run -o x " + config + flags.substr(0, flags.find(" --no-timing"))).out;
  EXPECT_NE(dry.find("frustum 128px x 4 exponential-first ..5..200/exact-fast/packed"), std::string::npos) << dry;
}

// three.js writes orthographic cameras whose near plane is at 0.
TEST(Run, an_orthographic_camera_from_0_has_every_frustum_grid_and_loses_nothing) {
  const Folder folder;
  const std::string scene =
      folder
          .write("ortho.gltf", R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "range": 5},
        {"type": "spot", "range": 9, "spot": {"outerConeAngle": 0.5}}]}},
      "cameras": [{"type": "orthographic", "orthographic": {"xmag": 16, "ymag": 9, "znear": 0, "zfar": 60}}],
      "nodes": [{"name": "eye", "camera": 0},
        {"translation": [0, 0, -2], "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"translation": [6, 3, -30], "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"translation": [-4, 0, 3], "extensions": {"KHR_lights_punctual": {"light": 1}}}],
      "scenes": [{"nodes": [0, 1, 2, 3]}], "scene": 0})")
          .string();
  const std::string output = (folder / "result.json").string();
  const Outcome done = tool("run " + scene + " --grid frustum --tiles 64 --slices 8 --no-timing -o " + output +
                            " --set 'grids.*.slices.scheme=linear,exponential,exponential-first,power,fit'");
  EXPECT_EQ(done.code, 0) << done.err;
  const Json result = Json::parse(file_text(output));
  std::set<std::string> schemes;
  for (const Json& one : result["cases"]) {
    if (one.contains("error")) {
      EXPECT_EQ(one["error"]["false_negatives"], 0) << one["name"];
    }
    EXPECT_EQ(one["shading"]["missed"], 0) << one["name"];
    schemes.insert(one["grid"]["name"]);
  }
  EXPECT_GE(schemes.size(), 5u);
  for (const Json& skipped : result["skipped"])
    EXPECT_EQ(skipped["reason"].get<std::string>().find("slices.near"), std::string::npos) << skipped;
}

TEST(Run, a_note_that_differs_between_cameras_names_them) {
  const Folder folder;
  nlohmann::json level = nlohmann::json::parse(test::level_of(test::row_of(8), true));
  level["nodes"].push_back({{"name", "far away"}, {"camera", 0}, {"translation", {0.0, 0.0, 30.0}}});
  level["scenes"][0]["nodes"].push_back(level["nodes"].size() - 1);
  const std::string flags = " --grid frustum --tiles 16x9t --slices 4 --assigner exact-fast --no-timing ";
  const std::string scene = folder.write("level.gltf", level.dump()).string();
  const std::string one = tool("run " + scene + flags + "--set scenes.*.camera=camera").err,
                    all = tool("run " + scene + flags).err;
  EXPECT_NE(one.find("note: level, frustum 16x9"), std::string::npos) << one;
  for (const char* camera : {"camera", "far away"})
    EXPECT_NE(all.find("note: level, camera " + std::string(camera) + ", frustum 16x9"), std::string::npos) << all;
}

TEST(Run, a_field_of_view_that_changes_no_camera_is_told) {
  const Folder folder;
  const std::string level = folder
                                .write("level.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"nodes": [0, 1]}], "extensionsUsed": ["KHR_lights_punctual"],
    "cameras": [{"type": "orthographic", "orthographic": {"xmag": 5, "ymag": 5, "znear": 0, "zfar": 50}}],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "range": 3, "intensity": 10}]}},
    "nodes": [{"name": "top", "camera": 0},
      {"translation": [0, 0, -5], "extensions": {"KHR_lights_punctual": {"light": 0}}}]})")
                                .string();
  const std::string told =
      "--fov (scenes.*.fov) changes nothing for 1 camera, orthographic or given by its sides: 'top'";
  const std::string flags = " --no-timing --grid frustum --tiles 64 --slices 4 --assigner exact-fast";
  for (const std::string command : {"run", "recommend"}) {
    const std::string base = command + " " + level + flags + (command == "run" ? " -o /dev/null" : "");
    EXPECT_NE(tool(base + " --fov 90h").err.find(told), std::string::npos) << command << tool(base + " --fov 90h").err;
    EXPECT_EQ(tool(base).err.find("--fov"), std::string::npos) << command;
  }
  EXPECT_EQ(
      tool("run " + source_file("scenes/street.glb") + flags + " --fov 90h --set 'scenes.*.frames=1' -o /dev/null")
          .err.find("changes nothing"),
      std::string::npos);
}

TEST(Run, a_field_of_view_is_a_flag) {
  const Folder folder;
  const std::string output = (folder / "result.json").string();
  const auto entries = [&](const std::string& flags) {
    const Outcome done = tool("run " + source_file("scenes/street.glb") +
                              " -q --no-timing --grid frustum --tiles 64 --slices 4 --assigner aabb-fast"
                              " --set 'scenes.*.frames=2' -o " +
                              output + " " + flags);
    EXPECT_EQ(done.code, 0) << done.err;
    return Json::parse(file_text(output))["cases"][0]["buffers"]["index_entries"]["high_water"].get<int>();
  };
  EXPECT_EQ(entries("--fov 60v"), entries("")) << "as the file has it";
  EXPECT_NE(entries("--fov 90h"), entries(""));
  EXPECT_NE(tool("run " + source_file("scenes/street.glb") + " --fov 90").err.find("takes degrees above 0"),
            std::string::npos);
  EXPECT_EQ(tool("run " + source_file("scenes/street.glb") + " --fov 90h --viewport 9000x100").code, 2);
  const Outcome info = tool("scene info " + source_file("scenes/street.glb"));
  EXPECT_NE(info.out.find("vertical FOV 60°, horizontal 91.49° in 16:9, 0.1 m"), std::string::npos) << info.out;
}

TEST(Run, a_dry_run_lists_cases_and_measures_nothing) {
  const Folder folder;
  const Outcome done = tool("run --dry-run " + folder.write("small.json", small_config()).string());
  EXPECT_EQ(done.code, 0);
  EXPECT_NE(done.out.find("/sphere-refinement"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("skipped"), std::string::npos) << done.out;
}

TEST(Run, a_dry_run_tells_each_reason_once) {
  const Folder folder;
  const auto config = folder.write("two.json", R"({"scenes": [{"path": ")" + source_file("scenes/outlier.glb") + R"(",
    "frames": 1}], "grids": [{"kind": "frustum", "slices": {"count": [4, 8]}}, {"kind": "world"}],
    "assigners": ["aabb", "world-grid", "tiled"]})");
  const Outcome done = tool("run --dry-run " + config.string());
  ASSERT_EQ(done.code, 0) << done.err;
  const std::string skipped = done.out.substr(std::min(done.out.find("skipped"), done.out.size()));
  EXPECT_EQ(skipped,
            "skipped  outlier/walk/frustum 64px x 4 exponential-first first 5/tiled and 1 more: tiled needs a depth "
            "buffer, and the scene has no triangles\n"
            "skipped  4 combinations of a method with a kind of grid that it does not take (`clusterbench list` tells "
            "which it takes)\n");
  EXPECT_NE(done.err.find("3 cases, 6 skipped; takes "), std::string::npos) << done.err;
}

TEST(Run, a_filter_selects_cases_by_name) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const Outcome done = tool("run --quiet --no-timing --filter '/aabb/' " + config);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(Json::parse(done.out)["cases"].size(), 1u);
  EXPECT_EQ(tool("run --filter '(' " + config).code, 2);
  EXPECT_EQ(tool("run --filter '([a-z/ 0-9.-]+)+!' " + config).code, 2) << "ends, though by backtracking it would not";
  EXPECT_EQ(tool("run --filter nothing-like-this " + config).code, 2);
}

TEST(Run, a_scene_alone_is_enough) {
  const Folder folder;
  const std::string out = (folder / "result.json").string();
  const Outcome done = tool("run --no-timing " + source_file("scenes/outlier.glb") + " -o " + out);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_GT(Json::parse(file_text(out))["cases"].size(), 4u);
}

TEST(Run, scenes_and_configurations_are_not_mixed) {
  EXPECT_EQ(tool("run a.json b.glb").code, 2);
  EXPECT_EQ(tool("run missing.json").code, 2);
  EXPECT_EQ(tool("run missing.glb").code, 2);
}

}  // namespace
}  // namespace clusterbench::test
