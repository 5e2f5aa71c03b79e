#pragma once
// Budgets that fail a run: "frame_us.max > 200", "lights_in_view 200..300", "exact-fast: longest > +5 %", "opaque.unlit
// > 0". report/gates/limits.h compares results with them.

#include <string>

namespace clusterbench::config {

// A budget states the condition of a failure.
struct LimitRule {
  enum class Side {
    above,   // > or >=
    below,   // < or <=
    equal,   // ==
    outside  // of the range limit..upper
  };

  std::string figure;         // result/figures/case_figure.h: "longest", "opaque.unlit"
  bool is_inclusive = false;  // ">=" and "<="
  double limit = 0.0;
  Side side = Side::above;
  double upper = 0.0;        // of Side::outside
  bool is_relative = false;  // numbers are changes against a baseline in percent
  std::string cases = {};    // a regular expression that must match a part of a case's name; "": all cases

  bool is_broken_by(double value) const;
  // Whether a value within the budget is less than a tenth of the limit away. Always false for ==, ranges and a limit
  // of 0.
  bool is_near(double value) const;
  // As written: "exact-fast: longest > +5 %".
  std::string text() const;
};

// Throws Error with file and location; the message for an unknown figure lists all figures.
LimitRule limit_rule(const std::string& text, const std::string& file, const std::string& where);

// Counts without decimals; others with up to seven digits.
std::string budget_number(double value);

}  // namespace clusterbench::config
