// Budgets as people write them.

#include "config/limit_rules.h"
#include "result/figures/case_figure.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace clusterbench::config {
namespace {

LimitRule rule_of(const std::string& text) {
  return limit_rule(text, "", "--fail-if");
}

std::string refusal_of_rule(const std::string& text) {
  try {
    return "taken as " + rule_of(text).text();
  } catch (const Error& error) {
    return error.message();
  }
}

TEST(LimitRules, fail_above_below_at_and_outside_of_what_they_say) {
  struct Row {
    const char* text;
    std::vector<double> broken, kept;
  };
  const Row rows[] = {
      {"longest > 64", {65}, {64, 0}},
      {"longest >= 64", {64}, {63}},
      {"lights < 1", {0}, {1, 2}},
      {"lights<=300", {300, 0}, {301}},
      {"lights_in_view == 0", {0}, {1, -1}},
      {"lights_in_view 200..300", {199, 301, 0}, {200, 300, 250}},
      {"lights_in_view outside 200 .. 300", {199, 301}, {200, 300}},
  };
  for (const Row& row : rows) {
    const LimitRule rule = rule_of(row.text);
    EXPECT_FALSE(rule.is_relative) << row.text;
    for (const double value : row.broken) EXPECT_TRUE(rule.is_broken_by(value)) << row.text << ": " << value;
    for (const double value : row.kept) EXPECT_FALSE(rule.is_broken_by(value)) << row.text << ": " << value;
  }
}

TEST(LimitRules, in_percent_are_changes_against_a_baseline) {
  const LimitRule rule = rule_of("longest > +5 %");
  EXPECT_TRUE(rule.is_relative);
  EXPECT_EQ(rule.limit, 5.0);
  EXPECT_TRUE(rule_of("bytes>3%").is_relative);
  EXPECT_EQ(rule_of("lights < -10 %").limit, -10.0);
  const LimitRule both = rule_of("instructions -3..+3 %");
  EXPECT_TRUE(both.is_relative);
  EXPECT_TRUE(both.is_broken_by(-4.0));
  EXPECT_TRUE(both.is_broken_by(3.5));
  EXPECT_FALSE(both.is_broken_by(-3.0));
}

TEST(LimitRules, name_cases_before_a_colon) {
  EXPECT_EQ(rule_of("exact-fast: longest > 5").cases, "exact-fast");
  EXPECT_EQ(rule_of("(?:aabb|exact)-fast : longest > 5").cases, "(?:aabb|exact)-fast");
  EXPECT_EQ(rule_of("longest > 5").cases, "");
}

TEST(LimitRules, say_themselves_as_they_are_written) {
  for (const char* text :
       {"longest > 64", "lights < 1", "lights_in_view == 0", "lights_in_view outside 200..300",
        "exact-fast: longest > +5 %", "bytes <= -2.5 %", "lights < -0 %", "lights > +0 %", "unlit >= 0.001"}) {
    EXPECT_EQ(rule_of(text).text(), text);
    EXPECT_EQ(rule_of(rule_of(text).text()).text(), text);
  }
}

TEST(LimitRules, that_are_none_are_refused_with_what_is_allowed) {
  const std::pair<const char*, const char*> rows[] = {
      {"unlit", "is no budget; takes a figure, then >, >=, <, <= or == and a number or a range"},
      {"lights = 3", "is no budget"},
      {"lights 3", "is no budget"},
      {"lights 5..", "ends with '', which is no number"},
      {"lights 9..5", "has a range that ends before it begins"},
      {"lights 5 %..9", "has percent at one end of its range alone"},
      {"lights > +-5", "which is no number"},
      {"lights > 5 % %", "which is no number"},
      {": longest > 5", "has no part of cases' names before its colon"},
      {"(: longest > 5", "selects cases by a pattern that is wrong: "},
      {"lihgts < 1", "names no figure of a case (did you mean 'lights'?)"},
      {"frame_us > +5 %", "holds times of two runs against each other"},
      {"frame_cost_us > 5%", "--baseline-binary"},
      {"device_us > +5 %", "set a budget in its own unit, as 'device_us > 50'"},
  };
  for (const auto& [text, part] : rows)
    EXPECT_NE(refusal_of_rule(text).find(part), std::string::npos) << text << ": " << refusal_of_rule(text);
}

TEST(LimitRules, are_near_on_the_side_that_they_fail_on) {
  EXPECT_TRUE(rule_of("bytes > 100").is_near(95));
  EXPECT_FALSE(rule_of("bytes > 100").is_near(89));
  EXPECT_TRUE(rule_of("lights < 100").is_near(105));
  EXPECT_FALSE(rule_of("lights < 100").is_near(111));
  EXPECT_TRUE(rule_of("lights < -10 %").is_near(-9.5)) << "a tenth of ten percent";
  EXPECT_FALSE(rule_of("lights < -10 %").is_near(-8.9));
  EXPECT_TRUE(rule_of("longest > +5 %").is_near(4.6));
  EXPECT_TRUE(rule_of("longest > -5 %").is_near(-5.4));
  EXPECT_FALSE(rule_of("longest > -5 %").is_near(-5.6));
  for (const char* text : {"lights > 0", "lights < 0", "lights < -0 %"})
    for (const double value : {0.0, 1e-9, -1e-9, 1.0}) EXPECT_FALSE(rule_of(text).is_near(value)) << text;
  for (const char* text : {"lights 100..200", "lights == 199"})
    for (const double value : {101.0, 199.0, 198.5}) EXPECT_FALSE(rule_of(text).is_near(value)) << text;
}

TEST(LimitRules, a_figure_at_samples_can_name_its_set_and_others_can_not) {
  for (const char* text : {"opaque.unlit > 0", "volume.overshade > 3", "fog.lost_irradiance >= 0.5"})
    EXPECT_EQ(limit_rule(text, "", "--fail-if").text(), text);
  EXPECT_EQ(result::figure_at_samples("opaque.unlit").set, "opaque");
  EXPECT_EQ(result::figure_at_samples("frame_us.max").set, "");
  for (const char* text : {"opaque.bytes > 0", "opaqe.unlit > 0", "opaque. > 0"}) {
    std::string message;
    try {
      limit_rule(text, "", "--fail-if");
    } catch (const Error& error) {
      message = error.what();
    }
    EXPECT_NE(
        message.find("of one set of samples as in 'opaque.unlit' (sets: volume, opaque, transparent, fog, mirror, "
                     "anywhere; figures: unlit, overshade, needed, evaluated, read_bytes, lost_irradiance)"),
        std::string::npos)
        << text << ": " << message;
  }
}

}  // namespace
}  // namespace clusterbench::config
