#include <gtest/gtest.h>

#include "report/choosing/recommend_report.h"
#include "report/result_by_hand.h"

namespace clusterbench::report {
namespace {

// Candidates a, b ... and what was found of each.
std::string stopped(const std::vector<search::Record>& records, int runners_up = 5) {
  search::View view;
  search::Found found;
  for (const search::Record& record : records) {
    view.candidates.push_back({std::string(1, static_cast<char>('a' + view.candidates.size())), 0, 0, {}});
    found.records.push_back(record);
  }
  return unfinished_text(view, found, {result::find_figure("bytes"), {}, 0.05, runners_up});
}

search::Record record(std::size_t frames, double objective, bool is_broken = false) {
  return {frames, {objective, 0.0, is_broken ? std::vector<std::size_t>{0} : std::vector<std::size_t>{}, false}, 0.0};
}

TEST(Unfinished, shows_what_was_measured_on_the_most_frames_first_and_of_those_the_best) {
  const std::string text = stopped({record(1, 5), record(4, 90), record(0, 0), record(4, 70), record(4, 1, true)}, 2);
  EXPECT_NE(text.find("stopped: 4 of 5 candidates had been measured"), std::string::npos) << text;
  const std::size_t best = text.find(" d "), next = text.find(" b "), last = text.find(" a ");
  ASSERT_NE(best, std::string::npos) << text;
  EXPECT_LT(best, next) << text;
  EXPECT_LT(next, last) << text;
  EXPECT_NE(last, std::string::npos) << text;
  EXPECT_EQ(text.find(" e "), std::string::npos) << "breaks a constraint: " << text;
  EXPECT_EQ(stopped({record(1, 5), record(4, 90)}, 0).find(" a "), std::string::npos) << "one is asked for";
}

TEST(Unfinished, says_that_there_is_nothing_yet) {
  EXPECT_NE(stopped({record(0, 0), record(1, 3, true)}).find("1 of 2 candidates"), std::string::npos);
  EXPECT_NE(stopped({record(0, 0)}).find("none that satisfies the constraints"), std::string::npos);
}

Question limited_to(const std::string& limit) {
  return {result::find_figure("bytes"), constraints_of({config::limit_rule(limit, "", "--fail-if")})};
}

// The case by hand gives 3 lights per sample, and 7 at most in a cell. `failures`: what a run would fail for.
bool can_satisfy(const std::string& limit, std::vector<run::Failure> failures = {}) {
  run::CaseResult case_result = testing::case_by_hand("a", "aabb", 1.0);
  case_result.conservative = true;
  case_result.failures = std::move(failures);
  const Question question = limited_to(limit);
  return may_hold_on_more_frames(question, judge_of(question, {})(std::span(&case_result, 1)));
}

TEST(RecommendQuestion, a_candidate_can_satisfy_all_limits_where_each_broken_one_is_of_a_mean) {
  EXPECT_TRUE(can_satisfy("evaluated > 2")) << "a mean can fall";
  EXPECT_FALSE(can_satisfy("longest > 6")) << "a mark only grows";
  EXPECT_TRUE(can_satisfy("longest > 7")) << "breaks nothing";
}

TEST(RecommendQuestion, a_recorded_failure_stays_unless_it_is_of_a_share) {
  using Kind = run::Failure::Kind;
  for (const Kind kind : {Kind::lost_pairs, Kind::extra_pairs, Kind::dropped_pairs}) {
    EXPECT_FALSE(can_satisfy("longest > 7", {{kind, "fails"}})) << run::name_of(kind);
    EXPECT_FALSE(can_satisfy("evaluated > 2", {{kind, "fails"}})) << run::name_of(kind);
  }
  EXPECT_TRUE(can_satisfy("longest > 7", {{Kind::lost_at_samples, "fails"}}));
}

}  // namespace
}  // namespace clusterbench::report
