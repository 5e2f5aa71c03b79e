#include "report/cases/case_sides.h"

#include <cmath>

#include "report/cases/columns.h"

namespace clusterbench::report {

std::string against_other(const std::optional<double>& saved) {
  if (!saved || !std::isfinite(*saved)) return "-";
  return text("%+.1f %%", *saved == 0.0 ? 0.0 : -100.0 * *saved);
}

std::string evaluated_against_other(const result::Saved& saved) {
  return saved.evaluated.empty() ? "-" : against_other(saved.evaluated.front().second);
}

}  // namespace clusterbench::report
