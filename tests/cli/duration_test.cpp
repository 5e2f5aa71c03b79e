// How long a command takes, and what is left of it, in words.

#include "cli/output/duration.h"

#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "cli/output/progress_line.h"
#include "cli/tool.h"

namespace clusterbench::cli {
namespace {

using test::Folder;
using test::Outcome;
using test::tool;

TEST(Duration, has_one_digit_or_two_of_them) {
  EXPECT_EQ(duration_text(0.4), "less than a second");
  EXPECT_EQ(duration_text(1.2), "about 1 second");
  EXPECT_EQ(duration_text(7.6), "about 8 seconds");
  EXPECT_EQ(duration_text(33.0), "about 35 seconds");
  EXPECT_EQ(duration_text(100.0), "about 2 minutes");
  EXPECT_EQ(duration_text(720.0), "about 10 minutes");
  EXPECT_EQ(duration_text(7200.0), "about 2 hours");
}

TEST(Duration, beyond_two_minutes_it_says_what_makes_it_shorter) {
  EXPECT_EQ(wait_text("24 cases", 120.0, {"--rounds 5"}), "24 cases: takes about 2 minutes");
  EXPECT_EQ(wait_text("24 cases", 240.0, {"--rounds 5", "--filter TEXT"}),
            "24 cases: takes about 4 minutes; shorter: --rounds 5, --filter TEXT");
}

// What a progress line prints where it can be redrawn.
std::string shown(const run::Progress& progress, bool quiet = false) {
  ::testing::internal::CaptureStderr();
  {
    ProgressLine line({.interactive = true, .columns = 200}, quiet);
    line.show(progress);
  }
  return ::testing::internal::GetCapturedStderr();
}

TEST(Progress, says_how_many_are_done_what_share_how_long_is_left_and_what_is_done_now) {
  const std::regex words(R"(\r\S*\[3/8\] 25 %, \d+:\d\d left  level: truth\r\S*)");
  const std::string line = shown({3, 8, 50.0, 200.0, "level: truth"});
  EXPECT_TRUE(std::regex_match(line, words)) << line;
  EXPECT_EQ(shown({3, 8, 50.0, 200.0, "level: truth"}, true), "");
  const std::string begun = shown({0, 8, 0.0, 200.0, "level: truth"});
  EXPECT_NE(begun.find("[0/8] 0 %  level: truth"), std::string::npos) << begun;
}

TEST(Progress, counts_no_cases_where_there_are_none) {
  const std::regex words(R"(\r\x1b\[K46 %, \d+:\d\d left  pictures of a\r\S*)");
  const std::string line = shown({0, 0, 46.0, 100.0, "pictures of a"});
  EXPECT_TRUE(std::regex_match(line, words)) << line;
}

// A level that takes no time, which every command says of itself in its first line.
TEST(Duration, is_told_in_the_first_line_of_each_command_that_somebody_waits_for) {
  const Folder folder;
  const std::string level = test::source_file("scenes/street.glb"), few = " --tiles 128 --slices 4 --grid frustum";
  const std::regex told(R"(clusterbench: .*takes (less than a second|about \d+ (second|minute|hour)s?).*)");
  for (const std::string& arguments :
       {"recommend " + level + few + " --assigner exact-fast --set 'scenes.*.frames=2' --no-timing",
        "recommend " + level + few + " --assigner exact-fast --set 'scenes.*.frames=2' --set timing.rounds=1",
        "size " + level + few + " --set 'scenes.*.frames=2'"}) {
    const Outcome done = tool(arguments);
    ASSERT_EQ(done.code, 0) << done.err;
    const std::string first = done.err.substr(0, done.err.find('\n'));
    EXPECT_TRUE(std::regex_match(first, told)) << first;
    EXPECT_EQ(tool(arguments + " -q").err.find("takes "), std::string::npos);
  }
}

// Where no line can be redrawn.
TEST(Progress, a_step_that_takes_long_says_again_and_again_that_it_goes_on) {
  ::testing::internal::CaptureStderr();
  {
    ProgressLine line({.interactive = false}, false, std::chrono::milliseconds(20));
    line.show({3, 8, 50.0, 200.0, "level: truth"});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  const std::string told = ::testing::internal::GetCapturedStderr();
  std::size_t lines = 0;
  for (std::size_t at = told.find("[3/8] 25 %"); at != std::string::npos; at = told.find("[3/8] 25 %", at + 1)) ++lines;
  EXPECT_GE(lines, 2u) << told;
  EXPECT_NE(told.find("  level: truth\n"), std::string::npos) << told;
}

TEST(Progress, nothing_is_told_before_there_is_something_and_after_it_has_ended) {
  ::testing::internal::CaptureStderr();
  {
    ProgressLine line({.interactive = false}, false, std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    ::testing::internal::CaptureStderr();
    line.show({3, 8, 50.0, 200.0, "level: truth"});
    line.clear();
    ::testing::internal::GetCapturedStderr();  // a busy machine may tell it in between
    ::testing::internal::CaptureStderr();
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace clusterbench::cli
