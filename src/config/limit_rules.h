#pragma once
// Budgets that fail a run: "frame_us.max > 200". report/limits.h holds results against them.

#include <span>
#include <string>
#include <vector>

namespace clusterbench::config {

// A figure of a case that a budget can be about.
struct LimitFigure {
  const char* name;
  const char* meaning;
};
std::span<const LimitFigure> limit_figures();

struct LimitRule {
  std::string figure;         // one of limit_figures()
  bool is_inclusive = false;  // ">="
  double limit = 0.0;

  bool is_broken_by(double value) const { return is_inclusive ? value >= limit : value > limit; }
  // Not broken, and less than a tenth below.
  bool is_near(double value) const { return !is_broken_by(value) && limit > 0.0 && value > 0.9 * limit; }
};

// Throws Error with file and location; an unknown figure is answered with the list of all.
LimitRule limit_rule(const std::string& text, const std::string& file, const std::string& where);

}  // namespace clusterbench::config
