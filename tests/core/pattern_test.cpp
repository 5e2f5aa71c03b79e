#include "core/pattern.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace clusterbench {
namespace {

TEST(Pattern, is_looked_for_anywhere_or_in_all_of_a_text) {
  const Pattern pattern("aabb(-fast)?/packed$", "--filter");
  EXPECT_TRUE(pattern.is_in("hall/walk/frustum 64px/aabb-fast/packed"));
  EXPECT_FALSE(pattern.is_in("hall/walk/frustum 64px/aabb/packed/half"));
  EXPECT_TRUE(Pattern("H(2|31)", "--cases").is_all_of("H31"));
  EXPECT_FALSE(Pattern("H(2|31)", "--cases").is_all_of("H312"));
  EXPECT_TRUE(Pattern().is_in("anything")) << "none is everywhere";
  EXPECT_TRUE(Pattern("", "--filter").is_in("anything"));
}

// A name that was copied from the output has characters that mean something in a regular expression.
TEST(Pattern, that_stands_in_a_text_as_it_is_matches_it) {
  const std::string name =
      "hall/walk/filament: frustum 16px x 16 ..5..at most 100/aabb(spot=cone,columns=nearest)/a+b(2)";
  EXPECT_TRUE(Pattern(name, "").is_in(name));
  EXPECT_TRUE(Pattern(name, "").is_all_of(name));
  EXPECT_TRUE(Pattern("aabb(spot=cone,columns=nearest)/a+b(2)", "").is_in(name));
  EXPECT_FALSE(Pattern("aabb(spot=cone,columns=nearest)/a+b(2)", "").is_all_of(name));
  EXPECT_FALSE(Pattern("a+b(3)", "").is_in(name));
  EXPECT_TRUE(Pattern("a+b.2", "").is_in("aab(2")) << "and it is a regular expression all the same";
}

TEST(Pattern, that_matches_nothing_is_told_which_of_its_characters_are_no_plain_ones) {
  EXPECT_EQ(pattern_hint("exact-fast/packed"), "");
  EXPECT_EQ(pattern_hint("aabb(spot=cone)/a+b(2)"),
            ", neither as it stands nor as a regular expression, in which \\ makes ( ) + plain characters");
  EXPECT_EQ(pattern_hint("a+b"),
            ", neither as it stands nor as a regular expression, in which \\ makes + a plain character");
}

// Backtracking would take 2^40 steps here.
TEST(Pattern, takes_linear_time_on_nested_repetitions) {
  EXPECT_FALSE(Pattern("(a+)+$", "--filter").is_in(std::string(40, 'a') + "!"));
}

TEST(Pattern, what_is_none_is_told_with_the_option) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      const Pattern pattern(text, "--filter");
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message("("),
            "--filter: '(' is no regular expression (as RE2 has them): missing ): (; \\ makes ( a plain character");
  EXPECT_NE(message("(?!a)").find("invalid perl operator"), std::string::npos) << message("(?!a)");
  EXPECT_NE(message("((a{100}){100}){100}").find("invalid repetition size"), std::string::npos)
      << message("((a{100}){100}){100}");
  EXPECT_EQ(message(std::string(10'001, 'a')), "--filter: a regular expression of 10001 bytes; at most 10000");
}

}  // namespace
}  // namespace clusterbench
