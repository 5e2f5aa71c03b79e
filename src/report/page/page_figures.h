#pragma once
// The figures of cases (result/figures/figure_table.h), with their words, for the page.

#include <vector>

#include "result/documents/page.h"

namespace clusterbench::report {

// One for each row of the table.
std::vector<result::FigureWords> figure_words();

// One for each case of the result. Figures have the digits of a result.
std::vector<result::PageCase> page_cases(const result::Result& result);

}  // namespace clusterbench::report
