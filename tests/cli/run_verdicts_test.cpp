// The conclusion, the checks and the exit code of a finished run.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/small_config.h"
#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

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

}  // namespace
}  // namespace clusterbench::test
