#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/tool.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

// A result without times, measured once for all tests.
const Json& counted_result() {
  static const Json result = [] {
    const Folder folder;
    const std::string config = folder
                                   .write("small.json", R"({"scenes": [{"path": ")" + source_file("scenes/street.glb") +
                                                            R"(", "frames": 2}], "viewport": [640, 360],
            "grids": [{"kind": "frustum", "tiles": {"pixels": [64, 64]}, "slices": {"scheme": "linear", "count": 4}}],
            "assigners": ["aabb", "sphere-refinement"]})")
                                   .string();
    return Json::parse(tool("run --quiet --no-timing " + config).out);
  }();
  return result;
}

struct Files {
  Folder folder;
  std::string base = folder.write("base.json", counted_result().dump()).string();

  Outcome compare_with(const Json& next, const std::string& flags = "") const {
    return tool("compare " + base + " " + folder.write("new.json", next.dump()).string() + " " + flags);
  }
};

TEST(CompareCommand, equal_results_pass) {
  const Files files;
  const Outcome done = files.compare_with(counted_result(), "--strict");
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("nothing has changed"), std::string::npos) << done.out;
}

TEST(CompareCommand, one_more_pair_fails_and_is_written_as_markdown_and_json) {
  const Files files;
  Json next = counted_result();
  next["cases"][1]["error"]["reported_pairs"] = next["cases"][1]["error"]["reported_pairs"].get<int>() + 1;
  const std::string markdown = (files.folder / "c.md").string(), json = (files.folder / "c.json").string();
  const Outcome done = files.compare_with(next, "--markdown " + markdown + " --json " + json);
  EXPECT_EQ(done.code, 1);
  EXPECT_NE(done.out.find("error/reported_pairs worse"), std::string::npos) << done.out;
  EXPECT_NE(file_text(markdown).find("### clusterbench: failed"), std::string::npos);
  EXPECT_EQ(Json::parse(file_text(json))["summary"]["counts_worse"], 1);
  const Outcome checked = tool("validate " + json);
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_NE(checked.out.find("valid, a comparison of `clusterbench compare` with 2 cases"), std::string::npos)
      << checked.out;
}

TEST(CompareCommand, without_a_common_case_the_code_is_3) {
  const Files files;
  Json next = counted_result();
  for (Json& entry : next["cases"]) entry["id"] = "other " + entry["id"].get<std::string>();
  const Outcome done = files.compare_with(next);
  EXPECT_EQ(done.code, 3);
  EXPECT_NE(done.err.find("the results have no case in common: the level or a setting has changed"), std::string::npos)
      << done.err;
}

TEST(CompareCommand, of_other_grids_points_to_ratio_across_grids) {
  const Files files;
  Json next = counted_result();
  for (Json& entry : next["cases"]) {
    entry["id"] = "other " + entry["id"].get<std::string>();
    entry["grid"]["name"] = "frustum 32px x 4 linear";
    entry["name"] = "street/walk/frustum 32px x 4 linear";
  }
  const Outcome done = files.compare_with(next);
  EXPECT_EQ(done.code, 3);
  EXPECT_NE(done.err.find("their grids differ. To hold grids against each other, measure them in one run"),
            std::string::npos)
      << done.err;
  EXPECT_NE(done.err.find("--across-grids"), std::string::npos) << done.err;
}

TEST(CompareCommand, a_filter_compares_some_cases) {
  const Files files;
  Json next = counted_result();
  for (Json& entry : next["cases"])
    if (entry["assigner"]["name"] == "aabb")
      entry["error"]["reported_pairs"] = 1 + entry["error"]["reported_pairs"].get<int>();
  EXPECT_EQ(files.compare_with(next).code, 1);
  const Outcome done = files.compare_with(next, "--filter sphere-ref --strict");
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("1 case in common"), std::string::npos) << done.out;
  const Outcome none = files.compare_with(next, "--filter spheres-ref");
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("--filter: 'spheres-ref' matches none of 2 cases; one of them is 'street/"),
            std::string::npos)
      << none.err;
}

TEST(CompareCommand, instructions_of_another_machine_are_left_out_unless_forced) {
  Json result = counted_result();
  for (Json& entry : result["cases"])
    entry["count"] = {{"source", "callgrind"},
                      {"simd_target", "AVX2"},
                      {"frames", 2},
                      {"instructions_per_build", 5},
                      {"instructions_per_frame", {{"assign", 10.0}, {"convert", 3.0}}}};
  const Folder folder;
  const std::string base = folder.write("base.json", result.dump()).string();
  result["machine"]["cpu"] = "another";
  for (Json& entry : result["cases"]) entry["count"]["instructions_per_frame"]["assign"] = 20.0;
  const std::string next = folder.write("new.json", result.dump()).string();
  const Outcome done = tool("compare " + base + " " + next);
  EXPECT_EQ(done.code, 0);
  EXPECT_NE(done.out.find("instructions are not compared: /machine/cpu"), std::string::npos) << done.out;
  EXPECT_EQ(tool("compare --strict " + base + " " + next).code, 4);
  EXPECT_EQ(tool("compare --force " + base + " " + next).code, 1);
}

TEST(CompareCommand, times_of_separate_runs_fail_only_on_request) {
  Json result = Json::parse(file_text(source_file("results/intel-r-xeon-r-processor/quick.json")));
  const Folder folder;
  const std::string base = folder.write("base.json", result.dump()).string();
  for (Json& entry : result["cases"])
    for (const char* key : {"median", "ci95"})
      for (Json& ns : entry["timing"]["frame_ns"][key]) ns = 5.0 * ns.get<double>();
  const std::string next = folder.write("new.json", result.dump()).string();
  EXPECT_EQ(tool("compare --strict " + base + " " + next).code, 0);
  EXPECT_EQ(tool("compare --gate-separate " + base + " " + next).code, 1);
  result["machine"]["cpu"] = "another";
  const std::string elsewhere = folder.write("elsewhere.json", result.dump()).string();
  EXPECT_EQ(tool("compare " + base + " " + elsewhere).code, 0);
  const Outcome refused = tool("compare --gate-separate " + base + " " + elsewhere);
  EXPECT_EQ(refused.code, 3);
  EXPECT_NE(refused.err.find("/machine/cpu"), std::string::npos) << refused.err;
}

TEST(CompareCommand, what_is_no_result_is_a_usage_error) {
  const Files files;
  EXPECT_EQ(tool("compare " + files.base).code, 2);
  EXPECT_EQ(tool("compare " + files.base + " /no/such/file").code, 2);
  EXPECT_EQ(files.compare_with(Json{{"scenes", Json::array()}}).code, 2);
  EXPECT_EQ(files.compare_with(Json{{"schema_version", 1}, {"cases", {{{"id", 7}}}}}).code, 2) << "a broken case";
  EXPECT_EQ(files.compare_with(counted_result(), "--threshold -1").code, 2);
  EXPECT_EQ(files.compare_with(counted_result(), "--markdown /no/such/folder/c.md").code, 2);
}

}  // namespace
}  // namespace clusterbench::test
