#pragma once
// Words that what `run` concludes (conclusion.h) and what `recommend` answers (answer_conclusion.h) have in common.

#include <string>
#include <vector>

#include "measure/statistics/time_statistics.h"

namespace clusterbench::report {

std::string ns_text(double ns);        // "3.50 us"
std::string bytes_text(double bytes);  // "232 B", "13.3 MB"

// "2.1 % more", "9.6 % less".
std::string less_or_more(double ratio);
// "10 % more", "2.71 times as much"; in brackets what it can be by times and by prices, where that is known.
std::string more_text(double ratio, const measure::Interval& by_times, const measure::Interval& by_prices);
// What leads those that cost no more than is told from the choice.
std::string alike_title(bool is_modelled, bool is_timed);

// "Its samples (visible surfaces)".
std::string samples_text(const std::vector<std::string>& sets);
// Of samples that need few lights. "" where they need enough.
std::string few_samples_text(double needed, const std::vector<std::string>& sets);
// What shades surfaces in place of points at random depths.
std::string remedy_text(bool has_no_triangles);

}  // namespace clusterbench::report
