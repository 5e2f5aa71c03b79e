#pragma once
// The generalised Pareto distribution of excesses above a high threshold, fitted to whole numbers. A whole number y >=
// 1 stands for an excess in (y - 1, y], so ties and small counts are handled, and the likelihood is bounded for every
// shape. Sources: Pickands 1975; Grimshaw 1993 for the search along shape / scale; Hitz, Davis and Samorodnitsky 2017
// for whole numbers.

#include <cstdint>
#include <span>
#include <vector>

namespace clusterbench::measure {

// P(excess > y) = (1 + shape y / scale)^(-1 / shape), written as exp(-rate ln(1 + bend y) / bend) with
// rate = 1 / scale and bend = shape / scale: smooth where the shape is 0, the exponential distribution.
struct GeneralisedPareto {
  double bend = 0.0;  // below 0: no excess is above -1 / bend
  double rate = 1.0;  // above 0

  double shape() const { return bend / rate; }
  double scale() const { return 1.0 / rate; }
  double log_survival(double excess) const;    // ln P(excess > y), -infinity beyond the end
  double quantile(double log_survival) const;  // the excess that is exceeded with this probability
};

struct Excess {
  std::uint64_t value = 1;  // at least 1
  std::uint64_t count = 1;  // number of excesses with this value
};

// Shapes outside of this range are not considered: steeper than uniform at the end, or without a mean.
inline constexpr double k_least_shape = -1.0, k_largest_shape = 1.0;

class ParetoFit {
 public:
  // Maximum likelihood. Needs at least two different excesses; the time is proportional to the number of different
  // values.
  explicit ParetoFit(std::vector<Excess> excesses);

  const GeneralisedPareto& best() const { return best_; }

  struct LogRange {
    double low = 0.0, high = 0.0;
  };
  // The 95 % profile-likelihood interval of ln(r P(excess > y)), where r is the true rate of excesses divided by the
  // counted one. -infinity for a probability of 0. `independent`: the effective number of independent excesses, to
  // which the log-likelihood is scaled (Chandler and Bate 2007). `counted`: the number of counted events in the
  // likelihood of r, Poisson.
  LogRange log_survival_range(double excess, double independent, double counted) const;

 private:
  struct AtBend;  // the likelihood of rates for one bend
  double bend_at(double along) const;
  template <class Value>
  double largest(const Value& value, int steps) const;

  std::vector<Excess> excesses_;
  double top_ = 0.0;     // lower bound of the end of the distribution
  double middle_ = 1.0;  // median of the excesses
  double count_ = 0.0;
  double along_ = 0.0, log_likelihood_ = 0.0;
  GeneralisedPareto best_;
};

}  // namespace clusterbench::measure
