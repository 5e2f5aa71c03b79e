// Comparisons with another program that was measured side by side.

#include <gtest/gtest.h>

#include "report/comparison_by_hand.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::compared;
using testing::comparison_markdown;
using testing::comparison_text;
using testing::holds;
using testing::json_of;
using testing::measured_beside;
using testing::outcome;
using testing::paired;
using testing::result_by_hand;
using testing::verdict_of;
using testing::with_times;

TEST(Compare, paired_rounds_decide_where_there_are_any) {
  const Json base = json_of(with_times(1, 1)), next = measured_beside(base, 3.0);
  for (const Json& left : {base, next}) {
    const Json comparison = compared(left, next, 0.02);
    EXPECT_EQ(comparison["data"], "paired");
    EXPECT_EQ(comparison["base"]["tool"]["git_sha"], "abc");
    EXPECT_EQ(verdict_of(comparison, 0), "slower");
    EXPECT_NEAR(comparison["cases"][0]["ratio"].get<double>(), 1.03, 1e-4);
    EXPECT_FALSE(holds(comparison["warnings"], "separate runs"));
  }
  EXPECT_EQ(verdict_of(compared(base, measured_beside(base, 0.0), 0.02), 1), "same");
}

// What disturbs a launch as a whole, here by 20 % up and down, cancels in its mean.
TEST(Compare, the_mean_of_methods_is_over_the_launches_that_all_have) {
  const Json base = json_of(with_times(1, 1));
  Json next = measured_beside(base, 3.0);
  double up = 1.2;
  for (Json& launch : next["cases"][0]["timing"]["baseline"]["launches"]) {
    for (Json& ns : launch["new_ns"]) ns = ns.get<double>() * up;
    up = 1.0 / up;
  }
  up = 1.0 / 1.2;
  Json& others = next["cases"][1]["timing"]["baseline"]["launches"];
  for (Json& launch : others) {
    for (Json& ns : launch["new_ns"]) ns = ns.get<double>() * up;
    up = 1.0 / up;
  }
  others.push_back({{"base_ns", {1.0, 1.0}}, {"new_ns", {5.0, 5.0}}});
  const Json summary = compared(base, next, 0.02)["summary"];
  EXPECT_NEAR(summary["ratio"].get<double>(), 1.03, 1e-4);
  EXPECT_LT(summary["ci95"][1].get<double>(), 1.04);
}

TEST(Compare, paired_rounds_with_another_program_say_nothing) {
  Json base = json_of(with_times(9000, 3000));
  const Json next = measured_beside(base, 3.0);
  base["tool"]["git_sha"] = "yet another";
  EXPECT_EQ(compared(base, next, 0.02)["data"], "separate");
}

TEST(Compare, lists_that_differ_side_by_side_fail_unless_they_are_shorter_and_complete) {
  const Json base = json_of(result_by_hand());
  Json next = measured_beside(base, 0.0);
  Json& lists = next["cases"][0]["timing"]["baseline"]["lists_differ"];
  lists = {{"frames", 2}, {"frame", 1},       {"cell", {3, 2, 1}}, {"light", 7},
           {"in", "new"}, {"base_pairs", 60}, {"new_pairs", 61}};
  EXPECT_EQ(outcome(compared(base, next, 0.02), false), ExitCode::gate_failed);
  const std::string text = comparison_text(compared(base, next, 0.02));
  EXPECT_NE(text.find("frame 1, cell [3,2,1], light 7: only in the new lists; 60 -> 61 pairs"), std::string::npos)
      << text;
  lists["new_pairs"] = 59;
  EXPECT_EQ(outcome(compared(base, next, 0.02), false), ExitCode::ok);
  lists["new_pairs"] = 61;
  Json third = base;
  third["tool"]["git_sha"] = "yet another";
  const Json beside_third = compared(third, next, 0.02);
  EXPECT_EQ(outcome(beside_third, false), ExitCode::ok) << "they are not the lists of this base";
  EXPECT_FALSE(beside_third["cases"][0].contains("lists"));
}

TEST(Compare, beside_another_program_only_what_both_did_is_compared) {
  const Json base = json_of(result_by_hand());
  Json next = measured_beside(base, 0.0);
  next["cases"][1]["timing"].erase("baseline");
  const Json comparison = compared(next, next, 0.02);
  EXPECT_EQ(comparison["cases"].size(), 1u);
  EXPECT_TRUE(holds(comparison["only_in_new"], "/aabb/"));
  EXPECT_TRUE(holds(comparison["warnings"], "the other program does not have them, not compared: hall/walk"));
  EXPECT_TRUE(holds(comparison["warnings"], "bytes, samples and whatever else is counted were not"));
  EXPECT_NE(comparison_text(comparison).find("1 case of the new not compared"), std::string::npos);
  next["cases"][1]["assigner"]["on_device"] = true;
  const Json on_device = compared(next, next, 0.02);
  EXPECT_TRUE(
      holds(on_device["warnings"], "methods on a device are not measured side by side, not compared: hall/walk"));
  EXPECT_FALSE(holds(on_device["warnings"], "the other program does not have them"));
  EXPECT_FALSE(holds(compared(base, next, 0.02)["warnings"], "the other program")) << "its own result is at hand";
}

TEST(Compare, a_program_beside_itself_has_no_difference_and_says_how_small_a_one_shows) {
  const Json base = json_of(result_by_hand());
  Json next = measured_beside(base, 3.0);  // which would be slower
  EXPECT_EQ(outcome(compared(next, next, 0.02), false), ExitCode::gate_failed);
  next["baseline"]["is_same_program"] = true;
  const Json comparison = compared(next, next, 0.02);
  EXPECT_EQ(verdict_of(comparison, 0), "same");
  EXPECT_EQ(outcome(comparison, true), ExitCode::ok);
  const std::string text = comparison_text(comparison);
  EXPECT_NE(
      text.find("\nno difference: both are the same program, byte for byte, and beside itself its times differ by "
                "at most 3.3 % (95 % intervals)"),
      std::string::npos)
      << text;
}

TEST(Compare, what_is_inconclusive_says_what_to_do) {
  const Json base = json_of(result_by_hand());
  Json next = measured_beside(base, 1.0);
  double noise = 0.9;
  for (Json& launch : next["cases"][0]["timing"]["baseline"]["launches"]) {
    for (Json& ns : launch["new_ns"]) ns = ns.get<double>() * noise;
    noise += 0.1;
  }
  const Json comparison = compared(next, next, 0.02);
  ASSERT_EQ(verdict_of(comparison, 0), "inconclusive");
  EXPECT_EQ(comparison["advice"].size(), 1u);
  const std::string text = comparison_text(comparison);
  for (const char* part :
       {"1 case is inconclusive: its interval reaches ", "and the threshold is 2 %", "--threshold ", "run --count"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_NE(comparison_markdown(comparison).find("**What to do**"), std::string::npos);
  EXPECT_FALSE(compared(base, base, 0.02).contains("advice"));
}

}  // namespace
}  // namespace clusterbench::report
