#pragma once
// The probability that a frame needs more than a capacity that no recorded frame exceeded: peaks over a threshold,
// after Pickands 1975 and Davison and Smith 1990. Valid for frames similar to the recorded ones: similar places, not a
// room that no path has entered.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "measure/statistics/exceedance_clusters.h"
#include "measure/statistics/generalised_pareto.h"
#include "measure/statistics/time_statistics.h"

namespace clusterbench::measure {

// With fewer separate peaks there is no estimate: at 20 the interval already spans a factor of ten or more.
inline constexpr std::uint64_t k_least_peaks = 20;
// A fit is good if at least this share of samples drawn from it fit worse.
inline constexpr double k_least_fit_p = 0.1;

// A share with its 95 % interval: of frames, or peaks per frame. 0: "never".
struct Chance {
  double estimate = 0.0;
  Interval ci95;
};

class Tail {
 public:
  std::uint64_t frames = 0;  // recorded frames
  std::uint64_t threshold = 0;
  std::uint64_t frames_above = 0;  // above the threshold; an upper bound if an entry stands for several frames
  std::uint64_t peaks = 0;         // clusters of frames above the threshold
  std::uint64_t cut_peaks = 0;     // of these: the maximum is at an end of their path
  double extremal_index = 1.0;     // see Clusters
  std::uint64_t unit = 1;          // needs are multiples of this
  std::uint64_t highest = 0;       // the largest need recorded
  double shape = 0.0;              // below 0: needs have a maximum
  double scale = 0.0;              // in units of the need
  std::optional<double> end;       // fitted upper limit of needs; none for a shape of 0 or more
  double fit_p = 0.0;              // Anderson-Darling against samples drawn from the fit
  bool fits = false;  // fit_p >= k_least_fit_p and shape >= -0.5. If false, no threshold gave a good fit and this is
                      // the best one
  bool has_merged_frames = false;  // entries stand for several frames: probabilities are upper bounds

  // The probability that a frame needs more than the capacity: the share of frames above the threshold (peaks per frame
  // x frames per peak) times the fitted probability of the excess. Below the threshold: the recorded share. Such frames
  // are clustered in peaks, with many frames without any between them.
  Chance chance_above(std::uint64_t capacity) const;

  struct Capacity {
    std::uint64_t estimate = 0;
    std::optional<std::uint64_t> upper;  // with 97.5 % confidence sufficient; none if no 64-bit number is
  };
  // The smallest capacity that a frame exceeds with at most this probability, in (0, 1).
  Capacity capacity_for(double chance_per_frame) const;

 private:
  friend struct TailMaker;
  double excess_of(std::uint64_t capacity) const;
  double share_above(std::uint64_t capacity) const;
  double estimate_above(std::uint64_t capacity) const;

  std::vector<std::pair<std::uint64_t, std::uint64_t>> recorded_;  // need, frames that need it; rising
  std::uint64_t step_ = 1;                                         // of the fitted excesses: a multiple of the unit
  double counted_peaks_ = 0.0;  // number of equally long peaks with the same information on the frames above
  std::optional<ParetoFit> fit_;
};

struct TailEstimate {
  std::optional<Tail> tail;
  std::string refusal;  // why there is no estimate, one sentence; empty with a tail
};

// The threshold is the lowest of the quantiles 0.7, 0.75, 0.8, 0.85, 0.9, 0.925, 0.95, 0.975 and 0.99 of all frames
// that has k_least_peaks complete peaks and a good fit. Without a good fit: the threshold with the largest fit_p. All
// figures are rounded to four digits, so they do not depend on the compiler; equal needs give equal estimates.
TailEstimate tail_of(std::span<const PathNeeds> paths);

}  // namespace clusterbench::measure
