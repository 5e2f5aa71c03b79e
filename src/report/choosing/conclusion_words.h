#pragma once
// Words shared by the conclusions of `run` (conclusion.h) and the answers of `recommend` (answer_conclusion.h).

#include <string>
#include <vector>

#include "measure/statistics/time_statistics.h"
#include "report/choosing/weighed_cases.h"
#include "result/case.h"

namespace clusterbench::report {

// "frustum 16x9 x 24 exponential/aabb/packed".
std::string case_title(const result::Case& result_case);
std::string ns_text(double ns);        // "3.50 us"
std::string bytes_text(double bytes);  // "232 B", "13.3 MB"

// "2.1 % more", "9.6 % less".
std::string less_or_more(double ratio);
// "10 % more", "2.71 times as much"; in brackets the ranges by times and by prices, if known.
std::string more_text(double ratio, const measure::Interval& by_times, const measure::Interval& by_prices);
// Introduces the cases that do not cost more than the choice for certain.
std::string alike_title(bool is_modelled, bool is_timed);

// "Its samples (visible surfaces)".
std::string samples_text(const std::vector<std::string>& sets);
// A remark on samples that need few lights. "" if they need enough.
std::string few_samples_text(double needed, const std::vector<std::string>& sets);
// A setting that shades surfaces instead of points at random depths.
std::string remedy_text(UnseenSurfaces why);

}  // namespace clusterbench::report
