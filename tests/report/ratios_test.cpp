#include "report/ratios.h"

#include <gtest/gtest.h>

#include "report/result_by_hand.h"
#include "report/result_json.h"
#include "report/table.h"
#include "report/timing_warnings.h"

namespace clusterbench::report::testing {
namespace {

using Json = nlohmann::ordered_json;

// Cases whose frames take these times in three launches of two rounds.
Json timed_result(const std::vector<std::vector<double>>& samples) {
  run::Result result;
  result.config = {{"seed", 1}};
  run::SceneResult scene;
  scene.name = "hall";
  scene.range_rule = {{"cutoff_lux", 0.05}, {"max_range", 100}, {"given", 1}, {"from_intensity", 0}, {"clamped", 0}};
  result.scenes.push_back(scene);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::string name = std::string("method-") + static_cast<char>('a' + i);
    run::CaseResult one = case_by_hand(name, name, 1000.0);
    one.timing->is_cold = true;
    one.timing->launches = 3;
    one.timing->frame_ns = measure::time_stats(samples[i], 1, 3);
    result.cases.push_back(one);
    result.planned_ids.push_back(one.id);
  }
  return result_to_json(result, {});
}

// a and b rise and fall together, b a little above; c is as b, but for noise.
Json three_methods() {
  return timed_result({{1000, 1010, 2000, 2020, 1500, 1510},
                       {1100, 1110, 2200, 2220, 1650, 1660},
                       {1110, 1100, 2230, 2215, 1640, 1670}});
}

TEST(Ratios, any_two_methods_of_a_grid_have_one) {
  const Json result = three_methods();
  const Json& cases = result["cases"];
  const auto there = ratio_of_cases(result, cases[1], cases[0]), back = ratio_of_cases(result, cases[0], cases[1]);
  ASSERT_TRUE(there && back);
  EXPECT_NEAR(there->ratio, 1.1, 0.005);
  EXPECT_NEAR(there->ratio * back->ratio, 1.0, 1e-3);
  EXPECT_GT(there->ci95.low, 1.09) << "times differ twofold between launches, their ratio does not";
  EXPECT_TRUE(takes_longer(result, cases[1], cases[0]));
  EXPECT_FALSE(takes_longer(result, cases[0], cases[1]));
  EXPECT_FALSE(takes_longer(result, cases[2], cases[1]));
  EXPECT_TRUE(takes_longer(result, cases[2], cases[0]));
}

TEST(Ratios, are_not_formed_over_grids_caches_or_unequal_rounds) {
  Json result = three_methods();
  Json other = result["cases"][1];
  other["grid"]["name"] = "another";
  EXPECT_FALSE(ratio_of_cases(result, result["cases"][0], other));
  other = result["cases"][1];
  other["timing"]["caches"] = "warm";
  EXPECT_FALSE(ratio_of_cases(result, result["cases"][0], other));
  other = result["cases"][1];
  other["timing"]["frame_ns"]["samples"].erase(0);
  EXPECT_FALSE(ratio_of_cases(result, result["cases"][0], other));
  other = result["cases"][1];
  other["timing"]["frame_ns"]["samples"][0] = 0.0;
  EXPECT_FALSE(ratio_of_cases(result, result["cases"][0], other));
}

TEST(Ratios, stand_in_a_ranking_and_between_all_pairs) {
  const Json result = three_methods();
  const std::string ranking = ratio_table(result, "", false), pairs = ratio_table(result, "", true);
  EXPECT_NE(ranking.find("  ~ method-c / packed"), std::string::npos) << ranking;
  EXPECT_NE(ranking.find("1.10 (1.0"), std::string::npos) << ranking;
  EXPECT_NE(pairs.find("method-c / packed  method-a / packed"), std::string::npos) << pairs;
  EXPECT_EQ(ratio_table(result, "method-[ab]", true).find("method-c"), std::string::npos);
  EXPECT_EQ(ratio_table(result, "no such", false), "");
  const std::string csv = ratio_csv(result, "");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 2) << csv;
}

TEST(Ratios, the_table_of_a_run_marks_rows_that_are_not_told_from_the_one_above) {
  const std::string table = render_table(three_methods(), false);
  EXPECT_NE(table.find("~1.66"), std::string::npos) << table;
  EXPECT_EQ(table.find("~1.65"), std::string::npos) << table;
  EXPECT_NE(table.find("~: may be as fast"), std::string::npos) << table;
  EXPECT_NE(table.find("with cold caches"), std::string::npos) << table;
}

TEST(TimingWarnings, say_what_speaks_against_times_and_what_to_try) {
  Json cases = timed_result({{1000, 1010, 1001, 1004, 1003, 1002}})["cases"];
  EXPECT_EQ(timing_warnings(cases), "");
  const auto with = [&](const char* key, double value) {
    Json changed = cases;
    changed[0]["timing"]["disturbed"][key] = value;
    return timing_warnings(changed);
  };
  EXPECT_NE(with("others_cores", 0.5).find("0.5 processors busy"), std::string::npos);
  EXPECT_EQ(with("others_cores", 0.05), "");
  EXPECT_NE(with("stolen_cores", 0.05).find("other guests"), std::string::npos);
  EXPECT_NE(with("throttled", 3).find("heat 3 times"), std::string::npos);

  const std::string wide = timing_warnings(three_methods()["cases"]);
  EXPECT_NE(wide.find("3 of 3 times have intervals wider than +- 10 %"), std::string::npos) << wide;
  EXPECT_NE(wide.find("--launches 12"), std::string::npos) << wide;

  std::vector<double> alternating;
  for (int i = 0; i < 18; ++i) alternating.push_back(i % 2 == 0 ? 1000.0 + i : 1200.0 + i);
  const std::string two = timing_warnings(timed_result({alternating})["cases"]);
  EXPECT_NE(two.find("1 of 1 time in two groups, as at 1.008 and 1.209 us"), std::string::npos) << two;
}

}  // namespace
}  // namespace clusterbench::report::testing
