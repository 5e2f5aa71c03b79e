#pragma once
// Changes in percent, compared exactly. In floating point 100 * (103 / 100 - 1) is more than 3, so a budget of +3 %
// would fail at its own boundary.

#include <string>

#include "config/limit_rules.h"
#include "result/figures/case_figure.h"

namespace clusterbench::report {

using result::Quotient;

// For display, in percent: infinite from 0 to more; 0 if both are 0.
double percent_change(const Quotient& then, const Quotient& now);

// "+5.1 %", with three digits, or as many as needed to show whether it is above or below `beside`: "-10.03 %" beside
// -10.
std::string percent_text(double percent, double beside);

// Whether the change breaks a budget in percent, whose numbers are the decimals as written.
bool is_broken_by_change(const config::LimitRule& rule, const Quotient& then, const Quotient& now);

}  // namespace clusterbench::report
