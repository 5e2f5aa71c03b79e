#pragma once
// The figures of a case that budgets and `recommend` go by, under their names there (config/limit_rules.h).

#include <cstdint>
#include <optional>
#include <string>

#include "report/cases/percent_change.h"
#include "result/case.h"

namespace clusterbench::report {

// Its value, where it is so ("frame 9, cell [8,4,13]"; "" where the case does not tell), and of which samples.
struct Figure {
  Quotient quotient = {};
  std::string location, samples = {};

  double value() const { return quotient.value(); }
};

// Nothing where the case has none: why_no_figure() says why that may be.
std::optional<Figure> case_figure(const result::Case& result_case, const std::string& name);
std::string why_no_figure(const std::string& name);

std::optional<double> limit_figure(const result::Case& result_case, const std::string& name);
std::string limit_figure_location(const result::Case& result_case, const std::string& name);

// In place of the worst frame, where what a search has found is worse than every frame of the path.
inline constexpr std::uint64_t k_found_frame = std::uint64_t{1} << 63;

}  // namespace clusterbench::report
