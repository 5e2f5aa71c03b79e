#pragma once
// Budgets that fail a run: "frame_us.max > 200", "lights_in_view 200..300", "exact-fast: longest > +5 %",
// "opaque.unlit > 0".
// report/gates/limits.h holds results against them.

#include <string>

namespace clusterbench::config {

// A budget says what fails.
struct LimitRule {
  enum class Side {
    above,   // > or >=
    below,   // < or <=
    equal,   // ==
    outside  // of limit..upper
  };

  std::string figure;         // result/case_figure.h: "longest", "opaque.unlit"
  bool is_inclusive = false;  // ">=" and "<="
  double limit = 0.0;
  Side side = Side::above;
  double upper = 0.0;        // of Side::outside
  bool is_relative = false;  // numbers are changes against a baseline in percent
  std::string cases = {};    // a regular expression that a part of a case's name has to match; "": all cases

  bool is_broken_by(double value) const;
  // Of a value that does not break it: less than a tenth of the limit away. Not of ==, of ranges and of a limit of 0.
  bool is_near(double value) const;
  // As it was written: "exact-fast: longest > +5 %".
  std::string text() const;
};

// Throws Error with file and location; an unknown figure is answered with the list of all.
LimitRule limit_rule(const std::string& text, const std::string& file, const std::string& where);

// A count without digits behind the point, else up to seven digits.
std::string budget_number(double value);

}  // namespace clusterbench::config
