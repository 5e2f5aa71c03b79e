#include "report/page/page.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "report/page/page_template.h"

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
          R"(,"doubts":[],"ratios":[],"costs":[]},{"file":"b.json","result":{"schema_version":0,"name":"second",)"),
      std::string::npos);
  EXPECT_EQ(html.find(k_results_mark), std::string::npos);
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
