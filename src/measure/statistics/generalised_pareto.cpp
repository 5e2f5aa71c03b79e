#include "measure/statistics/generalised_pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clusterbench::measure {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
// Half of the 95 % quantile of chi squared with one degree of freedom.
constexpr double k_half_chi_squared = 1.920729410347062;

// ln(1 + bend y) / bend.
double bent(double bend, double y) {
  if (bend == 0.0) return y;
  const double inside = bend * y;
  return inside <= -1.0 ? k_infinity : std::log1p(inside) / bend;
}

// The argument of the maximum of a function with one peak in [low, high].
template <class Value>
double golden_section(double low, double high, int steps, const Value& value) {
  constexpr double k_golden = 0.6180339887498949;
  double left = high - k_golden * (high - low), right = low + k_golden * (high - low);
  double at_left = value(left), at_right = value(right);
  for (int i = 0; i < steps; ++i) {
    if (at_left < at_right) {
      low = left, left = right, at_left = at_right;
      right = low + k_golden * (high - low);
      at_right = value(right);
    } else {
      high = right, right = left, at_right = at_left;
      left = high - k_golden * (high - low);
      at_left = value(left);
    }
  }
  return at_left < at_right ? right : left;
}

// x with the given sign and e^x - 1 - x = loss: a Poisson rate that is wrong by the factor e^x has a log-likelihood
// lower by `loss` per count.
double log_factor_of_loss(double loss, double sign) {
  if (!(loss > 0.0)) return 0.0;
  double x = sign * std::sqrt(2.0 * loss);
  for (int i = 0; i < 6; ++i) x -= (std::expm1(x) - x - loss) / std::expm1(x);
  return x;
}

}  // namespace

double GeneralisedPareto::log_survival(double excess) const {
  return -rate * bent(bend, excess);
}

double GeneralisedPareto::quantile(double log_survival) const {
  const double y = -log_survival / rate;
  return bend == 0.0 ? y : std::expm1(bend * y) / bend;
}

// After the transform by `bend` the distribution is exponential, so the log-likelihood is concave in the rate.
struct ParetoFit::AtBend {
  struct Term {
    double count = 0.0, start = 0.0, width = 0.0;  // width 0: the distribution ends within the interval
  };
  double bend = 0.0;
  std::vector<Term> terms;

  AtBend(const std::vector<Excess>& excesses, double bend_in) : bend(bend_in) {
    terms.reserve(excesses.size());
    for (const Excess& excess : excesses) {
      const auto y = static_cast<double>(excess.value);
      const double start = bent(bend, y - 1.0), end = bent(bend, y);
      terms.push_back({static_cast<double>(excess.count), start, end == k_infinity ? 0.0 : end - start});
    }
  }

  double least_rate() const { return bend < 0.0 ? bend / k_least_shape : bend / k_largest_shape; }

  double log_likelihood(double rate) const {
    double sum = 0.0;
    for (const Term& term : terms) {
      double log_term = -rate * term.start;
      if (term.width > 0.0) log_term += std::log(-std::expm1(-rate * term.width));
      sum += term.count * log_term;
    }
    return sum;
  }

  // Newton's method from a rate that is too low: the derivative is convex and falls, so no step overshoots.
  double best_rate() const {
    double count = 0.0, end = 0.0;
    for (const Term& term : terms) {
      if (term.width > 0.0) count += term.count;
      end += term.count * (term.start + term.width);
    }
    double rate = count / end;
    for (int i = 0; i < 60; ++i) {
      double slope = 0.0, curvature = 0.0;
      for (const Term& term : terms) {
        slope -= term.count * term.start;
        if (!(term.width > 0.0)) continue;
        const double grown = std::expm1(rate * term.width), part = term.width / grown;
        slope += term.count * part;
        curvature -= term.count * part * part * (grown + 1.0);
      }
      const double step = -slope / curvature;
      rate += step;
      if (!(step > 1e-13 * rate)) break;
    }
    return std::max(rate, least_rate());
  }
};

namespace {
constexpr int k_grid = 20;
constexpr double k_nearest_end = 1e-4, k_farthest_end = 1e3;
}  // namespace

// Maps 0 .. 2 to bends: 0: the end is just above the largest excess; 1: no end; 2: the heaviest tail considered.
double ParetoFit::bend_at(double along) const {
  const double slightest = 1.0 / (top_ * (1.0 + k_farthest_end));
  if (along < 1.0) {
    const double beyond = k_nearest_end * std::exp(along * std::log(k_farthest_end / k_nearest_end));
    return -1.0 / (top_ * (1.0 + beyond));
  }
  const double most = 20.0 / middle_;
  return slightest * std::expm1((along - 1.0) * std::log1p(most / slightest));
}

// Starts with a grid, since the value may have several peaks.
template <class Value>
double ParetoFit::largest(const Value& value, int steps) const {
  double best = 0.0, best_value = -k_infinity;
  for (int i = 0; i <= k_grid; ++i) {
    const double along = 2.0 * i / k_grid, now = value(along);
    if (now > best_value) best = along, best_value = now;
  }
  const double step = 2.0 / k_grid;
  return golden_section(std::max(0.0, best - step), std::min(2.0, best + step), steps, value);
}

ParetoFit::ParetoFit(std::vector<Excess> excesses) : excesses_(std::move(excesses)) {
  std::ranges::sort(excesses_, {}, &Excess::value);
  std::uint64_t all = 0, below = 0;
  for (const Excess& excess : excesses_) all += excess.count;
  count_ = static_cast<double>(all);
  for (const Excess& excess : excesses_) {
    if (2 * below <= all) middle_ = static_cast<double>(excess.value);
    below += excess.count;
  }
  top_ = static_cast<double>(excesses_.back().value) - 1.0;
  const auto likelihood = [&](double along) {
    const AtBend at(excesses_, bend_at(along));
    return at.log_likelihood(at.best_rate());
  };
  along_ = largest(likelihood, 24);
  log_likelihood_ = likelihood(along_);
  const AtBend at(excesses_, bend_at(along_));
  best_ = {at.bend, at.best_rate()};
}

ParetoFit::LogRange ParetoFit::log_survival_range(double excess, double independent, double counted) const {
  const double share = independent / count_;
  // Outside of the region of likely parameters: the less likely, the lower.
  const auto outside = [](double loss) { return -1e6 * (1.0 + loss); };
  // The maximum of sign ln(r P) for one bend. `sign` 1: upper end, -1: lower end.
  const auto extreme = [&](double along, double sign) {
    const AtBend at(excesses_, bend_at(along));
    const double rate = at.best_rate(), distance = std::min(bent(at.bend, excess), 1e5 / rate);
    const double least_loss = share * (log_likelihood_ - at.log_likelihood(rate));
    if (least_loss > k_half_chi_squared) return outside(least_loss);
    const auto value = [&](double tried) {
      const double loss = share * (log_likelihood_ - at.log_likelihood(tried));
      if (loss > k_half_chi_squared) return outside(loss);
      const double factor = log_factor_of_loss((k_half_chi_squared - loss) / counted, sign);
      return sign * (factor - tried * distance);
    };
    const double low = sign > 0.0 ? std::max(at.least_rate(), 0.2 * rate) : rate, high = sign > 0.0 ? rate : 5.0 * rate;
    return std::max(value(golden_section(low, high, 18, value)), value(rate));
  };
  const auto over_bends = [&](double sign) {
    const auto value = [&](double along) { return extreme(along, sign); };
    const double found = value(largest(value, 14));
    // The likely region can be narrower than the grid.
    const double near = value(golden_section(std::max(0.0, along_ - 0.1), std::min(2.0, along_ + 0.1), 14, value));
    return sign * std::max({found, near, value(along_)});
  };
  LogRange range{over_bends(-1.0), over_bends(1.0)};
  if (range.low < -1e3) range.low = -k_infinity;
  if (range.high < -1e3) range.high = -k_infinity;
  return range;
}

}  // namespace clusterbench::measure
