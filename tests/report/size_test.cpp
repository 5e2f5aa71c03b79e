#include "report/size.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "report/result_by_hand.h"
#include "report/result_json.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;
using testing::result_by_hand;

std::string size_of(const run::Result& result, const SizeRequest& request = {"", true}) {
  return size_report(result_to_json(result, {}), request);
}

TEST(Size, of_each_grid_the_fastest_case_that_loses_nothing_is_shown_under_the_name_of_the_grid) {
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
  const std::string report = size_of(result, {});
  EXPECT_NE(report.find("// hall/walk/frustum 64px/aabb/packed\n"), std::string::npos) << report;
  EXPECT_EQ(report.find("brute-force"), std::string::npos) << report;
  EXPECT_NE(report.find("LightListBudget hall_walk_frustum_64px{"), std::string::npos) << report;
  EXPECT_NE(report.find("LightListBudget hall_walk_frustum_32px{"), std::string::npos) << report;
  EXPECT_EQ(report.find("broken"), std::string::npos) << report;
  EXPECT_EQ(report.find("drops"), std::string::npos) << report;
  EXPECT_EQ(report.find("hierarchy"), std::string::npos) << report;
  EXPECT_EQ(report.find("short-sighted"), std::string::npos) << report;
  EXPECT_NE(report.find("--all has all 7"), std::string::npos) << report;
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
  EXPECT_NE(size_of(result, {}).find("// hall/walk/frustum 64px/keeps/packed\n"), std::string::npos)
      << size_of(result, {});
}

// Of two cases whose rounds differ by less than they vary the median of either can be the shorter one.
TEST(Size, of_cases_that_may_be_equally_fast_the_smaller_one_is_shown_whichever_was_faster) {
  const std::vector<double> rounds{1000, 1030, 990, 1020, 1012, 1000}, others{1010, 1000, 1020, 1000, 1000, 1010};
  for (const bool is_small_first : {true, false}) {
    run::Result result = result_by_hand();
    run::CaseResult &small = result.cases[0], &large = result.cases[1];
    small.timing->frame_ns = measure::time_stats(is_small_first ? rounds : others, 1, 1);
    large.timing->frame_ns = measure::time_stats(is_small_first ? others : rounds, 1, 1);
    large.buffers.bytes.recommended = small.buffers.bytes.recommended + 8;
    EXPECT_NE(size_of(result, {}).find("// hall/walk/frustum 64px/brute-force/packed\n"), std::string::npos)
        << size_of(result, {});
    for (double& ns : small.timing->frame_ns.samples) ns *= 1.5;
    small.timing->frame_ns = measure::time_stats(small.timing->frame_ns.samples, 1, 1);
    EXPECT_NE(size_of(result, {}).find("// hall/walk/frustum 64px/aabb/packed\n"), std::string::npos)
        << "the other one is known to be faster: " << size_of(result, {});
  }
}

TEST(Size, a_filter_selects_cases_by_name) {
  const std::string report = size_of(result_by_hand(), {"/aabb/", true});
  EXPECT_NE(report.find("// hall/walk/frustum 64px/aabb/packed"), std::string::npos) << report;
  EXPECT_EQ(report.find("--all"), std::string::npos) << "nothing is left out";
  EXPECT_THROW(size_of(result_by_hand(), {"no such", true}), Error);
  EXPECT_THROW(size_of(result_by_hand(), {"(", true}), Error);
}

TEST(Size, says_what_was_seen_where_and_what_to_allocate) {
  const std::string report = size_of(result_by_hand());
  for (const char* part : {"// hall/walk/frustum 64px/aabb/packed", "40 entries in frame 1", "cell [3,2,1]",
                           "8.33 % of the theoretical 480", "80 entries of 8 bits", "272 bytes",
                           "72 entries (0.9 of the capacity)", "{80u, 72u, 272u}"})
    EXPECT_NE(report.find(part), std::string::npos) << part << " in\n" << report;
}

TEST(Size, json_has_every_number_of_a_budget) {
  const nlohmann::json report = nlohmann::json::parse(size_of(result_by_hand(), {"/aabb/", false, "json"}));
  ASSERT_EQ(report["budgets"].size(), 1u);
  const nlohmann::json expected = nlohmann::json::parse(R"({"name": "hall_walk_frustum_64px", "id": "fast",
    "case": "hall/walk/frustum 64px/aabb/packed", "capacity_entries": 80, "warn_entries": 72, "bytes": 272, "index_bits": 8,
    "high_water_entries": 40, "theoretical_max_entries": 480, "worst_frame": 1, "worst_cell": [3, 2, 1], "dropped_pairs": 0,
    "lookup": {"cells": [4, 3, 2]}})");
  EXPECT_EQ(report["budgets"][0], expected);
  EXPECT_EQ(report["warn_at"], 0.9);
}

TEST(Size, says_where_lists_overflowed) {
  run::Result result = result_by_hand();
  result.cases[0].buffers.dropped_pairs = 7;
  result.cases[0].buffers.overflowing_cells = 3;
  result.cases[0].buffers.overflowing_frames = 1;
  EXPECT_NE(size_of(result).find("7 pairs dropped in 3 cells of 1 frame"), std::string::npos);
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

// What shaders' languages have and C++ has not.
const std::string k_shader_types =
    "using uint = unsigned;\ntemplate <class T> struct V { T at[3]; constexpr V(T x, T y, T z = 0) : at{x, y, z} {} "
    "};\n"
    "using int3 = V<int>; using ivec3 = int3; using float2 = V<double>; using vec2 = float2;\n"
    "using float3 = float2; using vec3 = float2;\n";

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
  const std::string cpp = size_of(result, {});
  for (const char* line :
       {"namespace hall_walk_tiles_lookup {\ninline constexpr int cells[] = {30, 17, 16};\n",
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
  EXPECT_TRUE(compiles(cpp, "static_assert(light_lists::hall_walk_tiles_lookup::slice_far > 399);\nint main() {}\n"));
  run::Result spherical = result;
  for (run::CaseResult& one : spherical.cases)
    if (one.grid.contains("slices")) one.grid["kind"] = "distance";
  EXPECT_NE(size_of(spherical, {}).find("slice = log2(length(view)) * slice_scale + slice_bias"), std::string::npos)
      << "slices of distance from the eye";
  const std::string hlsl = size_of(result, {"", false, "hlsl"}), glsl = size_of(result, {"", false, "glsl"});
  EXPECT_NE(hlsl.find("static const float2 hall_walk_tiles_lookup_tile_scale = float2(0.015625, 0.015625);"),
            std::string::npos)
      << hlsl;
  EXPECT_NE(glsl.find("\nconst ivec3 hall_walk_cubes_lookup_cells = ivec3(16, 16, 80);"), std::string::npos) << glsl;
  EXPECT_NE(hlsl.find("static const float hall_walk_counted_lookup_slice_boundaries[3] = {1.0, 2.0, 3.0};\n"),
            std::string::npos)
      << hlsl;
  const std::string glsl_array = "float[3](1.0, 2.0, 3.0)";  // C++ has no such constructor
  const std::size_t at = glsl.find("const float hall_walk_counted_lookup_slice_boundaries[3] = " + glsl_array + ";\n");
  ASSERT_NE(at, std::string::npos) << glsl;
  const std::string glsl_as_cpp =
      std::string(glsl).replace(glsl.find(glsl_array, at), glsl_array.size(), "{1.0, 2.0, 3.0}");
  for (const std::string& shader : {hlsl, glsl_as_cpp})
    EXPECT_TRUE(compiles(k_shader_types + shader, "int main() {}\n"));
  const auto json = nlohmann::json::parse(size_of(result, {"tiles", false, "json"}));
  EXPECT_EQ(json["budgets"][0]["lookup"]["slice_far"], 400);
  const auto searched = nlohmann::json::parse(size_of(result, {"counted", false, "json"}));
  EXPECT_EQ(searched["budgets"][0]["lookup"]["slice_boundaries"], nlohmann::json({1, 2, 3}));
}

constexpr const char* k_budget = "light_lists::hall_walk_frustum_64px_aabb_packed";

std::string program_that_needs(const std::string& entries) {
  return std::string("int main() {\n  std::uint64_t worst = 0;\n  for (std::uint64_t needed : {") + entries +
         "})\n    light_lists::check(" + k_budget + ", needed, worst);\n  return worst == 75 ? 0 : 3;\n}\n";
}

TEST_F(SizeHeader, warns_once_for_a_new_worst_above_the_warning_level) {
  ASSERT_TRUE(compiles(size_of(result_by_hand()), program_that_needs("10ull, 75ull, 75ull, 20ull")));
  std::string said;
  EXPECT_EQ(run(said), 0);
  EXPECT_EQ(said, "light lists: 75 of 80 entries in use; raise the allocation\n");
}

TEST_F(SizeHeader, stops_a_program_that_needs_more_than_it_has) {
  ASSERT_TRUE(compiles(size_of(result_by_hand()), program_that_needs("75ull, 81ull")));
  std::string said;
  EXPECT_NE(run(said), 0);
  EXPECT_NE(said.find("light lists overflow their allocation"), std::string::npos) << said;
}

TEST_F(SizeHeader, compiles_whatever_cases_are_called) {
  run::Result result = result_by_hand();
  result.cases[0].name = "9 lives\n#error a name broke out\\";
  result.cases.push_back(testing::case_by_hand("third", "aabb", 1.0));  // the same name twice
  result.cases.push_back(testing::case_by_hand("fourth", "aabb", 1.0));
  result.cases.back().name = "\xC3\xA9t\xC3\xA9/__x__//y\\";
  result.planned_ids = {"slow", "fast", "third", "fourth"};
  EXPECT_TRUE(compiles(size_of(result), "int main() {}\n"));
  // A C++ compiler reads the declarations of shaders, too; what GLSL reserves are names with two underscores.
  for (const char* format : {"hlsl", "glsl"}) {
    const std::string report = size_of(result, {"", true, format});
    EXPECT_TRUE(compiles(k_shader_types + report, "int main() {}\n")) << report;
    for (std::size_t at = report.find("const uint "); at != std::string::npos; at = report.find("const uint ", at + 1))
      EXPECT_EQ(report.substr(at, report.find(" =", at) - at).find("__"), std::string::npos) << report;
  }
}

TEST_F(SizeHeader, of_a_shader_has_the_same_constants) {
  const std::string hlsl = size_of(result_by_hand(), {"/aabb/", false, "hlsl"});
  EXPECT_NE(hlsl.find("static const uint hall_walk_frustum_64px_capacity_entries = 80u;\n"), std::string::npos) << hlsl;
  const std::string glsl = size_of(result_by_hand(), {"/aabb/", false, "glsl"});
  EXPECT_NE(glsl.find("\nconst uint hall_walk_frustum_64px_bytes = 272u;\n"), std::string::npos) << glsl;
  run::Result huge = result_by_hand();
  for (run::CaseResult& case_result : huge.cases) case_result.buffers.bytes.recommended = std::uint64_t{1} << 32;
  EXPECT_EQ(size_of(huge, {"", false, "glsl"}).find("_bytes ="), std::string::npos) << "32 bits do not hold it";
  EXPECT_NE(size_of(huge, {"", false, "cpp"}).find(", 4294967296u}"), std::string::npos);
}

}  // namespace
}  // namespace clusterbench::report
