#include "report/page/page.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "records.h"
#include "report/page/page_figures.h"
#include "report/page/page_template.h"
#include "result/figures/case_figure.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

TEST(Page, a_string_cannot_end_the_script_that_it_stands_in) {
  const Json value{{"name", "</script><!-- a\u2028b\u2029c"}};
  const std::string text = script_json(value);
  EXPECT_EQ(text, R"({"name":"\u003c/script>\u003c!-- a\u2028b\u2029c"})");
  EXPECT_EQ(Json::parse(text), value);
}

result::Result empty_result(const char* name) {
  result::Result result;
  result.name = name;
  result.config = Json::object();
  return result;
}

TEST(Page, holds_the_results_and_the_command_once) {
  if (!page_obstacle().empty()) GTEST_SKIP() << page_obstacle();
  const std::string html = page({{"a.json", empty_result("first")}, {"b.json", empty_result("second")}}, "the command");
  EXPECT_NE(
      html.find(R"({"command":"the command","results":[{"file":"a.json","result":{"schema_version":0,"name":"first",)"),
      std::string::npos);
  EXPECT_NE(
      html.find(
          R"(,"cases":[],"doubts":[],"ratios":[],"costs":[]},{"file":"b.json","result":{"schema_version":0,"name":"second",)"),
      std::string::npos);
  EXPECT_EQ(html.find(k_results_mark), std::string::npos);
}

TEST(Page, has_the_words_of_all_figures_and_sets_of_samples_once) {
  if (!page_obstacle().empty()) GTEST_SKIP() << page_obstacle();
  const std::string html = page({}, "");
  const std::string start = R"({"command":"","results":[],"figures":)";
  ASSERT_NE(html.find(start), std::string::npos);
  const std::string script = html.substr(html.find(start));
  const Json data = Json::parse(script.substr(0, script.find("</script>")));
  ASSERT_EQ(data["figures"].size(), result::figures().size());
  EXPECT_EQ(data["figures"][0],
            (Json{{"name", "frame_us"}, {"unit", "us"}, {"meaning", result::find_figure("frame_us")->meaning}}));
  EXPECT_EQ(data["sample_sets"]["opaque"], "visible surfaces");
}

// Timed, with errors, samples of two sets and the fullest frame's bytes.
Json measured_case() {
  const Json needy{{"samples", 10}, {"needed", 7}, {"missed", 2}, {"read_bytes", 40}};
  return {{"timing", {{"frame_ns", {{"median", 69712.3}}}}},
          {"error", {{"true_pairs", 3}, {"false_positives", 1}, {"false_negatives", 2}}},
          {"shading", {{"samples", 10}, {"needed", 9}, {"missed", 0}}},
          {"samples", {{"opaque", needy}}},
          {"buffers", {{"bytes", {{"high_water", 831}}}}}};
}

TEST(PageFigures, are_those_of_the_table_with_the_digits_of_a_result) {
  const result::Result result = test::result_of({{"cases", Json::array({measured_case()})}});
  const std::vector<result::PageCase> cases = page_cases(result);
  ASSERT_EQ(cases.size(), 1u);
  const Json figures = result::to_json(cases[0])["figures"];
  EXPECT_EQ(figures["frame_us"], 69.7123);
  EXPECT_EQ(figures["excess"], 0.333333333);
  EXPECT_EQ(figures["missed"], 2);
  EXPECT_EQ(figures["bytes"], 831);
  for (const result::Figure& figure : result::figures())
    EXPECT_EQ(figures.contains(figure.name), result::figure_of(result.cases[0], std::string(figure.name)).has_value())
        << figure.name;
  EXPECT_FALSE(figures.contains("frame_us.max"));
}

TEST(PageFigures, of_samples_are_those_of_the_sets_that_rank_the_case) {
  const std::vector<result::PageCase> cases =
      page_cases(test::result_of({{"cases", Json::array({measured_case(), Json::object()})}}));
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].sets, std::vector<std::string>{"opaque"});
  const Json figures = result::to_json(cases[0])["figures"];
  EXPECT_EQ(figures["unlit"], 0.285714286);
  EXPECT_EQ(figures["read_bytes"], 4);
  EXPECT_TRUE(cases[1].sets.empty());
  EXPECT_FALSE(result::to_json(cases[1])["figures"].contains("unlit"));
}

TEST(Page, a_mark_within_a_result_stays_as_it_is) {
  if (!page_obstacle().empty()) GTEST_SKIP() << page_obstacle();
  const std::string html = page({{"a.json", empty_result("{{results}}")}}, "");
  EXPECT_NE(html.find(R"("name":"{{results}}")"), std::string::npos);
}

TEST(Page, a_build_without_it_says_what_was_missing) {
  if (page_obstacle().empty()) GTEST_SKIP() << "this build has the page";
  EXPECT_THROW(page({}, ""), Error);
}

}  // namespace
}  // namespace clusterbench::report
