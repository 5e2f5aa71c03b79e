#include "core/wildcards.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#ifndef _WIN32
#include <fnmatch.h>
#endif

namespace clusterbench {
namespace {

TEST(Wildcards, stars_take_any_text) {
  EXPECT_TRUE(matches_wildcards("*", ""));
  EXPECT_TRUE(matches_wildcards("*-fast", "aabb-fast"));
  EXPECT_FALSE(matches_wildcards("*-fast", "aabb-faster"));
  EXPECT_TRUE(matches_wildcards("a*b*c", "a-b-b-c"));
  EXPECT_FALSE(matches_wildcards("", "a"));
}

TEST(Wildcards, question_marks_and_brackets_take_one_byte) {
  EXPECT_TRUE(matches_wildcards("?vh", "bvh"));
  EXPECT_TRUE(matches_wildcards("[a-c]vh", "bvh"));
  EXPECT_FALSE(matches_wildcards("[!a-c]vh", "bvh"));
  EXPECT_TRUE(matches_wildcards("[]x]", "]"));
  EXPECT_TRUE(matches_wildcards("[ab", "[ab"));
  EXPECT_TRUE(matches_wildcards("\\*", "*"));
  EXPECT_FALSE(matches_wildcards("\\*", "a"));
}

TEST(Wildcards, many_stars_take_no_exponential_time) {
  std::string pattern;
  for (int i = 0; i < 50; ++i) pattern += "*a";
  EXPECT_FALSE(matches_wildcards(pattern + "b", std::string(2000, 'a')));
}

#ifndef _WIN32
TEST(Wildcards, are_those_of_the_c_library) {
  std::mt19937 random(5);
  const std::string letters = "aab-*?[]!\\";
  const auto word = [&](std::size_t most, std::size_t kinds) {
    std::string out;
    for (std::size_t i = random() % (most + 1); i > 0; --i) out += letters[random() % kinds];
    return out;
  };
  int matches = 0;
  for (int i = 0; i < 300'000; ++i) {
    const std::string pattern = word(7, letters.size()), text = word(6, random() % 3 == 0 ? letters.size() : 3);
    if (pattern.ends_with('\\') || pattern.find('[') != std::string::npos) continue;  // see below
    const bool known = fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
    ASSERT_EQ(matches_wildcards(pattern, text), known) << pattern << " " << text;
    matches += known ? 1 : 0;
  }
  EXPECT_GT(matches, 1000);
}

// Whole brackets; of those that are cut off, or end in a backslash, C libraries differ.
TEST(Wildcards, brackets_are_those_of_the_c_library) {
  std::mt19937 random(6);
  const std::string letters = "abcd!-]";
  for (int i = 0; i < 100'000; ++i) {
    std::string pattern = "x[";
    for (int k = static_cast<int>(random() % 5) + 1; k > 0; --k) pattern += letters[random() % 5];
    pattern += random() % 3 == 0 ? "-d]" : "]";
    pattern += random() % 2 == 0 ? "*" : "";
    const std::string text = std::string("x") + letters[random() % letters.size()] + (random() % 3 == 0 ? "b" : "");
    ASSERT_EQ(matches_wildcards(pattern, text), fnmatch(pattern.c_str(), text.c_str(), 0) == 0)
        << pattern << " " << text;
  }
}
#endif

}  // namespace
}  // namespace clusterbench
