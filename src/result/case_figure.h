#pragma once
// A figure (figure_table.h) of a case or of the cases of several cameras, by its name; "opaque.unlit" asks one set of
// samples.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "result/figure_table.h"

namespace clusterbench::result {

// "opaque.unlit" in its parts; the set is "" where none is named.
struct FigureAtSamples {
  std::string set, figure;
};
FigureAtSamples figure_at_samples(const std::string& name);
bool is_at_samples(const std::string& name);  // of one set or of those that rank

// The row of a name, which may name a set; null: there is no such figure, or it is not one of samples.
const Figure* figure_named(const std::string& name);

// A number as it was counted: a share of two counts, or a number by 1.
struct Quotient {
  double numerator = 0.0, denominator = 1.0;  // finite; the second above 0

  double value() const { return numerator / denominator; }
};

// Its value under its name, and where that is ("frame 9, cell [8,4,13]"; "" where the case does not tell).
struct FigureValue {
  Quotient quotient = {};
  std::string location = {};
  std::string samples = {};  // the names of the sets; "" where it is not one of samples

  double value() const { return quotient.value(); }
};
// Nothing where the case has none: why_no_figure() says why that may be.
std::optional<FigureValue> figure_value(const Case& result_case, const std::string& name);
std::optional<double> figure_of(const Case& result_case, const std::string& name);
std::string why_no_figure(const std::string& name);

// Of one case per camera. Nothing where a camera lacks it; but one that sees no surface has no samples, and no part in
// figures of samples.
std::optional<double> figure_over(std::span<const Case> cases, const std::string& name);

// In place of the worst frame, where a search has found a worse one than every frame of the path.
inline constexpr std::uint64_t k_found_frame = std::uint64_t{1} << 63;

}  // namespace clusterbench::result
