#pragma once
// A figure (figure_table.h) of a case or of the cases of several cameras, by its name; "opaque.unlit" is that of one
// set of samples.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "result/figures/figure_table.h"

namespace clusterbench::result {

// The parts of "opaque.unlit"; the set is "" if the name has none.
struct FigureAtSamples {
  std::string set, figure;
};
FigureAtSamples figure_at_samples(const std::string& name);
bool is_at_samples(const std::string& name);  // of one set or of the ranking sets

// The row of a name, with or without a set; null: unknown, or no figure of samples.
const Figure* figure_named(const std::string& name);

// A counted number: a share of two counts, or a number divided by 1.
struct Quotient {
  double numerator = 0.0, denominator = 1.0;  // finite; the denominator is above 0

  double value() const { return numerator / denominator; }
};

// The value of a figure, and the place of it ("frame 9, cell [8,4,13]"; "" if unknown).
struct FigureValue {
  Quotient quotient = {};
  std::string location = {};
  std::string samples = {};  // the names of the sets; "" if it is not a figure of samples

  double value() const { return quotient.value(); }
};
// None if the case has no value; why_no_figure() gives possible reasons.
std::optional<FigureValue> figure_value(const Case& result_case, const std::string& name);
std::optional<double> figure_of(const Case& result_case, const std::string& name);
std::string why_no_figure(const std::string& name);

// For one case per camera. None if a camera has no value; but a camera without visible surfaces has no samples, and is
// left out for figures of samples.
std::optional<double> figure_over(std::span<const Case> cases, const std::string& name);

// Marks that a search found a worse frame than every frame of the path.
inline constexpr std::uint64_t k_found_frame = std::uint64_t{1} << 63;

}  // namespace clusterbench::result
