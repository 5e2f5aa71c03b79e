#include "report/comparing/time_changes.h"

#include <algorithm>
#include <cmath>

#include "report/cases/json_values.h"
#include "result/at.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::Case;
using result::Timing;

// The compared time of separate runs: the frame time, or the work of the device that the method runs on. Null: not
// timed.
const result::Time* compared_time(const Case& result_case) {
  if (result_case.timing) return &result_case.timing->frame_ns;
  return result_case.device ? &result_case.device->run_ns : nullptr;
}

// Identifies a method: its storages share the assignment time, except for a method's own structure. In separate runs
// each case has its own frame time.
std::string time_key(const Match& match, bool is_paired) {
  const Case& result_case = match.next;
  if (!is_paired) return result_case.id;
  Json key{result_case.scene, result_case.camera, result_case.viewport, result::to_json(result_case.grid),
           result_case.assigner.label};
  if (result_case.precision) key.push_back(result_case.precision->label);
  if (result_case.pre_cull) key.push_back(result_case.pre_cull->label);
  key.push_back(result_case.storage == run::k_own_structure);
  return key.dump();
}

TimeChange paired_change(const result::BaselineTimes& paired) {
  TimeChange out;
  for (const result::BaselineLaunch& launch : paired.launches)
    out.launches.push_back(measure::launch_log_ratio(launch.base_ns, launch.new_ns));
  out.change = measure::change_over_launches(out.launches);
  out.base_ns = paired.base_ns;
  out.next_ns = paired.new_ns;
  return out;
}

// Without an interval there is no conclusion, as without samples.
measure::MedianTime median_time(const Case& result_case) {
  const result::Time& time = *compared_time(result_case);
  const double low = time.ci95[0], high = time.ci95[1];
  if (!std::isfinite(low) || !std::isfinite(high)) return {time.median, {}, 0, 1};
  const std::uint64_t launches =
      (result_case.timing ? result_case.timing->launches : result_case.device->launches).value_or(1);
  return {time.median, {low, high}, time.samples.size(), static_cast<int>(launches)};
}

std::optional<TimeChange> time_change(const Match& match, bool is_paired) {
  if (is_paired) {
    const auto* paired = result::part<&Case::timing, &Timing::baseline>(match.next);
    const bool is_known = paired != nullptr && std::isfinite(paired->ratio) && std::isfinite(paired->base_ns) &&
                          std::isfinite(paired->new_ns);
    return is_known ? std::optional(paired_change(*paired)) : std::nullopt;
  }
  if (!are_timed(match)) return std::nullopt;
  const measure::MedianTime base = median_time(match.base), next = median_time(match.next);
  if (!(base.ns > 0.0) || !(next.ns > 0.0)) return std::nullopt;
  if (are_same(*compared_time(match.base), *compared_time(match.next)))
    return TimeChange{{0.0, 0.0, measure::k_least_freedom}, {}, base.ns, next.ns};  // one measurement, twice
  return TimeChange{measure::change_of_medians(base, next), {}, base.ns, next.ns};
}

}  // namespace

bool are_timed(const Match& match) {
  const result::Time *base = compared_time(match.base), *next = compared_time(match.next);
  const auto device_of = [](const Case& one) {  // with its caches
    return one.device ? one.device->device + ", " + one.device->caches.value_or("") : std::string();
  };
  return device_of(match.base) == device_of(match.next) && base != nullptr && next != nullptr &&
         std::isfinite(base->median) && std::isfinite(next->median);
}

TimeChanges::TimeChanges(const std::vector<Match>& matches, bool is_paired) : is_paired_(is_paired) {
  for (const Match& match : matches) {
    const std::string key = time_key(match, is_paired);
    if (indices_.contains(key)) continue;
    if (const std::optional<TimeChange> change = time_change(match, is_paired)) {
      indices_[key] = changes_.size();
      changes_.push_back(*change);
    }
  }
  std::vector<double> p;
  for (const TimeChange& change : changes_) p.push_back(measure::p_value(change.change));
  corrected_ = measure::holm(p);
}

std::optional<std::size_t> TimeChanges::index_of(const Match& match) const {
  const auto found = indices_.find(time_key(match, is_paired_));
  return found == indices_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<double> TimeChanges::launch_means() const {
  if (changes_.empty()) return {};
  std::size_t least = changes_.front().launches.size();  // additional launches measured only some methods
  for (const TimeChange& change : changes_) least = std::min(least, change.launches.size());
  std::vector<double> means(least, 0.0);
  for (const TimeChange& change : changes_)
    for (std::size_t i = 0; i < means.size(); ++i) means[i] += change.launches[i] / static_cast<double>(count());
  return means;
}

}  // namespace clusterbench::report
