#include "report/history.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "report/history_page.h"
#include "report/json.h"
#include "report/result_by_hand.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;

class History : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  // A result whose fast case takes that long.
  void add(const std::string& commit, double assign_ns, const std::string& cpu = "a processor") {
    run::Result result = testing::result_by_hand();
    result.machine.cpu = cpu;
    result.cases[1] = testing::case_by_hand("fast", "aabb", assign_ns);
    add_to_history(file_, result_to_json(result, {}), commit);
  }
  std::string text() const {
    std::ifstream in(file_);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& text) const { std::ofstream(file_) << text; }
  std::string where_refused() const {
    try {
      read_history(file_);
    } catch (const Error& error) {
      return error.where();
    }
    return "accepted";
  }

  const fs::path folder_ = fs::temp_directory_path() / ("clusterbench_history_" + std::to_string(getpid()));
  const std::string file_ = (folder_ / "history.jsonl").string();
};

const Series& times_of_fast(const std::vector<Series>& all) {
  for (const Series& one : all)
    if (one.metric->name == "assign_time" && one.case_name.find("/aabb/") != std::string::npos) return one;
  throw std::runtime_error("no such series");
}

TEST_F(History, a_slower_commit_is_named_with_its_change_and_direction) {
  for (const char* commit : {"c1", "c2", "c3"}) add(commit, 3000.0);
  for (const char* commit : {"c4", "c5", "c6"}) add(commit, 3300.0);
  const std::vector<Series> all = series_of(read_history(file_), {});
  ASSERT_EQ(times_of_fast(all).changes.size(), 1u);
  const std::string said = history_text(all, 6, false);
  EXPECT_NE(said.find("at c4: 3000 to 3300, +10 %, worse"), std::string::npos) << said;
  EXPECT_EQ(said.find("brute-force"), std::string::npos) << said;
  EXPECT_NE(history_text(all, 6, true).find("brute-force"), std::string::npos);
  EXPECT_NE(said.find("6 results, "), std::string::npos) << said;
}

TEST_F(History, times_of_two_machines_are_two_series) {
  for (const char* commit : {"c1", "c2", "c3"}) add(commit, 3000.0);
  for (const char* commit : {"c4", "c5", "c6"}) add(commit, 9000.0, "another processor");
  for (const Series& one : series_of(read_history(file_), {})) EXPECT_TRUE(one.changes.empty()) << one.machine;
}

TEST_F(History, adding_leaves_the_earlier_lines_as_they_are_and_no_other_file) {
  add("c1", 3000.0);
  const std::string before = text();
  EXPECT_EQ(std::count(before.begin(), before.end(), '\n'), 1);
  add("c2", 3100.0);
  EXPECT_EQ(text().substr(0, before.size()), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(History, a_failed_addition_leaves_the_file_as_it_was) {
  add("c1", 3000.0);
  const std::string before = text();
  std::ofstream(file_ + ".new") << "another writer's";
  EXPECT_THROW(add("c2", 3000.0), Error);
  EXPECT_EQ(text(), before);
  EXPECT_TRUE(fs::exists(file_ + ".new"));
}

TEST_F(History, a_corrupt_line_is_named_by_its_number) {
  add("c1", 3000.0);
  const std::string good = text();
  write(good + "{\"history_version\": 1, \n");
  EXPECT_EQ(where_refused(), "line 2");
  write(good + good + "{}\n");
  EXPECT_EQ(where_refused(), "line 3");
  write(good + good.substr(0, good.size() / 2));  // cut off
  EXPECT_EQ(where_refused(), "line 2");
  write(good + good);
  EXPECT_EQ(where_refused(), "accepted");
}

TEST_F(History, what_is_no_history_is_not_added_to) {
  write("a letter\n");
  EXPECT_THROW(add("c1", 3000.0), Error);
  EXPECT_EQ(text(), "a letter\n");
}

TEST_F(History, the_page_draws_what_varies_and_escapes_names) {
  for (const char* commit : {"c1", "c2"}) add(commit, 3000.0);
  for (const char* commit : {"c3", "<c4>"}) add(commit, 3300.0);
  const std::string page = history_page(series_of(read_history(file_), {}), 4);
  EXPECT_NE(page.find("aria-label=\"assign_time in ns of hall"), std::string::npos) << page;
  EXPECT_NE(page.find("<li class=\"worse\">c3: 3000 to 3300, +10 %, worse</li>"), std::string::npos) << page;
  EXPECT_EQ(page.find("<c4>"), std::string::npos);
  EXPECT_NE(page.find("&lt;c4&gt;: 3300"), std::string::npos);
  EXPECT_EQ(page.find("list_bytes"), std::string::npos);
  EXPECT_NE(page.find("prefers-color-scheme: dark"), std::string::npos);
}

}  // namespace
}  // namespace clusterbench::report
