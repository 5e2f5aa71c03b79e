// `clusterbench size` as a user calls it.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/lights_in_view.h"
#include "cli/small_config.h"
#include "cli/three_cameras.h"
#include "cli/tool.h"

namespace clusterbench {
namespace {

using Json = nlohmann::json;
using test::file_text;
using test::Folder;
using test::lights_in_view_and_behind;
using test::Outcome;
using test::small_config;
using test::three_cameras;
using test::tool;

const std::string k_flags =
    " --grid frustum --tiles 120 --slices 8 --assigner exact-fast,z-binning"
    " --set storages=packed,bitfield,linked,fixed";

TEST(SizeCommand, of_a_scene_says_what_a_run_of_all_its_cameras_says) {
  const Folder folder;
  const std::string scene = folder.write("level.gltf", three_cameras()).string();
  const std::string result = (folder / "result.json").string();
  const Outcome run = tool("run -q --no-timing -o " + result + k_flags + " " + scene + " --set 'scenes.*.camera=*'" +
                           " --set accuracy.check=false");
  ASSERT_EQ(run.code, 0) << run.err;
  const Outcome direct = tool("size -q --all --format json" + k_flags + " " + scene),
                of_result = tool("size --all --format json " + result);
  EXPECT_EQ(direct.code, 0) << direct.err;
  // What the result's conclusion takes is of the result alone.
  Json without_choice = Json::parse(of_result.out);
  for (Json& structure : without_choice["structures"]) structure.erase("choice");
  EXPECT_EQ(Json::parse(direct.out), without_choice);
  const Json sized = Json::parse(direct.out), cases = Json::parse(file_text(result))["cases"];
  EXPECT_EQ(sized["structures"].size(), 5u);
  for (const Json& structure : sized["structures"]) {
    EXPECT_EQ(structure["cameras"], Json({"inside", "before", "away"}));
    for (const Json& buffer : structure["buffers"]) {
      std::uint64_t most = 0;
      for (const Json& one : cases)
        for (const Json& of_case : one["buffers"]["each"])
          if (one["storage"] == structure["storage"] && of_case["name"] == buffer["name"])
            most = std::max(most, of_case["high_water"].get<std::uint64_t>());
      EXPECT_EQ(buffer["high_water"], most) << structure["name"] << buffer["name"];
      EXPECT_EQ(buffer["frames"]["max"], most);
      EXPECT_LE(buffer["frames"]["min"], buffer["frames"]["p50"]);
    }
  }
}

// The floor is found for samples alone, with a warning.
TEST(SizeCommand, takes_samples_only_where_they_can_decide_among_structures) {
  const Folder folder;
  const std::string size = "size --format json --grid frustum --tiles 120 --slices 8 " +
                           folder.write("level.gltf", three_cameras()).string();
  const std::string samples = " --set samples.opaque.ground=lowest", floor = "its opaque samples lie on a floor";
  const auto takes_samples = [&](const std::string& structures) {
    const Outcome with = tool(size + structures + samples), without = tool(size + structures);
    EXPECT_EQ(with.code, 0) << with.err;
    EXPECT_EQ(with.out, without.out) << structures;
    return with.err.find(floor) != std::string::npos;
  };
  EXPECT_FALSE(takes_samples(" --assigner z-binning")) << "one structure";
  EXPECT_FALSE(takes_samples(" --assigner exact-fast,aabb-fast --set storages=packed,bitfield"))
      << "no list lacks a light";
  EXPECT_TRUE(takes_samples(" --assigner exact-fast,z-binning --set storages=packed"))
      << "only samples can show that a structure without cells loses lights";
}

TEST(SizeCommand, counts_the_same_lists_as_details_show) {
  const Folder folder;
  const std::string scene = folder.write("level.gltf", three_cameras()).string();
  const std::string flags =
      " --grid frustum --tiles 480 --slices 4 --assigner exact-fast --set storages=packed,fixed " + scene;
  const Outcome run = tool("run -q --no-timing -o -" + flags + R"( --set 'scenes.*.camera=inside' --set details={})");
  ASSERT_EQ(run.code, 0) << run.err;
  const Json of_run = Json::parse(run.out)["cases"][0];
  const Json sized =
      Json::parse(tool("size -q --all --format json --set 'scenes.*.camera=inside'" + flags).out)["structures"];
  const auto longest = of_run["occupancy"]["lights_per_cell"]["max"].get<std::uint64_t>();
  EXPECT_EQ(sized[0]["buffers"][0]["high_water"], of_run["occupancy"]["pairs"]["max"]);
  // Tiles of 480 pixels: 4 x 3.
  EXPECT_EQ(sized[1]["buffers"][0]["high_water"], longest * 4 * 3 * 4);
}

TEST(SizeCommand, takes_a_configuration_with_the_cameras_that_it_names) {
  const Folder folder;
  folder.write("level.gltf", three_cameras());
  const auto cameras = [&](const std::string& scene) {
    const std::string config = folder
                                   .write("c.json", R"({
      // as configurations may
      "scenes": [)" + scene + R"(], "grids": [{"tiles": {"count": [4, 4]}, "slices": {"count": 4}}],
      "assigners": ["aabb"]})")
                                   .string();
    const Outcome done = tool("size -q --format json " + config);
    EXPECT_EQ(done.code, 0) << done.err;
    return Json::parse(done.out)["structures"][0]["cameras"];
  };
  EXPECT_EQ(cameras(R"("level.gltf")"), Json({"inside", "before", "away"}));
  EXPECT_EQ(cameras(R"({"path": "level.gltf", "camera": "before"})"), Json({"before"}));
}

TEST(SizeCommand, prints_every_format_for_a_scene_of_no_lights_in_reach) {
  const Folder folder;
  const std::string scene = folder.write("dark.gltf", three_cameras(R"({"type": "directional"})")).string();
  for (const std::string format : {"table", "cpp", "hlsl", "glsl", "json"}) {
    const Outcome done = tool("size -q --all --allow-no-lights --format " + format + k_flags + " " + scene);
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_EQ(tool("size -q --all --format " + format + k_flags + " " + scene).code, 1);
    EXPECT_FALSE(done.out.empty());
  }
}

TEST(SizeCommand, refuses_what_it_cannot_size_and_says_why) {
  const Folder folder;
  const std::string scene = folder.write("level.gltf", three_cameras()).string();
  const std::string result = (folder / "result.json").string();
  ASSERT_EQ(tool("run -q --no-timing --grid frustum --assigner aabb -o " + result + " " + scene).code, 0);
  const auto refuses = [](const std::string& arguments, const std::string& why) {
    const Outcome done = tool("size " + arguments);
    EXPECT_EQ(done.code, 2) << arguments;
    EXPECT_NE(done.err.find(why), std::string::npos) << arguments << ": " << done.err;
    EXPECT_EQ(done.out, "");
  };
  refuses(result + " --filter nothing", "'nothing' matches none of");
  refuses(result + " --tiles 16x9", "--tiles: changes what is measured");
  refuses(result + " " + result, "takes one configuration");
  refuses(folder.write("c.json", R"({"scene": []})").string(), "c.json");
  refuses(folder.write("empty.json", "").string(), "is empty");
  refuses((folder / "absent.json").string(), "cannot be read");
  refuses(folder.write("cut.json", file_text(result).substr(0, 1000)).string(), "is not JSON");
  refuses(result + " --margin 0.5", "--margin: takes a number");
  refuses(result + " --round pages", "did you mean 'page'");
  refuses(result + " --format cpp --name '1st'", "--name: '1st' is no name in C++, HLSL and GLSL alike");
  refuses(result + " --format cpp --name ''", "--name: takes a text that is not empty");
}

// A camera that passes a lamp within a tenth of a second: 30 frames of the path miss it.
TEST(SizeCommand, samples_paths_as_finely_as_they_have_keys_and_says_so) {
  const Folder folder;
  const std::string street = test::source_file("scenes/street.glb"),
                    flags = " --grid frustum --tiles 128 --slices 4 --assigner exact-fast ";
  const Outcome done = tool("size --format json" + flags + street),
                few = tool("size -q --format json --set 'scenes.*.frames=30'" + flags + street);
  ASSERT_EQ(done.code, 0) << done.err;
  const Json all = Json::parse(done.out)["structures"][0], thirty = Json::parse(few.out)["structures"][0];
  EXPECT_EQ(thirty["frames"], 30) << "what is asked for is kept";
  EXPECT_GT(all["frames"], 100);
  EXPECT_GE(all["buffers"][0]["high_water"], thirty["buffers"][0]["high_water"]);
  EXPECT_EQ(all["buffers"][0]["high_water_of_every"].size(), 4u);
  EXPECT_NE(done.err.find("counts " + all["frames"].dump() + " frames of 1 camera path"), std::string::npos)
      << done.err;
  EXPECT_NE(done.err.find("scenes.*.frames=N"), std::string::npos) << done.err;
  EXPECT_EQ(few.err, "");
}

TEST(SizeCommand, frames_of_a_configuration_are_kept_and_others_are_sampled_finely) {
  const Folder folder;
  std::filesystem::copy_file(test::source_file("scenes/street.glb"), folder / "level.glb");
  const auto frames = [&](const std::string& scene) {
    const std::string config = folder
                                   .write("c.json", R"({"scenes": [)" + scene + R"(], "assigners": ["aabb"],
      "grids": [{"tiles": {"count": [4, 4]}, "slices": {"count": 4}}]})")
                                   .string();
    return Json::parse(tool("size -q --format json " + config).out)["structures"][0]["frames"].get<int>();
  };
  EXPECT_EQ(frames(R"({"path": "level.glb", "frames": 7})"), 7);
  EXPECT_GT(frames(R"("level.glb")"), 100);
}

TEST(SizeCommand, views_that_stand_still_are_told_apart_all_the_same) {
  const Folder folder;
  const std::string scene = folder.write("level.gltf", three_cameras()).string();
  const Outcome done =
      tool("size --grid frustum --tiles 120 --slices 8 --assigner exact-fast --views inside,before " + scene);
  ASSERT_EQ(done.code, 0) << done.err;
  for (const char* row : {"    inside + before       indices", "    away                  indices"})
    EXPECT_NE(done.out.find(row), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("most indices in camera"), std::string::npos) << done.out;
}

TEST(SizeCommand, two_eyes_need_the_sum_of_both_and_one_grid_for_both_lacks_lights_at_its_sides) {
  const Folder folder;
  const std::string eyes = (folder / "eyes.glb").string(), street = test::source_file("scenes/street.glb");
  ASSERT_EQ(tool("scene views " + street + " --eyes 0.5 -o " + eyes).code, 0);
  const std::string flags =
      " --grid frustum --tiles 64 --slices 16 --assigner exact-fast --set scenes.*.frames=20 " + eyes;
  const auto mark = [&](const std::string& more) {
    const Outcome done = tool("size -q --format json " + more + flags);
    EXPECT_EQ(done.code, 0) << done.err;
    return Json::parse(done.out)["structures"][0];
  };
  const Json left = mark("--set scenes.*.camera=left"), both = mark("--views left,right"),
             shared = mark("--views left,right --grid-of left"), wide = mark("--views 'l*,r*' --grid-of left");
  const auto entries = [](const Json& structure) { return structure["buffers"][0]["high_water"].get<double>(); };
  EXPECT_GT(entries(both), 1.8 * entries(left));
  EXPECT_LT(entries(shared), entries(both));
  ASSERT_EQ(shared["guests"].size(), 1u);
  EXPECT_EQ(shared["guests"], wide["guests"]);
  EXPECT_EQ(shared["guests"][0]["camera"], "right");
  EXPECT_GT(shared["guests"][0]["outside"], 0);
  EXPECT_GT(shared["guests"][0]["missed"], 0);
  EXPECT_LT(shared["guests"][0]["missed"].get<double>(), 0.5 * shared["guests"][0]["needed"].get<double>());
  EXPECT_EQ(tool("size -q --views left,rihgt" + flags).code, 2);
  EXPECT_EQ(tool("size -q --views left,right --grid-of walk" + flags).code, 2);
}

TEST(SizeCommand, of_65536_lights_result_gate_and_size_have_headers_of_one_size) {
  const Folder folder;
  const std::string config = folder
                                 .write("c.json", R"({"scenes": [{"rig": {"lights": 65536, "range": 0.5}, "frames": 1}],
      "grids": [{"tiles": {"count": [4, 4]}, "slices": {"count": 4}}], "assigners": ["exact-fast"],
      "accuracy": {"check": false}})")
                                 .string(),
                    result = (folder / "result.json").string();
  ASSERT_EQ(tool("run -q --no-timing -o " + result + " " + config).code, 0);
  const Json buffers = Json::parse(file_text(result))["cases"][0]["buffers"];
  EXPECT_EQ(buffers["each"][1]["element_bytes"], 12);
  EXPECT_EQ(buffers["header_bytes"], 12 * 64);
  const auto index_bytes =
      buffers["each"][0]["element_bytes"].get<std::uint64_t>() * buffers["each"][0]["high_water"].get<std::uint64_t>();
  EXPECT_EQ(buffers["bytes"]["high_water"], index_bytes + 12 * 64);
  const Json sized = Json::parse(tool("size --format json --margin 1 --round none " + result).out)["structures"][0];
  EXPECT_EQ(sized["bytes"], buffers["bytes"]["high_water"]);
}

TEST(SizeCommand, says_of_frames_without_a_light_in_view_that_they_size_nothing) {
  const Folder folder;
  const std::string scene = folder.write("behind.gltf", lights_in_view_and_behind(0, 5)).string();
  for (const std::string flags : {"--format table", "--format hlsl", "--engine playcanvas", "--engine godot"}) {
    const Outcome told = tool("size -q --viewport 640x360 " + flags + " " + scene);
    EXPECT_EQ(told.code, 1);
    EXPECT_NE(told.out.find("NO LIGHT was ever in view"), std::string::npos) << told.out;
    EXPECT_EQ(told.out.find("Set these values"), std::string::npos) << told.out;
    EXPECT_EQ(told.out.find("Allocate these"), std::string::npos) << told.out;
    EXPECT_NE(told.err.find("FAILED behind/"), std::string::npos) << told.err;
    EXPECT_NE(told.err.find("NO LIGHT was ever in view"), std::string::npos) << told.err;
  }
}

TEST(SizeCommand, json_of_frames_without_a_light_in_view_says_that_nothing_was_seen) {
  const Folder folder;
  const std::string behind = folder.write("behind.gltf", lights_in_view_and_behind(0, 5)).string(),
                    before = folder.write("before.gltf", lights_in_view_and_behind(5, 5)).string(),
                    flags = "size -q --viewport 640x360 --format json --engine playcanvas ";
  const Outcome dark = tool(flags + behind);
  EXPECT_EQ(dark.code, 1);
  const Json none = Json::parse(dark.out)["structures"][0],
             some = Json::parse(tool(flags + before).out)["structures"][0];
  EXPECT_NE(none["nothing_seen"].get<std::string>().find("NO LIGHT was ever in view"), std::string::npos);
  EXPECT_EQ(none["settings"]["limits"][0]["value"], Json()) << "nothing to set";
  EXPECT_EQ(some["nothing_seen"], Json());
  EXPECT_EQ(some["settings"]["limits"][0]["value"], 10);
  // What is meant to be so, and what a search finds, is a result.
  EXPECT_EQ(tool(flags + "--allow-no-lights " + behind).code, 0);
  EXPECT_EQ(tool(flags + "--set limits.allow_no_lights=true " + behind).code, 0);
  const Outcome searched = tool(flags + "--worst-case --evaluations 300 " + behind);
  EXPECT_EQ(searched.code, 0) << searched.err;
  const Json found = Json::parse(searched.out)["structures"][0];
  EXPECT_NE(found["nothing_seen"], Json());
  EXPECT_GT(found["settings"]["limits"][0]["value"], 0);
}

// In view by its bounding sphere, and beyond the last slice: no list ever has it.
TEST(SizeCommand, lists_that_are_all_empty_size_nothing_either) {
  const Folder folder;
  const std::string scene = folder.write("far.gltf", lights_in_view_and_behind(3, 0)).string();
  const Outcome done = tool(
      "size -q --viewport 640x360 --grid frustum --tiles 16x9t --slices 8 --assigner exact-fast --format json "
      "--set grids.0.slices.scheme=exponential --set grids.0.slices.far=2 " +
      scene);
  EXPECT_EQ(done.code, 1);
  EXPECT_NE(done.err.find("NO LIST ever had a light"), std::string::npos) << done.err << done.out;
}

TEST(SizeCommand, refuses_flags_that_it_would_not_heed) {
  const std::string street = test::source_file("scenes/street.glb");
  for (const std::string flag : {"--add-lights 4x10", "--move-lights 2", "--within 0,0,0,1,1,1", "--walkable",
                                 "--evaluations 50", "--seed 1", "--seconds 1", "--eye-height 2"}) {
    const Outcome done = tool("size -q " + flag + " " + street);
    EXPECT_EQ(done.code, 2) << flag;
    EXPECT_NE(done.err.find("--worst-case"), std::string::npos) << done.err;
  }
}

TEST(SizeCommand, holds_what_it_counts_against_the_budgets_of_a_configuration_and_of_a_flag) {
  const Folder folder;
  folder.write("level.gltf", three_cameras());
  const auto sized =
      [&](const std::string& budgets, const std::string& flags = "") {
        return tool("size -q --format json " + flags +
                    folder
                        .write("c.json", R"({"scenes": [{"path": "level.gltf", "camera": "inside"}],
        "grids": [{"tiles": {"count": [4, 4]}, "slices": {"count": 4}}], "assigners": ["exact-fast"],
        "limits": {"fail_if": [)" + budgets + "]}}")
                        .string());
      };
  const Outcome held = sized(R"("index_entries > 100000", "longest <= 0")");
  EXPECT_EQ(held.code, 0) << held.err;
  const Outcome broken = sized(R"("longest > 2")");
  EXPECT_EQ(broken.code, 1);
  EXPECT_NE(broken.err.find("longest is "), std::string::npos) << broken.err;
  EXPECT_NE(broken.err.find("and fails with longest > 2"), std::string::npos) << broken.err;
  EXPECT_EQ(Json::parse(broken.out)["structures"].size(), 1u) << "the sizes are printed all the same";
  EXPECT_EQ(sized("", "--fail-if 'longest > 2' ").code, 1);
  for (const char* figure : {"lights_lit", "lights_seen"}) {
    const Outcome lights = sized("\"" + std::string(figure) + " < 1000\"");
    EXPECT_EQ(lights.code, 1) << lights.err;
    EXPECT_NE(lights.err.find(std::string("and fails with ") + figure + " < 1000"), std::string::npos) << lights.err;
  }
  // What only `run` measures is told, and is no success that nobody checked.
  const Outcome others = sized(R"("frame_us > 0", "missed > 0", "unlit > 0", "longest > 2")");
  EXPECT_EQ(others.code, 1);
  for (const char* budget : {"frame_us > 0", "missed > 0", "unlit > 0"})
    EXPECT_NE(others.err.find(budget), std::string::npos) << others.err;
  EXPECT_NE(others.err.find("`clusterbench run` does"), std::string::npos) << others.err;
  const Outcome relative = sized(R"("longest > +5 %")");
  EXPECT_EQ(relative.code, 0) << relative.err;
  EXPECT_NE(relative.err.find("'longest > +5 %'"), std::string::npos) << relative.err;
}

// Methods hold more or less by the order of their frames.
TEST(SizeCommand, a_budget_on_scratch_memory_is_held_alike_on_any_number_of_threads) {
  const auto told_on = [](const std::string& threads) {
    const Outcome done = tool("size -q --grid frustum --tiles 32 --slices 8 --assigner exact-fast,aabb-fast " +
                              test::source_file("scenes/street.glb") +
                              " --set 'scenes.*.frames=40' --fail-if 'scratch_bytes > 1' --threads " + threads);
    EXPECT_EQ(done.code, 1) << done.err;
    return done.err;
  };
  const std::string one = told_on("1");
  EXPECT_NE(one.find("scratch_bytes is "), std::string::npos) << one;
  for (const char* threads : {"2", "5"}) EXPECT_EQ(told_on(threads), one) << threads;
}

TEST(SizeCommand, indices_are_as_wide_as_the_lights_that_the_capacity_holds_for_ask) {
  const Folder folder;
  const std::string scene = folder.write("s.gltf", lights_in_view_and_behind(255, 0)).string(),
                    found = (folder / "found.json").string(),
                    flags = " -q --viewport 640x360 --grid frustum --tiles 16x9t --slices 8 --assigner exact-fast ",
                    search = "--evaluations 20 --add-lights 4x10 ";
  const auto index_bytes = [&](const std::string& more) {
    const Outcome done = tool("size" + flags + "--format json " + more + scene);
    EXPECT_EQ(done.code, 0) << done.err;
    return Json::parse(done.out)["structures"][0]["buffers"][0]["element_bytes"];
  };
  EXPECT_EQ(index_bytes(""), 1);
  EXPECT_EQ(index_bytes("--worst-case " + search), 2);
  ASSERT_EQ(tool("worst-case" + flags + search + "-o " + found + " " + scene).code, 0);
  EXPECT_EQ(index_bytes("--found " + found + " "), 2);
  const Outcome code = tool("size" + flags + "--format glsl --worst-case " + search + scene);
  EXPECT_EQ(code.out.find("& 0xffu"), std::string::npos) << code.out;
}

TEST(SizeCommand, a_capacity_that_is_all_that_there_can_be_is_not_called_a_multiple) {
  const Folder folder;
  const std::string scene = folder.write("s.gltf", lights_in_view_and_behind(1, 0)).string();
  const Outcome done = tool(
      "size -q --viewport 640x360 --grid frustum --tiles 16x9t --slices 24 --assigner exact-fast --worst-case "
      "--evaluations 20 " +
      scene);
  EXPECT_EQ(done.out.find("headers: 3456 = high water x"), std::string::npos) << done.out;
  EXPECT_EQ(done.out.find("indices: 3456 = found by the search x"), std::string::npos) << done.out;
}

TEST(SizeCommand, names_the_case_that_a_filter_meant_and_that_cannot_be) {
  const Folder folder;
  const std::string scene = folder.write("s.gltf", lights_in_view_and_behind(1, 0)).string();
  const Outcome done =
      tool("size -q --grid frustum --tiles 16x9t --slices 8 --assigner aabb,tiled --filter '/tiled' " + scene);
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("1 combination cannot be measured, among them s/eye/"), std::string::npos) << done.err;
  EXPECT_NE(done.err.find("needs a depth buffer"), std::string::npos) << done.err;
}

TEST(SizeCommand, takes_paths_as_long_as_systems_have_them) {
  const Folder folder;
  const std::string scene = folder.write(std::string(240, 's') + ".gltf", three_cameras()).string();
  const Outcome done = tool("size -q --format cpp --grid frustum --tiles 4x4 --assigner aabb " + scene);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("inline constexpr LightBuffer " + std::string(200, 's') + "_indices{"), std::string::npos)
      << done.out;
}

TEST(SizeCommand, prints_constants_for_a_result) {
  const Folder folder;
  const std::string config = folder.write("small.json", small_config()).string();
  const std::string out = (folder / "result.json").string();
  ASSERT_EQ(tool("run --no-timing -q " + config + " -o " + out).code, 0);
  const Outcome done = tool("size --format cpp " + out);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("constexpr"), std::string::npos) << done.out;
}

}  // namespace
}  // namespace clusterbench
