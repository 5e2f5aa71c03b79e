#include "report/documents/compact_json.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "report/result_by_hand.h"
#include "report/results/result_record.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> lines_of(const Json& value) {
  std::istringstream in(compact_json(value));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(CompactJson, is_the_same_value) {
  const Json result = result::to_json(record_of(testing::judged(testing::result_by_hand()), {}));
  EXPECT_EQ(Json::parse(compact_json(result)), result);
  EXPECT_EQ(compact_json(Json::object()), "{}\n");
  const Json odd{{"a \"b\"", nullptr}, {"none", Json::array()}, {"text", "line\nfeed, {brace}"}};
  EXPECT_EQ(Json::parse(compact_json(odd)), odd);
}

TEST(CompactJson, has_a_line_for_each_list_of_values_however_long) {
  Json entry{{"name", std::string(100, 'x')}, {"samples", std::vector<double>(1000, 0.5)}, {"after", 1}};
  const std::vector<std::string> lines = lines_of(entry);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(std::count(lines[2].begin(), lines[2].end(), ','), 1000);
  EXPECT_EQ(lines[3], " \"after\": 1");
}

TEST(CompactJson, fills_lines_of_120_columns_with_short_members) {
  Json entry;
  for (int i = 0; i < 40; ++i) entry["member" + std::to_string(i)] = {{"mean", i}, {"max", nullptr}};
  const std::vector<std::string> lines = lines_of(entry);
  EXPECT_LT(lines.size(), 20u);
  for (const std::string& line : lines) EXPECT_LE(line.size(), 120u) << line;
}

TEST(CompactJson, begins_each_of_several_objects_in_a_line_of_its_own) {
  const Json case_like{{"id", "one"}, {"text", std::string(130, 'x')}};
  const std::vector<std::string> lines = lines_of(Json{{"cases", {case_like, case_like}}});
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "  {"), 2);
}

// As do the records that it is made of: a list is long from 64 elements on.
TEST(CompactJson, is_the_same_on_any_number_of_threads) {
  for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 500u}) {
    result::Result result = record_of(testing::judged(testing::result_by_hand()), {});
    const result::Case one = result.cases.front();
    result.cases.assign(count, one);
    for (std::size_t i = 0; i < count; ++i) {
      result.cases[i].name = std::string(i % 150, 'x') + std::to_string(i);
      if (i % 3 == 0) result.cases[i].occupancy.reset();
    }
    const std::string text = compact_json(result::to_json(result));
    for (const int threads : {2, 3, 16})
      EXPECT_EQ(compact_json(result::to_json(result, threads), threads), text) << count << " cases, " << threads;
  }
}

TEST(CompactJson, of_a_result_is_a_fraction_of_one_number_a_line) {
  const Json result = result::to_json(record_of(testing::result_by_hand(), {}));
  const std::string indented = result.dump(1), text = compact_json(result);
  EXPECT_LT(4 * std::count(text.begin(), text.end(), '\n'), std::count(indented.begin(), indented.end(), '\n'));
}

}  // namespace
}  // namespace clusterbench::report
