#pragma once
// How likely a frame needs more than a capacity that no recorded frame needed: peaks over a threshold, after Pickands
// 1975 and Davison and Smith 1990. It holds for frames of the same kind as those recorded: other places that are like
// these, not a room that no path has been in.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "measure/statistics/exceedance_clusters.h"
#include "measure/statistics/generalised_pareto.h"
#include "measure/statistics/time_statistics.h"

namespace clusterbench::measure {

// Fewer separate peaks give no estimate: of 20 the interval already spans a factor of ten or more.
inline constexpr std::uint64_t k_least_peaks = 20;
// The fit is called good if at least this share of samples drawn from it fit themselves worse.
inline constexpr double k_least_fit_p = 0.1;

// A share, with its 95 % interval: of frames, or peaks per frame. 0: "never".
struct Chance {
  double estimate = 0.0;
  Interval ci95;
};

class Tail {
 public:
  std::uint64_t frames = 0;  // all that were recorded
  std::uint64_t threshold = 0;
  std::uint64_t frames_above = 0;  // the threshold; at most, where an entry stands for several frames
  std::uint64_t peaks = 0;         // clusters of frames above the threshold
  std::uint64_t cut_peaks = 0;     // of these: highest at an end of their path
  double extremal_index = 1.0;     // see Clusters
  std::uint64_t unit = 1;          // needs come in steps of so many
  std::uint64_t highest = 0;       // the largest need recorded
  double shape = 0.0;              // below 0: needs have an end
  double scale = 0.0;              // in units of the need
  std::optional<double> end;       // no need is above, as far as the fit says; none for a shape of 0 or more
  double fit_p = 0.0;              // Anderson-Darling against samples drawn from the fit
  bool fits =
      false;  // fit_p >= k_least_fit_p and shape >= -0.5. If not, no threshold gave a good fit; this one's is best
  bool has_merged_frames = false;  // entries stand for several frames: chances are upper bounds

  // That a frame needs more than the capacity: the share of frames above the threshold, which is peaks per frame x
  // frames per peak, times the fitted chance to be as far above. Below the threshold the recorded share. Such frames
  // come in peaks, so that many frames have none and then some have it together.
  Chance chance_above(std::uint64_t capacity) const;

  struct Capacity {
    std::uint64_t estimate = 0;
    std::optional<std::uint64_t> upper;  // with 97.5 % confidence enough; none if no 64-bit number is known to be
  };
  // The least that a frame exceeds with at most this chance, in (0, 1).
  Capacity capacity_for(double chance_per_frame) const;

 private:
  friend struct TailMaker;
  double excess_of(std::uint64_t capacity) const;
  double share_above(std::uint64_t capacity) const;
  double estimate_above(std::uint64_t capacity) const;

  std::vector<std::pair<std::uint64_t, std::uint64_t>> recorded_;  // need, frames that need it; rising
  std::uint64_t step_ = 1;                                         // of the excesses that were fitted: some units
  double counted_peaks_ = 0.0;  // as many peaks of equal length would give the frames above so precisely
  std::optional<ParetoFit> fit_;
};

struct TailEstimate {
  std::optional<Tail> tail;
  std::string refusal;  // why there is none, one sentence for people; empty with a tail
};

// The threshold is the lowest of the quantiles 0.7, 0.75, 0.8, 0.85, 0.9, 0.925, 0.95, 0.975 and 0.99 of all
// frames where there are k_least_peaks peaks that are not cut off and the fit is good. Without a good one that with the
// largest fit_p. All figures are rounded to four digits, so they do not depend on a compiler; the same needs give the
// same estimate.
TailEstimate tail_of(std::span<const PathNeeds> paths);

}  // namespace clusterbench::measure
