#pragma once
// The figures of a case for other tools: those of result/figures/figure_table.h that a result records, under their
// exported names. Names and units are stable.

#include <vector>

#include "measure/statistics/time_statistics.h"
#include "result/case.h"
#include "result/figures/figure_table.h"

namespace clusterbench::report {

std::vector<const result::Figure*> export_figures();

struct Measured {
  const result::Figure* figure;
  double value;
  measure::Interval ci95;  // unknown if there is none
};

// The figures of the case, the headline or all; without absent and null ones.
std::vector<Measured> measured(const result::Case& result_case, bool all);

}  // namespace clusterbench::report
