#include "report/comparing/comparability.h"

#include <gtest/gtest.h>

#include "records.h"
#include "report/comparison_by_hand.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::compared;
using testing::holds;
using testing::json_of;
using testing::outcome;
using testing::result_by_hand;
using testing::with_times;

Obstacles obstacles_between(const Json& base, const Json& next) {
  return obstacles(test::result_of(base), test::result_of(next));
}

TEST(Compare, fields_that_differ_are_named) {
  const Json base = json_of(result_by_hand());
  EXPECT_TRUE(obstacles_between(base, base).to_times.empty());
  Json next = base;
  next["machine"]["cpu"] = "another";
  next["machine"]["os"] = "another kernel";
  next["tool"]["flags"] = "-O0";
  next["tool"]["git_sha"] = "def";  // what is compared, no obstacle
  const Obstacles fields = obstacles_between(base, next);
  EXPECT_EQ(fields.to_instructions, (std::vector<std::string>{R"(/machine/cpu is "a processor" and "another")",
                                                              R"(/tool/flags is "-O3" and "-O0")"}));
  EXPECT_EQ(fields.to_times.size(), 3u);
  EXPECT_TRUE(holds(compared(base, next, 0.02, {.is_forced = true})["warnings"], "all the same: /machine/cpu"));
}

TEST(Compare, processors_of_one_name_are_told_apart_and_what_an_older_result_does_not_know_is_passed_over) {
  const Json base = json_of(result_by_hand());
  for (const char* key : {"family", "model", "stepping"}) {
    Json next = base;
    next["machine"][key] = "99";
    EXPECT_EQ(obstacles_between(base, next).to_instructions.size(), 1u) << key;
    next["machine"].erase(key);
    EXPECT_TRUE(obstacles_between(base, next).to_times.empty()) << key;
  }
  Json next = base;
  next["machine"]["caches"]["l2"] = 5;
  EXPECT_EQ(obstacles_between(base, next).to_instructions.size(), 1u);
}

TEST(Compare, of_another_machine_counts_are_compared_and_times_and_instructions_are_not) {
  run::Result base = result_by_hand(), next = with_times(1, 1);
  testing::add_count(base.cases[0]);
  testing::add_count(next.cases[0]);
  next.cases[0].count->assign.instructions *= 2;
  next.machine.cpu = "another";
  Json result = json_of(next);
  const Json comparison = compared(json_of(base), result, 0.02);
  EXPECT_FALSE(comparison["cases"][0].contains("hint"));
  EXPECT_FALSE(comparison["cases"][0].contains("instructions"));
  EXPECT_TRUE(holds(comparison["warnings"], "times are not compared"));
  EXPECT_TRUE(holds(comparison["warnings"], "instructions are not compared"));
  EXPECT_EQ(outcome(comparison, false), ExitCode::ok);
  EXPECT_EQ(outcome(comparison, true), ExitCode::inconclusive) << "a gate that could not be";
  EXPECT_EQ(outcome(compared(json_of(base), result, 0.02, {.is_forced = true}), false), ExitCode::gate_failed);
  result["cases"][1]["error"]["reported_pairs"] = 61;
  EXPECT_EQ(outcome(compared(json_of(base), result, 0.02), false), ExitCode::gate_failed);
}

TEST(Compare, another_kernel_or_memory_parts_times_and_nothing_else) {
  run::Result base = result_by_hand();
  testing::add_count(base.cases[0]);
  run::Result next = base;
  next.machine.os = "Linux, the next one";
  next.machine.ram_bytes = 5;
  const Json comparison = compared(json_of(base), json_of(next), 0.02);
  EXPECT_TRUE(comparison["left_out"].contains("times"));
  EXPECT_FALSE(comparison["left_out"].contains("instructions"));
  EXPECT_EQ(comparison["cases"][0]["instructions"]["verdict"], "same");
  EXPECT_EQ(outcome(comparison, true), ExitCode::ok);
}

TEST(Compare, cold_times_are_not_compared_with_warm_ones) {
  const run::Result base = result_by_hand();
  run::Result next = base;
  for (run::CaseResult& case_result : next.cases) case_result.timing->is_cold = true;
  const Json comparison = compared(json_of(base), json_of(next), 0.02);
  ASSERT_TRUE(comparison["left_out"].contains("times"));
  EXPECT_TRUE(holds(comparison["left_out"]["times"], "/cases/*/timing/caches"));
  Json swept = json_of(next), warm = json_of(base);
  for (Json* json : {&swept, &warm}) (*json)["config"]["timing"]["sweep_mib"] = 64;
  const Json sizes = compared(json_of(next), swept, 0.02)["left_out"];
  ASSERT_TRUE(sizes.contains("times"));
  EXPECT_TRUE(holds(sizes["times"], "/config/timing/sweep_mib is null and 64")) << sizes;
  EXPECT_FALSE(compared(json_of(base), warm, 0.02)["left_out"].contains("times")) << "nothing was swept";
  EXPECT_FALSE(compared(json_of(next), json_of(next), 0.02)["left_out"].contains("times"));
}

// Whose settings are those of its parts.
TEST(Compare, merged_results_are_compared_by_the_settings_of_their_parts) {
  run::Result cold = result_by_hand();
  for (run::CaseResult& case_result : cold.cases) case_result.timing->is_cold = true;
  const auto merged = [&](const Json& sizes) {
    Json json = json_of(cold);
    Json parts = Json::array();
    for (const Json& mib : sizes) {
      Json part = json["config"];
      part["timing"]["sweep_mib"] = mib;
      parts.push_back(part);
    }
    json["config"]["merged"] = parts;
    json["config"].erase("timing");
    return json;
  };
  const auto left_out = [&](const Json& base, const Json& next) { return compared(base, next, 0.02)["left_out"]; };
  EXPECT_TRUE(holds(left_out(merged({64, 64}), merged({128, 128}))["times"], "/config/timing/sweep_mib is 64 and 128"));
  EXPECT_FALSE(left_out(merged({64, 64}), merged({64, 64})).contains("times"));
  EXPECT_FALSE(left_out(merged({64, 128}), merged({128, 64})).contains("times")) << "the order is none";
  Json again = merged({64});
  again["config"] = {{"merged", {merged({64, 128})["config"], again["config"]["merged"][0]}}};
  EXPECT_FALSE(left_out(merged({64, 128}), again).contains("times")) << "nor is how often they were merged";
}

}  // namespace
}  // namespace clusterbench::report
