#pragma once
// Budgets that fail a run: "frame_us.max > 200", "lights_in_view 200..300", "exact-fast: longest > +5 %",
// "opaque.unlit > 0".
// report/gates/limits.h holds results against them.

#include <span>
#include <string>
#include <vector>

namespace clusterbench::config {

// A figure of a case that a budget can be about.
struct LimitFigure {
  const char* name;
  const char* meaning;
  bool is_choosable = true;    // `recommend` can choose grids, methods and structures by it
  bool is_timed = false;       // rests on times, so that two runs of one program differ in it
  bool is_at_samples = false;  // can be asked of one set of samples: "opaque.unlit"
};
std::span<const LimitFigure> limit_figures();

// "opaque.unlit" in its parts; the set is "" where none is named.
struct FigureAtSamples {
  std::string set, figure;
};
FigureAtSamples figure_at_samples(const std::string& name);
bool is_at_samples(const std::string& name);  // of one set or of those that rank

// A budget says what fails.
struct LimitRule {
  enum class Side {
    above,   // > or >=
    below,   // < or <=
    equal,   // ==
    outside  // of limit..upper
  };

  std::string figure;         // one of limit_figures(), or of one set of samples: "opaque.unlit"
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
