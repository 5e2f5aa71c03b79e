#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/lamps.h"
#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

// A configuration of a few small cases on one of the project's own scenes.
std::string small_config(const std::string& more = "") {
  return R"({"name": "small", "scenes": [{"path": ")" + source_file("scenes/street.glb") + R"(", "frames": 3}],
    "viewport": [640, 360],
    "grids": [{"kind": "frustum", "tiles": {"pixels": [64, 64]}, "slices": {"scheme": "exponential-first", "count": 8, "far": 200}},
              {"kind": "world", "cells": [16, 4, 16]}],
    "assigners": ["aabb", "sphere-refinement", "world-grid"],
    "timing": {"rounds": 3, "min_time_ms": 1, "frames": 2})" +
         more + "}";
}

Json without_timing(Json result) {
  for (const char* key : {"machine", "pareto_front", "conclusions", "date", "command"}) result.erase(key);
  for (Json& entry : result["cases"])
    for (const char* key : {"timing", "count"}) entry.erase(key);
  return result;
}

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
              "assigners": ["z-binning", "bvh"], "timing": {"rounds": 2, "min_time_ms": 0.1, "frames": 1},
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

TEST(Run, the_result_goes_to_standard_output_without_a_file) {
  const Folder folder;
  const Outcome done = tool("run --quiet --no-timing " + folder.write("small.json", small_config()).string());
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(Json::parse(done.out)["schema_version"], 2);
  EXPECT_EQ(done.err, "");
}

TEST(Run, on_a_terminal_the_table_is_shown_and_the_result_only_on_request) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const Outcome shown = tool_on_terminal("run --no-timing " + config);
  EXPECT_EQ(shown.code, 0) << shown.out;
  EXPECT_NE(shown.out.find("excess"), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("clusterbench: the result is not kept; -o FILE keeps it"), std::string::npos) << shown.out;
  EXPECT_EQ(shown.out.find("schema_version"), std::string::npos) << shown.out;
  EXPECT_NE(tool_on_terminal("run --no-timing -o - " + config).out.find("schema_version"), std::string::npos);
  EXPECT_NE(tool("run --no-timing " + config).out.find("schema_version"), std::string::npos);
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

TEST(Run, the_last_line_is_a_conclusion_in_the_words_of_the_result_and_of_the_page) {
  const Folder folder;
  const std::string output = (folder / "result.json").string(), page = (folder / "page.html").string();
  const Outcome done = tool("run " + source_file("scenes/street.glb") +
                            " --no-timing --grid frustum --tiles 64 --slices 4 --assigner aabb-fast,exact-fast,bvh"
                            " --set 'scenes.*.frames=2' -o " +
                            output);
  EXPECT_EQ(done.code, 0) << done.err;
  const std::size_t begin = done.err.rfind("conclusion: ");
  ASSERT_NE(begin, std::string::npos) << done.err;
  const std::string last = done.err.substr(begin);
  EXPECT_EQ(last.find('\n'), last.size() - 1) << last;
  const Json result = Json::parse(file_text(output));
  ASSERT_EQ(result["conclusions"].size(), 1u);
  const auto text = result["conclusions"][0]["text"].get<std::string>();
  EXPECT_EQ(last, "conclusion: " + text + "\n");
  // Of the level itself, of which more frames are counted than of the result.
  const std::size_t next =
      done.err.find("next: clusterbench size " + source_file("scenes/street.glb") + " --grid=frustum ");
  ASSERT_NE(next, std::string::npos) << done.err;
  const std::string command = done.err.substr(next + 18, done.err.find("   sizes", next) - next - 18);
  const Outcome sized = tool(command);
  EXPECT_EQ(sized.code, 0) << command << sized.err;
  EXPECT_NE(sized.out.find("(1 camera, 2 frames)"), std::string::npos) << "as its flags say: " << sized.out;
  EXPECT_NE(text.find("take frustum"), std::string::npos) << text;
  const Json front = result["pareto_front"][0]["ids"];
  EXPECT_NE(std::find(front.begin(), front.end(), result["conclusions"][0]["take"]), front.end());
  EXPECT_EQ(tool("report " + output + " -o " + page).code, 0);
  EXPECT_NE(file_text(page).find(text), std::string::npos);
}

TEST(Run, a_run_that_failed_concludes_nothing_on_the_terminal_in_the_result_and_on_the_page) {
  const Folder folder;
  const std::string output = (folder / "result.json").string(), page = (folder / "report.html").string();
  const Outcome done = tool("run " + source_file("scenes/street.glb") +
                            " --no-timing --grid frustum --tiles 64 --slices 4 --assigner aabb-fast,exact-fast"
                            " --set 'scenes.*.frames=2' --fail-if 'exact-fast: longest > 1' -o " +
                            output);
  EXPECT_EQ(done.code, 1);
  const std::size_t failed = done.err.find("FAILED street/"), end = done.err.rfind("conclusion: ");
  ASSERT_NE(end, std::string::npos) << done.err;
  EXPECT_LT(failed, end) << done.err;
  const std::string failure = done.err.substr(failed + 7, done.err.find('\n', failed) - failed - 7);
  EXPECT_TRUE(failure.ends_with("fails with exact-fast: longest > 1")) << failure;
  EXPECT_EQ(done.err.substr(end), "conclusion: none, since the run FAILED: " + failure + ".\n");
  EXPECT_EQ(done.err.find("conclusion: "), end) << "the only one";
  const Json result = Json::parse(file_text(output));
  EXPECT_EQ(result["failed"], Json::array({failure}));
  EXPECT_TRUE(result["conclusions"][0]["take"].is_null());
  const auto text = result["conclusions"][0]["text"].get<std::string>();
  EXPECT_EQ(text, "street, camera walk, 1920x1080: nothing to take: the run FAILED: " + failure + ".");
  EXPECT_EQ(tool("validate " + output).code, 0);
  EXPECT_EQ(tool("report " + output + " -o " + page).code, 0);
  EXPECT_NE(file_text(page).find("nothing to take: the run FAILED: "), std::string::npos);
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

TEST(Run, quiet_hides_progress_and_table_and_no_warning) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const Outcome done =
      tool("run -q --rounds 1 --launches 1 --filter '/aabb/' -o " + (folder / "r.json").string() + " " + config);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.err.find("warning: 1 of 1 time without an interval: "), std::string::npos) << done.err;
  EXPECT_EQ(done.err.find("frame us"), std::string::npos) << done.err;
}

TEST(Run, a_scene_alone_is_enough) {
  const Folder folder;
  const std::string out = (folder / "result.json").string();
  const Outcome done = tool("run --no-timing " + source_file("scenes/outlier.glb") + " -o " + out);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_GT(Json::parse(file_text(out))["cases"].size(), 4u);
}

TEST(Run, a_place_that_cannot_be_written_is_noticed_before_measuring) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const Outcome missing = tool("run " + config + " -o " + (folder / "no/such/folder/r.json").string());
  EXPECT_EQ(missing.code, 2);
  EXPECT_NE(missing.err.find("no/such/folder"), std::string::npos) << missing.err;
  EXPECT_EQ(missing.err.find("aabb"), std::string::npos) << "measured first: " << missing.err;
  const Outcome full = tool("run " + config + " -o /dev/full");
  EXPECT_EQ(full.code, 70);
  EXPECT_EQ(full.err.find("aabb"), std::string::npos) << "measured first: " << full.err;
}

TEST(Run, scenes_and_configurations_are_not_mixed) {
  EXPECT_EQ(tool("run a.json b.glb").code, 2);
  EXPECT_EQ(tool("run missing.json").code, 2);
  EXPECT_EQ(tool("run missing.glb").code, 2);
}

// Starts a run, waits for its journal, then ends it as a shutting-down machine would.
int interrupt(const std::string& config, const std::string& out, const std::string& messages = "/dev/null",
              const std::string& signal = "TERM") {
  const std::string run = test::program() + " run -q " + config + " -o " + out;
  const std::string wait_for_journal = "while [ ! -s " + out + ".partial ]; do sleep 0.01; done";
  const int status = std::system(
      (run + " 2>" + messages + " & pid=$!; " + wait_for_journal + "; kill -" + signal + " $pid; wait $pid").c_str());
  return WEXITSTATUS(status);
}

std::string slow_config() {
  std::string text = small_config();
  const std::string quick = R"("rounds": 3)";
  return text.replace(text.find(quick), quick.size(), R"("rounds": 500)");
}

TEST(Run, a_termination_signal_keeps_what_is_finished_and_exits_75) {
  const Folder folder;
  const std::string config = folder.write("slow.json", slow_config()).string();
  const std::string out = (folder / "r.json").string();
  const std::string messages = (folder / "messages").string();
  EXPECT_EQ(interrupt(config, out, messages), 75);
  EXPECT_FALSE(std::filesystem::exists(out));
  const std::string told = file_text(messages);
  const bool has_finished_some = told.find("what was measured is in") != std::string::npos;
  EXPECT_EQ(std::filesystem::exists(out + ".partial"), has_finished_some) << told;
  EXPECT_NE(told.find("interrupted"), std::string::npos);
  EXPECT_NE(told.find("--resume goes on"), std::string::npos) << told;
}

TEST(Run, an_interrupted_run_resumes_to_the_same_counts) {
  const Folder folder;
  const std::string config = folder.write("slow.json", slow_config()).string();
  const std::string whole = (folder / "whole.json").string(), cut = (folder / "cut.json").string();
  ASSERT_EQ(tool("run -q " + config + " -o " + whole).code, 0);
  ASSERT_EQ(interrupt(config, cut, "/dev/null", "KILL"), 128 + 9);
  const Json complete = Json::parse(file_text(whole));
  std::ofstream(cut + ".partial", std::ios::app) << journal_line(complete["cases"][0]) << "\n";

  const Outcome refused = tool("run -q --resume --filter aabb " + config + " -o " + cut);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("is an interrupted run of another"), std::string::npos) << refused.err;
  EXPECT_EQ(tool("run -q --resume --tiles 32 " + config + " -o " + cut).code, 2);

  const std::size_t all = complete["cases"].size();
  const Outcome left = tool("run --resume --dry-run " + config + " -o " + cut);
  EXPECT_EQ(left.code, 0) << left.err;
  EXPECT_NE(left.err.find(" left of " + std::to_string(all) + ", "), std::string::npos) << left.err;
  EXPECT_EQ(left.out.find(complete["cases"][0]["id"].get<std::string>()), std::string::npos) << left.out;
  EXPECT_FALSE(std::filesystem::exists(cut)) << "nothing is measured";

  const Outcome resumed = tool("run -q --resume --threads 2 " + config + " -o " + cut);
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(resumed.err.find("clusterbench: "), std::string::npos) << resumed.err;  // warnings of times may be
  Json same = without_timing(Json::parse(file_text(cut)));
  EXPECT_EQ(same["config"]["threads"], 2);
  same["config"]["threads"] = 1;
  EXPECT_EQ(same.dump(), without_timing(complete).dump());
}

TEST(Run, an_output_in_a_folder_that_is_not_there_names_the_folder_before_anything_is_measured) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  for (const std::string& output :
       {std::string("-o nodir/x.json"), std::string("-o x.json --export csv=nodir/x.csv")}) {
    const Outcome done = tool_in(folder.path(), "run -q " + config + " " + output);
    EXPECT_EQ(done.code, 2);
    EXPECT_NE(done.err.find("cannot be written: there is no folder 'nodir'; make it first (mkdir -p)"),
              std::string::npos)
        << done.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "x.json"));
  folder.write("file", "");
  const Outcome in_file = tool_in(folder.path(), "run -q " + config + " -o file/x.json");
  EXPECT_NE(in_file.err.find("'file' is no folder"), std::string::npos) << in_file.err;
}

TEST(Run, resuming_without_an_interrupted_run_says_that_it_begins_anew) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string(), out = (folder / "r.json").string();
  const Outcome done = tool("run -q --no-timing --resume " + config + " -o " + out);
  EXPECT_EQ(done.code, 0);
  EXPECT_EQ(done.err, "clusterbench: --resume begins anew: nothing that an interrupted run has measured is in " + out +
                          ".partial\n");
}

TEST(Run, a_budget_that_is_exceeded_fails_the_run_and_one_nearly_reached_is_warned_about) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string(), out = (folder / "r.json").string();
  const std::string run = "run -q --no-timing --filter /aabb/ " + config + " -o " + out;
  ASSERT_EQ(tool(run).code, 0);
  const Json entry = Json::parse(file_text(out))["cases"][0];
  const int longest = entry["occupancy"]["lights_per_cell"]["max"];
  const auto with = [&](const std::string& rule) { return tool(run + " --fail-if '" + rule + "'"); };
  const Outcome broken = with("longest > " + std::to_string(longest - 1));
  EXPECT_EQ(broken.code, 1);
  EXPECT_NE(broken.err.find("FAILED " + entry["name"].get<std::string>() + ": longest is "), std::string::npos);
  EXPECT_NE(broken.err.find(", cell ["), std::string::npos) << broken.err;
  const Outcome near = with("longest > " + std::to_string(longest));
  EXPECT_EQ(near.code, 0);
  EXPECT_NE(near.err.find("warning: " + entry["name"].get<std::string>()), std::string::npos) << near.err;
  const Outcome far = with("longest > " + std::to_string(2 * longest));
  EXPECT_EQ(far.code, 0);
  EXPECT_EQ(far.err, "");
  EXPECT_EQ(Json::parse(file_text(out))["config"]["limits"]["fail_if"][0], "longest > " + std::to_string(2 * longest));
  EXPECT_EQ(with("frame_us > 1e6").code, 1) << "times are not measured";
  EXPECT_EQ(with("lngest > 1").code, 2);
}

// Two results that look good in time, bytes and false positives, and lack lights.
struct Misleading {
  const Folder folder;

  Json cases_of(const std::string& config, const std::string& flags = "") const {
    const std::string file = folder.write("misleading.json", config).string();
    return Json::parse(tool("run -q --no-timing -o - " + file + flags).out);
  }
  Outcome table_of(const std::string& flags) const {
    return tool("run --no-timing -o " + (folder / "r.json").string() + " " + (folder / "misleading.json").string() +
                flags);
  }
};

TEST(Run, a_grid_that_ends_before_the_lights_looks_no_better_than_it_is) {
  const Misleading run;
  const Json result = run.cases_of(R"({"scenes": [{"rig": {"lights": 1000, "range": 4, "size": [64, 16, 64]}}],
    "grids": [{"slices": {"far": 20}}, {}], "assigners": ["exact-fast"]})");
  const Json &ends = result["cases"][0], &holds = result["cases"][1];
  EXPECT_EQ(ends["error"]["false_negatives"], 0) << "what the cells alone say";
  EXPECT_LT(ends["buffers"]["bytes"]["high_water"], holds["buffers"]["bytes"]["high_water"]);
  EXPECT_GT(ends["shading"]["unlit"], 0.05);
  EXPECT_EQ(ends["shading"]["missed_in_cells"], 0);
  EXPECT_TRUE(ends["shading"]["overshade"].is_null());
  EXPECT_EQ(result["pareto_front"][0]["ids"], Json::array({holds["id"]})) << result["pareto_front"];
  const Outcome shown = run.table_of("");
  EXPECT_EQ(shown.code, 0);
  EXPECT_NE(shown.err.find(" outside of the grid; most in frame 0, "), std::string::npos) << shown.err;
  const Outcome gated = run.table_of(" --fail-if 'unlit > 0.001'");
  EXPECT_EQ(gated.code, 1);
  EXPECT_NE(gated.err.find("FAILED " + ends["name"].get<std::string>() + ": unlit is "), std::string::npos)
      << gated.err;
}

TEST(Run, a_storage_that_drops_lights_fails_the_run_unless_it_may) {
  const Misleading run;
  const Json result = run.cases_of(R"({"scenes": [{"rig": {"lights": 1000, "range": 8, "size": [64, 16, 64]}}],
    "grids": [{"tiles": {"count": [16, 9]}}], "assigners": ["exact-fast"],
    "storages": ["packed", {"name": "fixed", "cap": 5}]})");
  const Json &packed = result["cases"][0], &fixed = result["cases"][1];
  EXPECT_EQ(fixed["error"]["false_negatives"], 0) << "what the method alone says";
  EXPECT_LT(fixed["buffers"]["bytes"]["high_water"], packed["buffers"]["bytes"]["high_water"]);
  EXPECT_GT(fixed["buffers"]["overflow"]["dropped_pairs"], 1000);
  EXPECT_GT(fixed["shading"]["unlit"], 0.05);
  EXPECT_EQ(result["pareto_front"][0]["ids"], Json::array({packed["id"]})) << result["pareto_front"];
  const Outcome fails = run.table_of("");
  EXPECT_EQ(fails.code, 1);
  EXPECT_NE(fails.err.find("  dropped  "), std::string::npos) << fails.err;
  EXPECT_NE(fails.err.find("FAILED " + fixed["name"].get<std::string>()), std::string::npos) << fails.err;
  const Outcome allowed = run.table_of(" --set limits.dropped_pairs=null");
  EXPECT_EQ(allowed.code, 0);
  EXPECT_NE(allowed.err.find("warning: " + fixed["name"].get<std::string>()), std::string::npos) << allowed.err;
}

TEST(Run, a_result_goes_where_a_link_leads) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const std::filesystem::path link = folder / "link.json", target = folder / "target.json";
  std::filesystem::create_symlink("target.json", link);
  ASSERT_EQ(tool("run -q --no-timing " + config + " -o " + link.string()).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(Json::parse(file_text(target))["name"], "small");
  const std::filesystem::path circle = folder / "circle.json";
  std::filesystem::create_symlink("circle.json", circle);
  EXPECT_EQ(tool("run -q --no-timing " + config + " -o " + circle.string()).code, 2);
}

TEST(Run, a_run_that_died_does_not_block_the_next_one) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const std::string out = (folder / "r.json").string();
  ASSERT_EQ(tool("run -q --no-timing " + config + " -o " + out).code, 0);
  const Json kept{{"case", Json::parse(file_text(out))["cases"][0]}};
  folder.write("r.json.partial", "{\"header\": {}}\n" + kept.dump() + "\n");
  const Outcome again = tool("run -q --no-timing " + config + " -o " + out);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.err, "clusterbench: " + out + ".partial, left by a run that did not end, is now " + out +
                           ".partial.1 (--resume goes on with such a file)\n");
  EXPECT_NE(file_text(out + ".partial.1").find(kept.dump()), std::string::npos);
}

TEST(Size, prints_constants_for_a_result) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const std::string out = (folder / "result.json").string();
  ASSERT_EQ(tool("run --no-timing -q " + config + " -o " + out).code, 0);
  const Outcome done = tool("size --format cpp " + out);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("constexpr"), std::string::npos) << done.out;
}

// What a command reads is not written over, nor one output by another.
TEST(Run, an_output_over_an_input_or_another_output_is_refused) {
  const Folder folder;
  const std::string scene = (folder / "level.glb").string(), link = (folder / "link.glb").string();
  const std::string results = (folder / "r.json").string();
  std::filesystem::copy_file(source_file("scenes/street.glb"), scene);
  std::filesystem::create_symlink("level.glb", link);
  const std::string before = file_text(scene);
  const std::string config =
      folder.write("c.json", R"({"scenes": [{"path": "level.glb", "frames": 1}], "assigners": ["aabb"]})").string();
  for (const std::string& arguments :
       {scene + " -o " + scene, scene + " -o " + link, config + " -o " + config, config + " -o " + scene,
        config + " -o " + results + " --export csv=" + scene, config + " -o " + results + " --export csv=" + results}) {
    const Outcome refused = tool("run --no-timing " + arguments);
    EXPECT_EQ(refused.code, 2) << arguments << refused.err;
    EXPECT_NE(refused.err.find("name a"), std::string::npos) << refused.err;
  }
  EXPECT_EQ(file_text(scene), before);
}

TEST(Run, a_folder_is_no_input) {
  for (const char* command : {"run", "validate"}) {
    const Outcome refused = tool(std::string(command) + " " + std::filesystem::temp_directory_path().string());
    EXPECT_EQ(refused.code, 2) << refused.err;
    EXPECT_NE(refused.err.find("is a folder, not a file"), std::string::npos) << refused.err;
  }
}

}  // namespace
}  // namespace clusterbench::test
