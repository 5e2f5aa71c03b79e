#include "report/size_report/size_report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "core/error.h"
#include "records.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;
using testing::result_by_hand;

std::string size_of(const run::Result& result, const SizeRequest& request = {"", true, "cpp"}) {
  return size_report(record_of(result, {}), request);
}

// Without --all, and without a conclusion, as where scenes are counted.
std::string best_of(const run::Result& result, const std::string& format = "cpp") {
  result::Result record = record_of(result, {});
  record.conclusions.emplace();
  return size_report(record, {"", false, format});
}

TEST(Size, of_times_of_several_machines_the_smallest_structure_is_shown_and_no_conclusion) {
  run::Result by_hand = result_by_hand();
  by_hand.cases[0].buffers.each[0].high_water = 20;  // brute-force, the slower one
  result::Result merged = record_of(by_hand, {});
  const SizeRequest request{"", false, "cpp", "none"};
  EXPECT_NE(size_report(without_times_of_machines(merged), request).find("/aabb/packed"), std::string::npos);
  merged.machines = {{"machine 1", merged.machine, "AVX2", {}}, {"machine 2", merged.machine, "SCALAR", {}}};
  merged.cases[0].machine = "machine 1";
  merged.cases[1].machine = "machine 2";
  const std::string shown = size_report(without_times_of_machines(merged), request);
  EXPECT_NE(shown.find("/brute-force/packed"), std::string::npos) << shown;
  EXPECT_NE(shown.find("the smallest structure that loses no light"), std::string::npos) << shown;
  EXPECT_EQ(shown.find("the conclusion of the result"), std::string::npos) << shown;
}

TEST(Size, of_each_grid_the_fastest_structure_that_loses_nothing_is_shown_under_the_name_of_the_grid) {
  run::Result result = result_by_hand();
  run::CaseResult lossy = testing::case_by_hand("lossy", "broken", 0.5),
                  other = testing::case_by_hand("other", "x", 9.0);
  lossy.error->false_negatives = 1;
  run::CaseResult dropping = testing::case_by_hand("dropping", "drops", 0.5);
  dropping.buffers.dropped_pairs = 1;
  other.name = "hall/walk/frustum 32px/x/packed";
  run::CaseResult own = testing::case_by_hand("own", "hierarchy", 0.5);
  own.storage_label = "own";  // has no lists to allocate for
  run::CaseResult dark = testing::case_by_hand("dark", "short-sighted", 0.5);
  dark.shading->missed = 1;  // of 200 that its samples need
  for (const run::CaseResult& case_result : {lossy, dropping, dark, own, other}) {
    result.cases.push_back(case_result);
    result.planned_ids.push_back(case_result.id);
  }
  const std::string report = best_of(result);
  EXPECT_NE(report.find("// hall/frustum 64px/aabb/packed\n"), std::string::npos) << report;
  EXPECT_NE(report.find("LightBuffer hall_frustum_64px_indices{"), std::string::npos) << report;
  EXPECT_NE(report.find("LightBuffer hall_frustum_32px_indices{"), std::string::npos) << report;
  for (const char* other_name : {"brute-force", "broken", "drops", "hierarchy", "short-sighted"})
    EXPECT_EQ(report.find(other_name), std::string::npos) << report;
  EXPECT_NE(report.find("--all has all 7"), std::string::npos) << report;
  EXPECT_NE(best_of(result, "table").find("--all has all 7"), std::string::npos);
}

TEST(Size, a_structure_that_loses_lights_at_one_camera_comes_after_one_that_loses_none) {
  run::Result result = result_by_hand();
  for (run::CaseResult one : std::vector<run::CaseResult>(result.cases)) {
    one.camera = "fly";
    one.name.replace(one.name.find("walk"), 4, "fly");
    if (one.assigner == "aabb") one.error->false_negatives = 1;
    one.id += "-fly";
    result.cases.push_back(one);
    result.planned_ids.push_back(one.id);
  }
  const std::string report = best_of(result);
  EXPECT_NE(report.find("// hall/frustum 64px/brute-force/packed\n"), std::string::npos) << report;
  EXPECT_NE(report.find("cameras walk, fly\n"), std::string::npos) << report;
}

TEST(Size, a_structure_of_its_own_that_loses_lights_comes_after_one_that_loses_none) {
  run::Result result = result_by_hand();
  result.cases.clear();
  result.planned_ids = {"loses", "keeps"};
  for (const std::string& id : result.planned_ids) {
    run::CaseResult own = testing::case_by_hand(id, id, id == "loses" ? 1.0 : 9.0);
    own.storage_label = "own";
    own.occupancy.reset();
    own.error.reset();
    own.shading->missed = id == "loses" ? 1 : 0;
    own.shading->needed = 1000000;
    result.cases.push_back(own);
  }
  EXPECT_NE(best_of(result).find("// hall/frustum 64px/keeps/packed\n"), std::string::npos) << best_of(result);
}

// Of two cases whose rounds differ by less than they vary the median of either can be the shorter one.
TEST(Size, of_structures_that_may_be_equally_fast_the_smaller_one_is_shown_whichever_was_faster) {
  const std::vector<double> rounds{1000, 1030, 990, 1020, 1012, 1000}, others{1010, 1000, 1020, 1000, 1000, 1010};
  for (const bool is_small_first : {true, false}) {
    run::Result result = result_by_hand();
    run::CaseResult &small = result.cases[0], &large = result.cases[1];
    small.timing->frame_ns = measure::time_stats(is_small_first ? rounds : others, 1, 1);
    large.timing->frame_ns = measure::time_stats(is_small_first ? others : rounds, 1, 1);
    large.buffers.each[0].high_water = large.buffers.each[0].theoretical_max = 10000;
    EXPECT_NE(best_of(result).find("// hall/frustum 64px/brute-force/packed\n"), std::string::npos) << best_of(result);
    for (double& ns : small.timing->frame_ns.samples) ns *= 1.5;
    small.timing->frame_ns = measure::time_stats(small.timing->frame_ns.samples, 1, 1);
    EXPECT_NE(best_of(result).find("// hall/frustum 64px/aabb/packed\n"), std::string::npos)
        << "the other one is known to be faster: " << best_of(result);
  }
}

TEST(Size, without_times_the_smallest_structure_is_shown_and_called_so) {
  run::Result result = result_by_hand();
  EXPECT_NE(best_of(result).find("Of each grid the fastest structure that loses no light, or of those"),
            std::string::npos);
  for (run::CaseResult& one : result.cases) one.timing.reset();
  EXPECT_NE(best_of(result).find("Of each grid the smallest structure that loses no light. --all"), std::string::npos)
      << best_of(result);
}

TEST(Size, the_table_has_the_longest_list_of_all_cameras) {
  EXPECT_NE(best_of(result_by_hand(), "table").find("  longest list: 7 lights\n"), std::string::npos)
      << best_of(result_by_hand(), "table");
}

TEST(Size, the_table_tells_what_is_noted_of_a_grid_once) {
  run::Result result = result_by_hand();
  for (run::CaseResult& one : result.cases) one.grid["note"] = "the camera has no far plane";
  const std::string table = best_of(result, "table"), note = "  grid: the camera has no far plane\n";
  ASSERT_NE(table.find(note), std::string::npos) << table;
  EXPECT_EQ(table.find(note, table.find(note) + 1), std::string::npos) << table;
}

TEST(Size, code_and_json_tell_what_is_noted_of_a_grid_too) {
  run::Result result = result_by_hand();
  EXPECT_EQ(best_of(result, "json").find("grid_notes"), std::string::npos);
  for (run::CaseResult& one : result.cases) one.grid["note"] = "the camera has no far plane\n#error";
  for (const char* language : {"cpp", "hlsl", "glsl"}) {
    const std::string code = best_of(result, language);
    EXPECT_NE(code.find("//   grid: the camera has no far plane_#error\n"), std::string::npos) << code;
  }
  const nlohmann::json json = nlohmann::json::parse(best_of(result, "json"));
  EXPECT_EQ(json["structures"][0]["grid_notes"], nlohmann::json({"the camera has no far plane\n#error"}));
  EXPECT_EQ(config::schema_violations(config::row_of(config::Document::size).schema(), json),
            std::vector<std::string>{});
}

SizeRequest named_request(const std::string& name, const std::string& format = "cpp", bool all = false) {
  SizeRequest request{"", all, format};
  request.name = name;
  return request;
}

TEST(Size, a_name_stands_in_place_of_scene_and_grid) {
  const run::Result result = result_by_hand();
  const std::string code = size_of(result, named_request("lights"));
  EXPECT_NE(code.find("LightBuffer lights_indices{\"lights_indices\", "), std::string::npos) << code;
  EXPECT_EQ(code.find("hall_"), std::string::npos) << code;
  EXPECT_NE(code.find("// hall/frustum 64px/aabb/packed\n"), std::string::npos) << "the comment has the full name";
  const auto json = nlohmann::json::parse(size_of(result, named_request("lights", "json")));
  EXPECT_EQ(json["structures"][0]["identifier"], "lights");
}

TEST(Size, a_name_that_no_language_takes_or_that_several_structures_would_have_is_refused) {
  const run::Result result = result_by_hand();
  const auto refuses = [&](const SizeRequest& request, const std::string& why) {
    try {
      size_of(result, request);
      ADD_FAILURE() << request.name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  for (const char* name : {"9lives", "a b", "a__b", "_a", "a_", "gl_x", "\xC3\xA9", "x;"})
    refuses(named_request(name), "is no name in C++, HLSL and GLSL alike");
  refuses(named_request(std::string(201, 'l')), "at most 200");
  refuses(named_request("lights", "cpp", true), "packed; choose one of them with --filter");
  refuses(named_request("lights", "table"), "a table has no names");
  EXPECT_NO_THROW(size_of(result, named_request(std::string(200, 'l'))));
}

TEST(Size, a_filter_selects_cases_by_name) {
  const std::string report = size_of(result_by_hand(), {"/aabb/", true, "cpp"});
  EXPECT_NE(report.find("// hall/frustum 64px/aabb/packed"), std::string::npos) << report;
  EXPECT_EQ(report.find("--all"), std::string::npos) << "nothing is left out";
  EXPECT_THROW(size_of(result_by_hand(), {"no such", true}), Error);
  EXPECT_THROW(size_of(result_by_hand(), {"(", true}), Error);
}

TEST(Size, says_what_was_seen_where_and_what_to_allocate) {
  const std::string report = size_of(result_by_hand());
  for (const char* part :
       {"// hall/frustum 64px/aabb/packed\n//   camera walk\n",
        "indices: high water 40 in camera walk, frame 1, cell [3,2,1]", "8.33 % of the theoretical 480",
        "frames    min 20, median 20, p90 40, p99 40, max 40",
        "480 elements of 1 byte (all that there can be): 4096 bytes, 8192 double-buffered",
        "_indices\", 480u, 480u, 4096u, 1u}", "headers: high water 24 in camera walk, frame 0, cell [1,1,0]",
        "_headers\", 24u, 24u, 4096u, 8u}"})
    EXPECT_NE(report.find(part), std::string::npos) << part << " in\n" << report;
  const std::string close = size_of(result_by_hand(), {"", true, "cpp", "none", 3.0, 0.5});
  for (const char* part : {"120 elements of 1 byte (high water x 3): 120 bytes", "_indices\", 120u, 60u, 120u, 1u}"})
    EXPECT_NE(close.find(part), std::string::npos) << part << " in\n" << close;
}

TEST(Size, the_table_has_a_row_for_each_buffer) {
  const std::string table = size_of(result_by_hand(), {"/aabb/", false, "table", "none"});
  for (const char* part : {"hall/frustum 64px/aabb/packed  (1 camera, 2 frames)\n", "indices", "headers", "8.33 %",
                           "most indices in camera walk, frame 1, cell [3,2,1]\n", "high water x 2"})
    EXPECT_NE(table.find(part), std::string::npos) << part << " in\n" << table;
  run::Result none = result_by_hand();
  none.cases.clear();
  EXPECT_NE(size_of(none, {"", false, "table"}).find("The result has no cases."), std::string::npos);
}

TEST(Size, json_has_every_number_and_is_as_its_schema_says) {
  const nlohmann::json report = nlohmann::json::parse(size_of(result_by_hand(), {"/aabb/", false, "json", "none"}));
  EXPECT_EQ(config::schema_violations(config::row_of(config::Document::size).schema(), report),
            std::vector<std::string>{});
  EXPECT_EQ(config::document_of(report), config::Document::size);
  ASSERT_EQ(report["structures"].size(), 1u);
  const nlohmann::json expected = nlohmann::json::parse(R"({"name": "indices",
    "identifier": "hall_frustum_64px_indices", "element_bytes": 1, "high_water": 40, "theoretical_max": 480,
    "worst": {"camera": "walk", "frame": 1, "cell": [3, 2, 1]},
    "frames": {"min": 20, "p50": 20, "p90": 40, "p99": 40, "max": 40, "is_exact": true},
    "is_bounded": true, "never_overflows": {"elements": 480, "bytes": 480},
    "capacity": 80, "warn_above": 72, "bytes": 80, "double_buffered_bytes": 160,
    "beyond_the_path": {"refusal": "only 2 frames recorded"}})");
  const nlohmann::json& structure = report["structures"][0];
  EXPECT_EQ(structure["buffers"][0], expected);
  EXPECT_EQ(structure["bytes"], 80 + 8 * 24);
  EXPECT_EQ(structure["lookups"][0]["constants"], nlohmann::json::parse(R"({"cells": [4, 3, 2]})"));
  EXPECT_EQ(report["warn_at"], 0.9);
}

// An older result, one by hand: whatever the schema allows.
TEST(Size, every_format_takes_results_with_holes) {
  const nlohmann::ordered_json whole = result::to_json(record_of(result_by_hand(), {}));
  std::vector<nlohmann::ordered_json> results(5, whole);
  for (auto& entry : results[0]["cases"]) entry["buffers"].erase("each");
  for (auto& entry : results[1]["cases"])
    entry["buffers"]["each"][0]["along_path"]["elements"] = nlohmann::json::array();
  for (auto& entry : results[2]["cases"]) entry["frames"] = 0;
  for (auto& entry : results[3]["cases"]) entry["buffers"]["each"] = nlohmann::json::array();
  for (auto& entry : results[4]["cases"]) entry["buffers"]["each"][0].erase("worst_cell");
  for (const auto& result : results) {
    ASSERT_EQ(config::schema_violations(config::result_schema(), nlohmann::json(result)), std::vector<std::string>{});
    for (const bool all : {false, true})
      for (const std::string& format : size_formats()) {
        const std::string report = size_report(test::result_of(result), {"", all, format});
        EXPECT_NE(report.find("64px"), std::string::npos) << format << report;
        if (format == "json") {
          EXPECT_EQ(
              config::schema_violations(config::row_of(config::Document::size).schema(), nlohmann::json::parse(report)),
              std::vector<std::string>{});
        }
      }
  }
}

TEST(Size, says_where_lists_overflowed) {
  run::Result result = result_by_hand();
  result.cases[0].buffers.dropped_pairs = 7;
  result.cases[0].buffers.overflowing_cells = 3;
  result.cases[0].buffers.overflowing_frames = 1;
  EXPECT_NE(size_of(result).find("OVERFLOW: 7 pairs dropped in 3 cells of 1 frame, for which there is room below"),
            std::string::npos);
}

// Compiles the report as the header that it is, and runs a program that uses it.
class SizeHeader : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  bool compiles(const std::string& header, const std::string& program) const {
    std::ofstream(folder_ / "budget.h") << header;
    std::ofstream(folder_ / "use.cpp") << "#include <initializer_list>\n#include \"budget.h\"\n" << program;
    const std::string flags = "c++ -std=c++17 -Wall -Wextra -Wpedantic -Werror ";
    return std::system((flags + path("use.cpp") + " -o " + path("use")).c_str()) == 0;
  }
  // Its exit status; what it says to stderr comes into `said`.
  int run(std::string& said) const {
    const int status = std::system(("( " + path("use") + " ) 2> " + path("said")).c_str());
    std::ifstream in(folder_ / "said");
    said.assign(std::istreambuf_iterator<char>(in), {});
    return status;
  }
  std::string path(const char* name) const { return (folder_ / name).string(); }

  const fs::path folder_ = fs::temp_directory_path() / ("clusterbench_size_" + std::to_string(getpid()));
};

// Of each kind of grid one case, as the runner tells it.
run::Result with_each_kind_of_grid() {
  run::Result result = result_by_hand();
  result.cases.clear();
  result.planned_ids.clear();
  const auto add = [&](const std::string& name, const char* grid) {
    run::CaseResult case_result = testing::case_by_hand(name, "aabb", 1.0);
    case_result.name = "hall/walk/" + name + "/aabb/packed";
    case_result.grid = nlohmann::json::parse(grid);
    result.cases.push_back(case_result);
    result.planned_ids.push_back(case_result.id);
  };
  add("tiles", R"({"kind": "frustum", "name": "tiles", "cells": [30, 17, 16], "tiles": {"pixels": [64, 64]},
    "slices": {"scheme": "exponential-first", "boundaries": [0.1, 5, 400],
    "lookup": {"form": "log2", "scale": 2.3726937770843506, "bias": -4.5092244148254395, "first": 5.0}}})");
  add("counted", R"({"kind": "distance", "name": "counted", "cells": [16, 9, 2], "tiles": {"count": [16, 9]},
    "slices": {"scheme": "list", "boundaries": [1, 2, 3], "lookup": {"form": "search"}}})");
  add("cubes", R"({"kind": "cascades", "name": "cubes", "cells": [16, 16, 80], "levels": 5, "finest": 0.5})");
  add("boxes", R"({"kind": "world", "name": "boxes", "cells": [64, 16, 64], "origin": [0.1, 3.0, -155.0],
    "bounds": {"min": [-34.5, -34, -182], "max": [34.5, 33.5, 182]}, "cell_size": [1, 4, 5]})");
  return result;
}

TEST_F(SizeHeader, has_the_constants_of_the_lookup_of_each_kind_of_grid) {
  const run::Result result = with_each_kind_of_grid();
  const std::string cpp = best_of(result);
  for (const char* line :
       {"namespace hall_tiles_lookup {\ninline constexpr int cells[] = {30, 17, 16};\n",
        "inline constexpr float viewport[] = {1920.0f, 1080.0f};\n"
        "inline constexpr float tile_scale[] = {0.015625f, 0.015625f};\ninline constexpr float slice_scale = "
        "2.37269378f;\n"
        "inline constexpr float slice_bias = -4.50922441f;\ninline constexpr float slice_first = 5.0f;\n"
        "inline constexpr float slice_far = 400.0f;\n}\n",
        "tile_scale[] = {0.00833333333f, 0.00833333333f};\ninline constexpr float slice_boundaries[] = {1.0f, 2.0f, "
        "3.0f};\ninline constexpr float slice_far = 3.0f;\n",
        "slice = the last one whose boundary", "slice = log2(depth) * slice_scale + slice_bias", "int levels = 5;",
        "float finest = 0.5f;", "double origin[] = {0.1, 3.0, -155.0};",
        "float box_min[] = {-34.5f, -34.0f, -182.0f};"})
    EXPECT_NE(cpp.find(line), std::string::npos) << line << " in\n" << cpp;
  EXPECT_TRUE(compiles(cpp, "static_assert(light_lists::hall_tiles_lookup::slice_far > 399);\nint main() {}\n"));
  run::Result spherical = result;
  for (run::CaseResult& one : spherical.cases)
    if (one.grid.contains("slices")) one.grid["kind"] = "distance";
  EXPECT_NE(best_of(spherical).find("slice = log2(length(view)) * slice_scale + slice_bias"), std::string::npos)
      << "slices of distance from the eye";
  const std::string hlsl = size_of(result, {"", false, "hlsl"}), glsl = size_of(result, {"", false, "glsl"});
  EXPECT_NE(hlsl.find("static const float2 hall_tiles_lookup_tile_scale = float2(0.015625, 0.015625);"),
            std::string::npos)
      << hlsl;
  EXPECT_NE(glsl.find("\nconst ivec3 hall_cubes_lookup_cells = ivec3(16, 16, 80);"), std::string::npos) << glsl;
  EXPECT_NE(hlsl.find("static const float hall_counted_lookup_slice_boundaries[3] = {1.0, 2.0, 3.0};\n"),
            std::string::npos)
      << hlsl;
  const std::string glsl_array = "float[3](1.0, 2.0, 3.0)";  // C++ has no such constructor
  const std::size_t at = glsl.find("const float hall_counted_lookup_slice_boundaries[3] = " + glsl_array + ";\n");
  ASSERT_NE(at, std::string::npos) << glsl;
  const auto json = nlohmann::json::parse(size_of(result, {"tiles", false, "json"}));
  EXPECT_EQ(json["structures"][0]["lookups"][0]["constants"]["slice_far"], 400);
  const auto searched = nlohmann::json::parse(size_of(result, {"counted", false, "json"}));
  EXPECT_EQ(searched["structures"][0]["lookups"][0]["constants"]["slice_boundaries"], nlohmann::json({1, 2, 3}));
}

constexpr const char* k_indices = "light_lists::hall_frustum_64px_aabb_packed_indices";

std::string program_that_needs(const std::string& elements) {
  return std::string("int main() {\n  std::uint64_t largest = 0;\n  for (std::uint64_t needed : {") + elements +
         "})\n    light_lists::check(" + k_indices + ", needed, largest);\n  return largest == 75 ? 0 : 3;\n}\n";
}

// 80 elements, warning above 72.
std::string header_of_80() {
  return size_of(result_by_hand(), {"", true, "cpp", "none"});
}

TEST_F(SizeHeader, warns_once_for_a_new_largest_number_above_the_warning_level) {
  ASSERT_TRUE(compiles(header_of_80(), program_that_needs("10ull, 72ull, 73ull, 75ull, 75ull, 73ull, 20ull")));
  std::string said;
  EXPECT_EQ(run(said), 0);
  const std::string name = std::string(k_indices).substr(std::string("light_lists::").size());
  EXPECT_EQ(said, name + ": 73 of 80 elements in use; raise the allocation\n" + name +
                      ": 75 of 80 elements in use; raise the allocation\n");
}

TEST_F(SizeHeader, stops_a_program_that_needs_more_than_it_has) {
  ASSERT_TRUE(compiles(header_of_80(), program_that_needs("75ull, 80ull, 81ull")));
  std::string said;
  EXPECT_NE(run(said), 0);
  EXPECT_NE(said.find("light lists overflow their allocation"), std::string::npos) << said;
}

// Cases whose names hold what ends a line, becomes one name, is reserved, or is long.
run::Result with_bad_names() {
  run::Result result = result_by_hand();
  std::vector<std::string> names{"9 lives\n#error a name broke out\\",
                                 "hall/walk/frustum 64px/aabb/packed",
                                 "hall/walk/frustum_64px/aabb/packed",
                                 "\xC3\xA9t\xC3\xA9/__x__//y\\",
                                 "hall/walk/a?\?/",
                                 "hall/walk/gl_x",
                                 "",
                                 "/",
                                 "a",
                                 "a_indices",
                                 "a_2",
                                 "b lookup",
                                 std::string(300, 'l') + "1",
                                 std::string(300, 'l') + "2"};
  result.cases.clear();
  result.planned_ids.clear();
  for (const std::string& name : names) {
    run::CaseResult one = testing::case_by_hand("id" + std::to_string(result.cases.size()), "aabb", 1.0);
    one.name = name;
    one.buffers.each[1].name = name == "a" ? "indices_capacity" : "capacity";
    result.planned_ids.push_back(one.id);
    result.cases.push_back(one);
  }
  return result;
}

TEST_F(SizeHeader, compiles_whatever_cases_are_called) {
  for (const bool all : {true, false}) {
    const std::string header = size_of(with_bad_names(), {"", all, "cpp"});
    EXPECT_TRUE(compiles(header, "int main() {}\n")) << header;
  }
  for (const char* format : {"hlsl", "glsl"}) {
    const std::string report = size_of(with_bad_names(), {"", true, format});
    std::set<std::string> names;
    for (std::size_t at = report.find("const uint "); at != std::string::npos;
         at = report.find("const uint ", at + 1)) {
      const std::string line = report.substr(at, report.find(" =", at) - at);
      EXPECT_EQ(line.find("__"), std::string::npos) << "reserved in GLSL: " << line;
      EXPECT_TRUE(names.insert(line).second) << line;
    }
  }
}

TEST_F(SizeHeader, of_a_shader_has_the_same_constants) {
  const std::string hlsl = size_of(result_by_hand(), {"/aabb/", false, "hlsl", "none"});
  EXPECT_NE(hlsl.find("static const uint hall_frustum_64px_indices_capacity = 80u;\n"), std::string::npos) << hlsl;
  const std::string glsl = size_of(result_by_hand(), {"/aabb/", false, "glsl", "none"});
  EXPECT_NE(glsl.find("\nconst uint hall_frustum_64px_indices_warn_above = 72u;\n"), std::string::npos) << glsl;
  run::Result huge = result_by_hand();
  for (run::CaseResult& case_result : huge.cases) case_result.buffers.each[1].element_bytes = 1u << 28;
  EXPECT_EQ(size_of(huge, {"", false, "glsl"}).find("headers_bytes ="), std::string::npos) << "32 bits do not hold it";
  EXPECT_NE(size_of(huge, {"", false, "cpp"}).find(", 6442450944u, "), std::string::npos);
}

// The slow one makes short lists, which is cheaper in all; another grid has both methods, too.
run::Result result_that_takes_the_slow_one() {
  run::Result result = result_by_hand();
  result.config["cost"] = {{"ns_per_light", 0.02},      {"ns_per_read", 0.005},   {"read_gb_per_s", 2283},
                           {"upload_gb_per_s", 15.75},  {"memory_gb_per_s", 448}, {"wave", "8x8"},
                           {"weights", {{"opaque", 1}}}};
  result.cases[0].shading->evaluated = 220;
  for (const run::CaseResult& one : std::vector<run::CaseResult>(result.cases)) {
    run::CaseResult coarse = one;
    coarse.id += " coarse";
    coarse.name = "hall/walk/frustum 32px/" + one.assigner + "/packed";
    coarse.grid["name"] = "frustum 32px";
    coarse.shading->evaluated = 900;
    result.cases.insert(result.cases.begin(), coarse);
    result.planned_ids.push_back(coarse.id);
  }
  return result;
}

TEST(Size, of_a_result_what_its_conclusion_takes_comes_first_and_other_methods_are_told) {
  const run::Result result = result_that_takes_the_slow_one();
  ASSERT_EQ(record_of(result, {}).conclusions->front().take.value(), "slow");
  const nlohmann::json sized = nlohmann::json::parse(size_of(result, {"", false, "json"}))["structures"];
  ASSERT_EQ(sized.size(), 2u);
  EXPECT_EQ(sized[0]["name"], "hall/frustum 64px/brute-force/packed");
  EXPECT_EQ(sized[0]["choice"], "taken by the conclusion of the result");
  EXPECT_EQ(sized[1]["name"], "hall/frustum 32px/aabb/packed");
  EXPECT_NE(sized[1]["choice"].get<std::string>().find(
                "takes another method, frustum 64px/brute-force/packed; this is of its grid the fastest"),
            std::string::npos)
      << sized[1];
  EXPECT_NE(sized[1]["choice"].get<std::string>().find("--filter 'frustum 32px/brute-force/packed'"), std::string::npos)
      << sized[1];
  for (const char* format : {"table", "cpp", "hlsl"})
    EXPECT_NE(size_of(result, {"", false, format}).find("taken by the conclusion of the result"), std::string::npos)
        << format;
}

}  // namespace
}  // namespace clusterbench::report
