#include "report/exports/metrics.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace clusterbench::report {
namespace {

using result::Case;
using result::Figure;

// A quotient with the divisor 0 is not a figure.
std::optional<double> exported_value(const Figure& figure, double value) {
  if (figure.dividend == 0.0) return value;
  return value > 0.0 ? std::optional(figure.dividend / value) : std::nullopt;
}

std::optional<Measured> measured_figure(const Case& result_case, const Figure& figure) {
  const std::optional<double> found = figure.recorded(result_case);
  if (!found) return {};
  const std::optional<double> value = exported_value(figure, *found);
  if (!value) return {};
  Measured out{&figure, *value, {}};
  const result::Interval* ends = figure.interval == nullptr ? nullptr : figure.interval(result_case);
  if (ends == nullptr || !std::isfinite((*ends)[0]) || !std::isfinite((*ends)[1])) return out;
  const double a = exported_value(figure, (*ends)[0]).value_or(*value),
               b = exported_value(figure, (*ends)[1]).value_or(*value);
  out.ci95 = {std::min(a, b), std::max(a, b)};
  return out;
}

}  // namespace

std::vector<const Figure*> export_figures() {
  std::vector<const Figure*> out;
  for (const Figure& figure : result::figures())
    if (figure.is_exported()) out.push_back(&figure);
  return out;
}

std::vector<Measured> measured(const Case& result_case, bool all) {
  std::vector<Measured> out;
  for (const Figure* figure : export_figures())
    if (figure->is_headline || figure->is_of_device || all)
      if (const std::optional<Measured> found = measured_figure(result_case, *figure)) out.push_back(*found);
  return out;
}

}  // namespace clusterbench::report
