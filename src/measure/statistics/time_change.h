#pragma once
// Decides whether a time changed between two programs: estimates on the logarithm of new / base, trimmed means,
// Student's t, Holm's correction over cases. docs/comparing.md gives the reasons. Pure functions.

#include <span>
#include <vector>

#include "measure/statistics/time_statistics.h"

namespace clusterbench::measure {

// With fewer degrees of freedom there is no conclusion and no interval: for two values Student's interval is 12.7
// errors wide on either side, which is useless.
inline constexpr double k_least_freedom = 2.0;

// ln(new / base) with its standard error and degrees of freedom.
struct Change {
  double log_ratio = 0.0;
  double error = 0.0;
  double freedom = 0.0;

  bool is_known() const { return freedom >= k_least_freedom; }
};

// ln of the ratio of the lower quartiles of the rounds of one pair of processes: disturbances only make a round longer,
// so low values are the cleaner ones. Neither span may be empty.
double launch_log_ratio(std::span<const double> base_ns, std::span<const double> next_ns);

// From one value per pair of processes: the error includes differences between starts of the same program (memory
// layout). With five and more, the mean without the lowest and the highest fifth, with its error by Tukey and
// McLaughlin 1963: a launch during a busy second must not change the result.
Change change_over_launches(std::span<const double> log_ratios);

struct MedianTime {
  double ns = 0.0;
  Interval ci95;
  std::size_t samples = 0;
  int launches = 1;  // number of launches behind the interval, as in time_stats()
};
// From two separate runs. The error does not include differences between the runs themselves.
Change change_of_medians(const MedianTime& base, const MedianTime& next);

// new / base with its 95 % interval, which is unknown below k_least_freedom.
Ratio ratio_of(const Change& change);

// Half of the 95 % interval of ln(new / base): 0.01 is about one percent on either side. Infinite below
// k_least_freedom.
double half_width(const Change& change);

// The probability of at least this change, in either direction, without a real change. 1 below k_least_freedom.
double p_value(const Change& change);

// Holm 1979: p-values corrected for multiple tests, in the given order.
std::vector<double> holm(std::span<const double> p_values);

enum class Verdict { faster, slower, same, inconclusive };
const char* name_of(Verdict verdict);

// `corrected_p`: from holm(). `threshold`: the smallest relevant change, 0.02 for 2 %.
// slower, faster: the change is significant (corrected_p < 0.05) and the estimate exceeds the threshold.
// same: the 95 % interval is within the threshold on both sides. Everything else is inconclusive.
Verdict verdict_on(const Change& change, double corrected_p, double threshold);

// P(|T| >= t) of Student's t distribution.
double student_two_sided(double t, double freedom);
// The t that |T| exceeds with probability p.
double student_quantile(double p, double freedom);

}  // namespace clusterbench::measure
