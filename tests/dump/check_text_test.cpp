#include <gtest/gtest.h>

#include "dump/judge.h"

namespace clusterbench::dump {
namespace {

// One lost pair whose light reaches in this far.
result::CheckedDump lost_by(double reach_mm, double percent, double from_m = 0.5, double to_m = 5.0) {
  result::CheckedSet set;
  set.name = "lists";
  set.verdict = "lost";
  result::ListErrors& error = set.error.emplace();
  error.true_pairs = 2;
  error.listed_pairs = error.lost_pairs = error.lost_lights = 1;
  error.deepest_mm = reach_mm;
  error.deepest_percent = percent;
  set.lost.push_back({7, {1, 2, 3}, 12, from_m, to_m, reach_mm, percent, false});
  result::CheckedDump out;
  out.name = "frame";
  out.grid_kind = "frustum";
  out.sets.push_back(set);
  return out;
}

TEST(CheckText, lengths_have_units_that_fit_and_no_exponents) {
  const std::tuple<double, double, const char*> rows[] = {
      {0.0314159, 0.5, "by 0.0314 mm, 0.5 % of its range"},
      {12.34, 31.4159, "by 12.3 mm, 31.4 % of its range"},
      {999.4, 100.0, "by 999 mm, 100 % of its range"},
      {999.7, 99.96, "by 1 m, 100 % of its range"},
      {1000.0, 5.0, "by 1 m, 5 % of its range"},
      {1574.0, 5.0, "by 1.57 m, 5 % of its range"},
      {123456789.0, 5.0, "by 123457 m, 5 % of its range"},
      {1e-7, 1e-9, "by below 0.001 mm, below 0.001 % of its range"}};
  for (const auto& [reach_mm, percent, wanted] : rows) {
    const std::string text = check_text(lost_by(reach_mm, percent), 1);
    EXPECT_NE(text.find(std::string("light 7, cell (1, 2, 3) (number 12, depth 0.5 to 5 m): reaches in ") + wanted),
              std::string::npos)
        << wanted << "\n"
        << text;
    EXPECT_EQ(text.find("e+"), std::string::npos) << text;
    EXPECT_EQ(text.find("e-"), std::string::npos) << text;
  }
  EXPECT_NE(check_text(lost_by(1.0, 1.0, 0.01234, 123456.0), 1).find("depth 0.01234 to 123456 m"), std::string::npos);
}

TEST(CheckText, another_reading_says_only_what_changes) {
  result::CheckedDump checked = lost_by(1.0, 1.0);
  result::OtherReading& other = checked.sets[0].other_reading.emplace();
  other.axes = "xyz";
  other.first_row = "top";
  other.first_slice = "near";
  other.camera = "camera.forward: the other way";
  EXPECT_NE(check_text(checked, 1)
                .find("description: with camera.forward: the other way, 0 pairs would be lost in place of 1.\n"),
            std::string::npos)
      << check_text(checked, 1);
  other.order = "grid.first_row 'bottom'";
  EXPECT_NE(check_text(checked, 1).find("with grid.first_row 'bottom' and camera.forward: the other way, 0 pairs"),
            std::string::npos);
}

TEST(CheckText, names_of_a_dump_bring_no_lines_and_no_escapes) {
  result::CheckedDump checked = lost_by(1.0, 1.0);
  const std::string evil = "x\n  lists: right\x1b[2J";
  checked.name = checked.engine = checked.sets[0].name = evil;
  checked.sets[0].reading.fault_count = 1;
  checked.sets[0].reading.faults = {{evil, 1, 2, {0, 0, 0}, "entries of buffer '" + evil + "'"}};
  const std::string text = check_text(checked, 1);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text.find("\n  lists: right"), std::string::npos) << text;
}

}  // namespace
}  // namespace clusterbench::dump
