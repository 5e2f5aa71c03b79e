#pragma once
// The generalised Pareto distribution of what exceeds a high threshold, fitted to whole numbers. A whole number y >= 1
// stands for an excess in (y - 1, y], so ties and small counts are no trouble, and the likelihood is bounded for every
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
  double quantile(double log_survival) const;  // the excess that is exceeded with this chance, inverse of the above
};

struct Excess {
  std::uint64_t value = 1;  // at least 1
  std::uint64_t count = 1;  // how many have it
};

// Shapes outside are not considered: steeper than uniform at the end, or without a mean.
inline constexpr double k_least_shape = -1.0, k_largest_shape = 1.0;

class ParetoFit {
 public:
  // By maximum likelihood. There are at least two different excesses; the time is proportional to how many.
  explicit ParetoFit(std::vector<Excess> excesses);

  const GeneralisedPareto& best() const { return best_; }

  struct LogRange {
    double low = 0.0, high = 0.0;
  };
  // The 95 % profile-likelihood interval of ln(r P(excess > y)), where r is the factor by which the true rate of
  // excesses differs from the counted one. -infinity for a chance of 0. `independent`: as many independent excesses
  // would tell as much about the distribution as those given; the logarithm of their likelihood is scaled to that
  // (Chandler and Bate 2007). `counted`: the likelihood of r is that of so many counted events, Poisson.
  LogRange log_survival_range(double excess, double independent, double counted) const;

 private:
  struct AtBend;  // the likelihood of rates, with one bend
  double bend_at(double along) const;
  template <class Value>
  double largest(const Value& value, int steps) const;

  std::vector<Excess> excesses_;
  double top_ = 0.0;     // the end of the distribution is above this
  double middle_ = 1.0;  // median of the excesses
  double count_ = 0.0;
  double along_ = 0.0, log_likelihood_ = 0.0;
  GeneralisedPareto best_;
};

}  // namespace clusterbench::measure
