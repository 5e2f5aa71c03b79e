#include "core/regular_expression.h"

#include <gtest/gtest.h>

#include <optional>

#include "core/error.h"
#include "core/pattern.h"
#include "core/random.h"
#include "needs.h"

namespace clusterbench {
namespace {

// By RE2's documentation of its syntax.
struct Row {
  const char* expression;
  const char* text;
  bool is_in, is_all;
};
constexpr Row k_rows[] = {
    {"", "", true, true},
    {"", "a", true, false},
    {"aabb(-fast)?/packed$", "hall/frustum 64px/aabb-fast/packed", true, false},
    {"aabb(-fast)?/packed$", "hall/frustum 64px/aabb/packed/half", false, false},
    {"H(2|31)", "H31", true, true},
    {"H(2|31)", "H312", true, false},
    {"^a|b$", "ab", true, false},
    {"^(a|b)$", "ab", false, false},
    {"a.c", "a\nc", false, false},
    {"(?s)a.c", "a\nc", true, true},
    {"(?s:a.)c", "a\nc", true, true},
    {"(?i)Street", "sTREET", true, true},
    {"(?i:S)treet", "sTREET", false, false},
    {"(?m)^b$", "a\nb\nc", true, false},
    {"^b$", "a\nb\nc", false, false},
    {"a{2,3}", "aa", true, true},
    {"^a{2,3}$", "aaaa", false, false},
    {"a{2,}", "aaaaa", true, true},
    {"a{0}b", "b", true, true},
    {"^a{01}$", "a{01}", true, true},  // with a leading zero it is text
    {"^a{01}$", "a", false, false},
    {"^a{999999999}$", "a{999999999}", true, true},
    {"a{,2}", "a{,2}", true, true},
    {"x{", "x{", true, true},
    {"[a-c-]+", "b-c", true, true},
    {"[]a]+", "]a]", true, true},
    {"[^a-z]", "abc", false, false},
    {"[[:digit:]_]+", "12_3", true, true},
    {"[[:^alpha:]]", "abc", false, false},
    {"[\\d\\]]+", "1]2", true, true},
    {"\\bfast\\b", "aabb-fast/packed", true, false},
    {"\\Bast", "fast", true, false},
    {"\\w+\\s\\W\\S\\D", "ab .xy", true, true},
    {"\\.", "a", false, false},
    {"\\x41\\x{42}\\103\\t", "ABC\t", true, true},
    {"\\Qa+b(\\E+", "a+b((", true, true},
    {"\\Aab\\z", "ab", true, true},
    {"(?P<name>a)(?:b)", "ab", true, true},
    {"a*?b+?c??", "aab", true, true},
    {"(a|ab)(c|bcd)(d*)", "abcd", true, true},
    {"(|a)+", "aaa", true, true},
    {"(a*)*b", "aaab", true, true},
    {"\u00fc.", "\u00fc\u20ac", true, true},
    {"[\u00e0-\u00ff]", "\u00fc", true, true},
    {"^.$", "\u20ac", true, true},
};

TEST(RegularExpression, matches_as_RE2_documents_it) {
  for (const Row& row : k_rows) {
    const RegularExpression expression(row.expression);
    EXPECT_EQ(expression.is_in(row.text), row.is_in) << row.expression << " in " << row.text;
    EXPECT_EQ(expression.is_all_of(row.text), row.is_all) << row.expression << " all of " << row.text;
  }
}

std::optional<std::string> refusal_of(const std::string& text) {
  try {
    const RegularExpression expression(text);
  } catch (const Error& error) {
    return error.message();
  }
  return {};
}

TEST(RegularExpression, that_is_none_says_why) {
  EXPECT_EQ(refusal_of("(a"), "missing ): (a");
  EXPECT_EQ(refusal_of("a)"), "unexpected ): a)");
  EXPECT_EQ(refusal_of("*a"), "no argument for repetition operator: *");
  EXPECT_EQ(refusal_of("a**"), "bad repetition operator: **");
  EXPECT_EQ(refusal_of("[a"), "missing ]: [a");
  EXPECT_EQ(refusal_of("[z-a]"), "invalid character class range: z-a");
  EXPECT_EQ(refusal_of("\\1"), "invalid escape sequence: \\1");
  EXPECT_EQ(refusal_of("a\\"), "trailing \\");
  EXPECT_EQ(refusal_of("(?=a)"), "invalid perl operator: (?=");
  EXPECT_EQ(refusal_of("(?i-)a"), "invalid perl operator: (?i-)");
  EXPECT_EQ(refusal_of("(?i)*"), "no argument for repetition operator: *");
  EXPECT_EQ(refusal_of("a{1001}"), "invalid repetition size: {1001}");
  EXPECT_EQ(refusal_of("a{3,2}"), "invalid repetition size: {3,2}");
  EXPECT_EQ(refusal_of("((a{100}){100}){100}"), "invalid repetition size: {100}");
  EXPECT_EQ(refusal_of("\xff"), "invalid UTF-8");
  EXPECT_NE(refusal_of("\\pL"), std::nullopt);
}

// Each would exhaust a stack, memory or patience.
TEST(RegularExpression, is_bounded) {
  EXPECT_EQ(refusal_of(std::string(5000, '(') + std::string(5000, ')')), "expression nests too deeply");
  std::string many;
  for (int i = 0; i < 1500; ++i) many += "a{999}";
  EXPECT_EQ(refusal_of(many), "pattern too large - compile failed");
  EXPECT_FALSE(RegularExpression("(a+)+$").is_in(std::string(10'000, 'a') + "!"));
  EXPECT_FALSE(RegularExpression("(a|aa|a?){50}b").is_in(std::string(1000, 'a')));
}

TEST(RegularExpression, takes_bytes_that_are_no_text_as_no_character) {
  EXPECT_TRUE(
      RegularExpression("a").is_in("\xff"
                                   "a"));
  EXPECT_FALSE(
      RegularExpression("^.a").is_in("\xff"
                                     "a"));
  EXPECT_FALSE(RegularExpression("[^b]").is_in("\xff\xfe"));
}

std::string random_text(SplitMix64& random, std::string_view alphabet, std::uint64_t most) {
  std::string text;
  for (std::uint64_t left = random.below(most + 1); left > 0; --left) text += alphabet[random.below(alphabet.size())];
  return text;
}

std::optional<Pattern> library_pattern(const std::string& text) {
  try {
    return Pattern(text, "");
  } catch (const Error&) {
    return {};
  }
}

// Random expressions against RE2, an independent implementation. A pattern is also looked for as it stands.
TEST(RegularExpression, answers_as_RE2_does) {
  NEEDS(re2);
  SplitMix64 random(7);
  int matched = 0, refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::string expression = random_text(random, "aab|()*+?.^$[]{2,}\\bdW-:(?i)", 10);
    const std::optional<Pattern> theirs = library_pattern(expression);
    const std::optional<std::string> refusal = refusal_of(expression);
    ASSERT_EQ(theirs.has_value(), !refusal) << expression << ": " << refusal.value_or("accepted");
    if (!theirs) {
      ++refused;
      continue;
    }
    const RegularExpression ours(expression);
    for (int k = 0; k < 5; ++k) {
      const std::string text = random_text(random, "aabBd1.-(\n2", 6);
      const bool is_literal = text.find(expression) != std::string::npos;
      matched += ours.is_in(text) ? 1 : 0;
      ASSERT_EQ(theirs->is_in(text), is_literal || ours.is_in(text)) << expression << " in " << text;
      ASSERT_EQ(theirs->is_all_of(text), text == expression || ours.is_all_of(text)) << expression << " of " << text;
    }
  }
  EXPECT_GT(matched, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace clusterbench
