#pragma once
// Changes of times between two results: of rounds side by side, or of the medians of separate runs.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measure/statistics/time_change.h"
#include "report/comparing/matched_cases.h"
#include "result/rounding.h"

namespace clusterbench::report {

// Both have a frame time, which separate runs compare.
bool are_timed(const Match& match);

struct TimeChange {
  measure::Change change;
  std::vector<double> launches;  // log ratios; empty for separate runs
  double base_ns = 0.0, next_ns = 0.0;
};

// The changes of all methods, in the order of their first cases, with p-values by Holm's correction.
class TimeChanges {
 public:
  TimeChanges() = default;
  // `is_paired`: the new result was measured side by side with this base.
  TimeChanges(const std::vector<Match>& matches, bool is_paired);

  // nullopt if the case has no times to compare.
  std::optional<std::size_t> index_of(const Match& match) const;
  const TimeChange& at(std::size_t index) const { return changes_[index]; }
  double corrected_p(std::size_t index) const { return corrected_[index]; }
  std::size_t count() const { return changes_.size(); }

  // Over all methods. A disturbance of a whole launch is in that launch's mean; unknown for separate runs.
  measure::Change mean() const { return measure::change_over_launches(launch_means()); }

 private:
  std::vector<double> launch_means() const;

  bool is_paired_ = false;
  std::map<std::string, std::size_t> indices_;
  std::vector<TimeChange> changes_;
  std::vector<double> corrected_;
};

// `out`: a case, or the summary.
template <class Record>
void add_ratio(Record& out, const measure::Change& change) {
  const measure::Ratio ratio = measure::ratio_of(change);
  out.ratio = result::counted(ratio.ratio);
  out.ci95 = {result::counted(ratio.ci95.low), result::counted(ratio.ci95.high)};
}

}  // namespace clusterbench::report
