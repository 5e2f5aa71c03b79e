// Budgets in percent at their own boundaries, against whole numbers and fractions of them.

#include "report/cases/percent_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace clusterbench::report {
namespace {

using config::LimitRule;

bool breaks(const std::string& budget, double then, double now) {
  return is_broken_by_change(config::limit_rule("lights " + budget, "", "--fail-if"), {then}, {now});
}

// What stands at the boundary, by hand: `now` is `then` changed by `percent` exactly.
struct Row {
  double then, now;
  const char* percent;
};
constexpr Row k_rows[] = {
    {10, 11, "+10 %"},         {50, 45, "-10 %"},  {100, 107, "+7 %"},  {100, 93, "-7 %"},      {1000, 1029, "+2.9 %"},
    {300, 309, "+3 %"},        {700, 721, "+3 %"}, {100, 103, "+3 %"},  {200, 206, "+3 %"},     {10, 7, "-30 %"},
    {110, 121, "+10 %"},       {90, 63, "-30 %"},  {100, 129, "+29 %"}, {1000, 1001, "+0.1 %"}, {3, 6, "+100 %"},
    {8, 9, "+12.5 %"},         {7, 0, "-100 %"},   {0, 0, "+0 %"},      {5, 5, "0 %"},          {1e15, 1.03e15, "+3 %"},
    {1e6, 1e6 + 1, "+1e-4 %"},
};

TEST(PercentChanges, at_the_boundary_itself_are_neither_more_nor_less) {
  for (const Row& row : k_rows) {
    const std::string percent = row.percent;
    const auto broken = [&](const std::string& sign) { return breaks(sign + percent, row.then, row.now); };
    EXPECT_FALSE(broken("> ")) << row.then << " to " << row.now << ": " << percent;
    EXPECT_FALSE(broken("< ")) << row.then << " to " << row.now << ": " << percent;
    EXPECT_TRUE(broken(">= ")) << row.then << " to " << row.now << ": " << percent;
    EXPECT_TRUE(broken("<= ")) << row.then << " to " << row.now << ": " << percent;
    EXPECT_TRUE(broken("== ")) << row.then << " to " << row.now << ": " << percent;
    EXPECT_FALSE(breaks(percent + "..+900 %", row.then, row.now)) << row.then << " to " << row.now;
    EXPECT_FALSE(breaks("-100 %.." + percent, row.then, row.now)) << row.then << " to " << row.now;
  }
}

// -1, 0, 1 by whole numbers alone: 1000 * now against then * (1000 + tenths of a percent).
int compared_in_whole_numbers(std::int64_t then, std::int64_t now, std::int64_t tenths) {
  const std::int64_t difference = 1000 * now - then * (1000 + tenths);
  return difference < 0 ? -1 : difference > 0 ? 1 : 0;
}

std::string tenths_text(std::int64_t tenths) {
  const std::int64_t size = tenths < 0 ? -tenths : tenths;
  return (tenths < 0 ? "-" : "+") + std::to_string(size / 10) + "." + std::to_string(size % 10) + " %";
}

TEST(PercentChanges, are_those_of_whole_numbers_for_all_small_ones) {
  for (const std::int64_t tenths : {-1000, -301, -300, -100, -29, -1, 0, 1, 25, 29, 30, 70, 100, 125, 333, 529, 1000})
    for (std::int64_t then = 1; then <= 60; ++then) {
      const std::int64_t nearest = then * (1000 + tenths) / 1000;
      for (std::int64_t now = std::max<std::int64_t>(0, nearest - 1); now <= nearest + 1; ++now) {
        const int order = compared_in_whole_numbers(then, now, tenths);
        const auto broken = [&](const char* sign) {
          return breaks(sign + tenths_text(tenths), static_cast<double>(then), static_cast<double>(now));
        };
        EXPECT_EQ(broken("> "), order > 0) << then << " to " << now << tenths_text(tenths);
        EXPECT_EQ(broken(">= "), order >= 0) << then << " to " << now << tenths_text(tenths);
        EXPECT_EQ(broken("< "), order < 0) << then << " to " << now << tenths_text(tenths);
        EXPECT_EQ(broken("<= "), order <= 0) << then << " to " << now << tenths_text(tenths);
        EXPECT_EQ(broken("== "), order == 0) << then << " to " << now << tenths_text(tenths);
      }
    }
}

TEST(PercentChanges, of_shares_are_of_what_was_counted) {
  const LimitRule rule = config::limit_rule("unlit > +10 %", "", "--fail-if");
  EXPECT_FALSE(is_broken_by_change(rule, {30, 1000}, {33, 1000}));
  EXPECT_FALSE(is_broken_by_change(rule, {1, 3}, {11, 30})) << "a third and a tenth of it, in no double";
  EXPECT_TRUE(is_broken_by_change(rule, {1, 3}, {110001, 300000}));
}

TEST(PercentChanges, from_nothing_to_anything_are_above_every_budget) {
  EXPECT_TRUE(breaks("> +1000 %", 0, 1));
  EXPECT_TRUE(breaks("-3..+3 %", 0, 1));
  EXPECT_FALSE(breaks("< -10 %", 0, 1));
  EXPECT_FALSE(breaks(">= +5 %", 0, 0));
  EXPECT_FALSE(breaks("<= -5 %", 0, 0));
  EXPECT_EQ(percent_change({0}, {0}), 0.0);
  EXPECT_EQ(percent_change({100}, {103}), 3.0);
  EXPECT_TRUE(std::isinf(percent_change({0}, {1})));
}

}  // namespace
}  // namespace clusterbench::report
