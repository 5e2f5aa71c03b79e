#pragma once
// Whether a time has changed between two programs: estimates on the logarithm of new / base, trimmed means, Student's
// t, Holm's correction over cases. docs/comparing.md says why it is done so. Pure functions.

#include <span>
#include <vector>

#include "measure/statistics/time_statistics.h"

namespace clusterbench::measure {

// With fewer degrees of freedom nothing is concluded, and no interval is told: that of two values is Student's 12.7
// errors wide on either side, which says nothing.
inline constexpr double k_least_freedom = 2.0;

// ln(new / base) with its standard error and the degrees of freedom behind that.
struct Change {
  double log_ratio = 0.0;
  double error = 0.0;
  double freedom = 0.0;

  bool is_known() const { return freedom >= k_least_freedom; }
};

// ln of the ratio of both lower quartiles, of the rounds of one pair of processes: whatever disturbs a round makes it
// longer. Neither span is empty.
double launch_log_ratio(std::span<const double> base_ns, std::span<const double> next_ns);

// From one value per pair of processes: what differs between starts of the same program (memory layout) is in the
// error. Of five and more the mean without the lowest and the highest fifth, with the error that Tukey and McLaughlin
// 1963 give it: a launch that fell into a busy second says nothing of the program.
Change change_over_launches(std::span<const double> log_ratios);

struct MedianTime {
  double ns = 0.0;
  Interval ci95;
  std::size_t samples = 0;
  int launches = 1;  // that the interval is between, as time_stats() has it
};
// From two separate runs. Knows nothing of what differs between the runs themselves.
Change change_of_medians(const MedianTime& base, const MedianTime& next);

// new / base with its 95 % interval, which is unknown without freedom.
Ratio ratio_of(const Change& change);

// Half of the 95 % interval of ln(new / base): 0.01 for about one percent on either side. Infinite without freedom.
double half_width(const Change& change);

// How likely at least this change is, in either direction, where there is none. 1 without freedom.
double p_value(const Change& change);

// Holm 1979: p-values corrected for being several, in their order.
std::vector<double> holm(std::span<const double> p_values);

enum class Verdict { faster, slower, same, inconclusive };
const char* name_of(Verdict verdict);

// `corrected_p`: from holm(). `threshold`: the smallest change that matters, 0.02 for 2 %.
// slower, faster: the change is beyond chance (corrected_p < 0.05) and the estimate beyond the threshold.
// same: the 95 % interval lies within the threshold on both sides. All else is inconclusive.
Verdict verdict_on(const Change& change, double corrected_p, double threshold);

// P(|T| >= t) of Student's t distribution.
double student_two_sided(double t, double freedom);
// The t that |T| exceeds with probability p.
double student_quantile(double p, double freedom);

}  // namespace clusterbench::measure
