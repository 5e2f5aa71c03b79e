#include "report/comparing/ratios.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "report/cases/timing_warnings.h"
#include "report/comparison_by_hand.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"
#include "report/tables/table.h"

namespace clusterbench::report::testing {
namespace {

// Cases whose frames take these times in so many launches of equally many rounds.
result::Result timed_result(const std::vector<std::vector<double>>& samples, int launches = 3) {
  run::Result result;
  result.config = {{"seed", 1}};
  run::SceneResult scene;
  scene.name = "hall";
  scene.range_rule = {{"cutoff_lux", 0.05}, {"max_range", 100}, {"given", 1}, {"from_intensity", 0}, {"clamped", 0}};
  result.scenes.push_back(scene);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::string name = std::string("method-") + static_cast<char>('a' + i);
    run::CaseResult case_result = case_by_hand(name, name, 1000.0);
    case_result.timing->is_cold = true;
    case_result.timing->launches = launches;
    case_result.timing->frame_ns = measure::time_stats(samples[i], 1, launches);
    result.cases.push_back(case_result);
    result.planned_ids.push_back(case_result.id);
  }
  return record_of(result, {});
}

// a and b rise and fall together, b a little above; c is as b, but for noise.
result::Result three_methods() {
  return timed_result({{1000, 1010, 2000, 2020, 1500, 1510},
                       {1100, 1110, 2200, 2220, 1650, 1660},
                       {1110, 1100, 2230, 2215, 1640, 1670}});
}

RatioRequest only(const std::string& methods) {
  RatioRequest request;
  request.methods = methods;
  return request;
}

RatioRequest over_all_grids() {
  RatioRequest request;
  request.across_grids = true;
  return request;
}

TEST(Ratios, any_two_methods_of_a_grid_have_one) {
  const result::Result result = three_methods();
  const std::vector<result::Case>& cases = result.cases;
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

TEST(Ratios, of_several_machines_are_in_a_block_for_each_that_names_it_across_grids_too) {
  result::Result result = three_methods();
  for (std::size_t i = 0; i < 3; ++i) result.cases[i].machine = i < 2 ? "machine 1" : "machine 2";
  for (const RatioRequest& request : {RatioRequest(), over_all_grids()}) {
    const result::Ratios ratios = ratios_of(result, request);
    ASSERT_EQ(ratios.blocks.size(), 2u);
    EXPECT_EQ(ratios.blocks[0].cases.size(), 2u);
    EXPECT_TRUE(ratios.blocks[0].name.ends_with(", machine 1")) << ratios.blocks[0].name;
    EXPECT_TRUE(ratios.blocks[1].name.ends_with(", machine 2")) << ratios.blocks[1].name;
    EXPECT_NE(ratio_csv(ratios).find("machine 1"), std::string::npos);
  }
}

TEST(Ratios, are_not_formed_over_grids_caches_or_unequal_rounds) {
  const result::Result result = three_methods();
  const result::Case &first = result.cases[0], &second = result.cases[1];
  result::Case other = second;
  other.grid.name = "another";
  EXPECT_FALSE(ratio_of_cases(result, first, other));
  other = second;
  other.timing->caches = "warm";
  EXPECT_FALSE(ratio_of_cases(result, first, other));
  other = second;
  other.timing->frame_ns.samples.erase(other.timing->frame_ns.samples.begin());
  EXPECT_FALSE(ratio_of_cases(result, first, other));
  other = second;
  other.timing->frame_ns.samples[0] = 0.0;
  EXPECT_FALSE(ratio_of_cases(result, first, other));
}

TEST(Ratios, stand_in_a_ranking_and_between_all_pairs) {
  const result::Ratios ratios = ratios_of(three_methods(), {});
  const std::string ranking = ratio_table(ratios, false), pairs = ratio_table(ratios, true);
  EXPECT_NE(ranking.find("  ~ method-c / packed"), std::string::npos) << ranking;
  EXPECT_NE(ranking.find("1.10 (1.0"), std::string::npos) << ranking;
  EXPECT_NE(pairs.find("method-c / packed  method-a / packed"), std::string::npos) << pairs;
  EXPECT_EQ(ratio_table(ratios_of(three_methods(), only("method-[ab]")), true).find("method-c"), std::string::npos);
  EXPECT_TRUE(ratios_of(three_methods(), only("no such")).blocks.empty());
  const std::string csv = ratio_csv(ratios);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 2) << csv;
  const std::string markdown = ratio_markdown(ratios, false);
  EXPECT_NE(markdown.find("| ~ | method-c / packed | 1.66 | 1.10 (1.0"), std::string::npos) << markdown;
}

TEST(Ratios, as_json_are_what_their_schema_says_and_what_the_table_says) {
  const Json ratios = result::to_json(ratios_of(three_methods(), {}));
  EXPECT_EQ(config::schema_violations(config::row_of(config::Document::ratios).schema(), nlohmann::json(ratios)),
            std::vector<std::string>{});
  EXPECT_EQ(config::document_of(ratios), config::Document::ratios);
  const Json& block = ratios["blocks"][0];
  ASSERT_EQ(block["cases"].size(), 3u);
  ASSERT_EQ(block["pairs"].size(), 3u);
  EXPECT_EQ(block["cases"][0]["label"], "method-a / packed");
  EXPECT_EQ(block["pairs"][0]["over"], "rounds");
  EXPECT_EQ(block["pairs"][0]["takes_longer"], true) << "b than a";
  EXPECT_EQ(block["pairs"][2]["takes_longer"], false) << "c than b";
}

TEST(Ratios, of_two_grids_are_those_of_the_same_launches) {
  result::Result result = three_methods();
  result.cases[1].grid.name = "frustum 32px";
  EXPECT_EQ(ratios_of(result, {}).blocks.size(), 2u);
  const result::Ratios all = ratios_of(result, over_all_grids());
  ASSERT_EQ(all.blocks.size(), 1u);
  const result::RatioBlock& block = all.blocks[0];
  EXPECT_EQ(block.cases.at(1).label, "frustum 32px / method-b / packed");
  EXPECT_EQ(block.pairs.at(0).over, "launches");
  EXPECT_NEAR(block.pairs[0].ratio, 1.1, 0.01);
  EXPECT_TRUE(block.pairs[0].takes_longer);
  EXPECT_NE(ratio_table(all, false).find("of other grids of the same launches"), std::string::npos);
  EXPECT_TRUE(ratio_csv(all).starts_with("scene,view,case,other,ratio,low,high\n"))
      << "no column named grid holds a view";
  RatioRequest some = over_all_grids();
  some.methods = "^method-[ab]";
  EXPECT_EQ(ratios_of(result, some).blocks.at(0).cases.size(), 2u) << "a pattern for the methods of one grid";
  some.methods = "32px / method-b";
  EXPECT_EQ(ratios_of(result, some).blocks.at(0).cases.size(), 1u);
}

TEST(Ratios, the_page_gets_each_case_beside_the_fastest_and_the_one_above_it) {
  const std::vector<result::Ranked> rankings = ratio_rankings(three_methods());
  ASSERT_EQ(rankings.size(), 3u);
  EXPECT_FALSE(rankings[0].fastest);
  EXPECT_FALSE(rankings[0].is_like_above);
  EXPECT_EQ(rankings[1].fastest->id, "method-a");
  EXPECT_NEAR(rankings[1].fastest->ratio, 1.1, 0.005);
  EXPECT_EQ(rankings[2].above->id, "method-b");
  EXPECT_TRUE(rankings[2].is_like_above);
}

TEST(Ratios, of_too_few_launches_or_rounds_have_no_interval_anywhere) {
  for (const auto& [samples, launches] :
       {std::pair{std::vector<std::vector<double>>{{1000, 1010, 1020, 1030}, {2100, 2110, 2120, 2130}}, 2},
        {{{1000}, {2100}}, 1}}) {
    const result::Result result = timed_result(samples, launches);
    for (const double end : result.cases[1].timing->frame_ns.ci95) EXPECT_TRUE(std::isnan(end));
    EXPECT_FALSE(takes_longer(result, result.cases[1], result.cases[0]));
    const std::string ranking = ratio_table(ratios_of(result, {}), false), table = render_table(result, false);
    EXPECT_NE(ranking.find("  ~ method-b / packed"), std::string::npos) << ranking;
    EXPECT_NE(ranking.find(" (unknown)"), std::string::npos) << ranking;
    EXPECT_NE(ranking.find("\nunknown: an interval takes 3 launches, or 6 rounds of a single one.\n"),
              std::string::npos)
        << ranking;
    EXPECT_NE(ratio_csv(ratios_of(result, {})).find(",,\n"), std::string::npos) << ratio_csv(ratios_of(result, {}));
    EXPECT_NE(table.find("unknown"), std::string::npos) << table;
    EXPECT_NE(table.find("warning: 2 of 2 times without an interval: an interval takes 3 launches"), std::string::npos)
        << table;
  }
}

TEST(Ratios, the_table_of_a_run_marks_rows_that_are_not_told_from_the_one_above) {
  const std::string table = render_table(three_methods(), false);
  EXPECT_NE(table.find("~1.66"), std::string::npos) << table;
  EXPECT_EQ(table.find("~1.65"), std::string::npos) << table;
  EXPECT_NE(table.find("~: not measurably slower than the row above"), std::string::npos) << table;
  EXPECT_NE(table.find("with cold caches"), std::string::npos) << table;
}

TEST(TimingWarnings, say_what_speaks_against_times_and_what_to_try) {
  const result::Result steady = timed_result({{1000, 1010, 1001, 1004, 1003, 1002}});
  EXPECT_EQ(timing_warnings(steady), "");
  const auto with = [&](const result::Disturbed& disturbed) {
    result::Result changed = steady;
    changed.cases[0].timing->disturbed = disturbed;
    return timing_warnings(changed);
  };
  EXPECT_NE(with({0.5, 0.0, 0}).find("0.5 processors busy"), std::string::npos);
  EXPECT_EQ(with({0.05, 0.0, 0}), "");
  EXPECT_NE(with({0.0, 0.05, 0}).find("other guests"), std::string::npos);
  EXPECT_NE(with({0.0, 0.0, 3}).find("heat 3 times"), std::string::npos);

  const std::string wide = timing_warnings(three_methods());
  EXPECT_NE(wide.find("3 of 3 times with intervals wider than ±10 %"), std::string::npos) << wide;
  EXPECT_NE(wide.find("--launches 12"), std::string::npos) << wide;

  result::Result cold = timed_result({{1000}}, 1);
  result::WarmTimes& warm = cold.cases[0].timing->warm.emplace();
  warm.frame_ns.samples = {900, 901, 902, 903, 904, 905, 906};
  EXPECT_NE(timing_warnings(cold).find("6 rounds of a single one (1 of 7 rounds had cold caches, since sweeping "
                                       "them takes long); try --launches 5"),
            std::string::npos)
      << timing_warnings(cold);

  std::vector<double> alternating;
  for (int i = 0; i < 18; ++i) alternating.push_back(i % 2 == 0 ? 1000.0 + i : 1200.0 + i);
  const std::string two = timing_warnings(timed_result({alternating}));
  EXPECT_NE(two.find("1 of 1 time in two groups, as at 1.008 and 1.209 us"), std::string::npos) << two;
}

}  // namespace
}  // namespace clusterbench::report::testing
