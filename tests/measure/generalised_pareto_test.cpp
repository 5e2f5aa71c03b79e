#include "measure/statistics/generalised_pareto.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace clusterbench::measure {
namespace {

// Quantiles (i - 0.5) / 40 of the Weibull distribution of shape 1.5 and scale 1000.
std::vector<Excess> weibull_quantiles(std::uint64_t scale) {
  std::vector<Excess> out;
  for (const std::uint64_t value : {54,   113,  161,  203,  242,  280,  316,  351,  385,  419,  453,  486,  520,  553,
                                    587,  622,  656,  692,  728,  765,  802,  841,  881,  922,  965,  1010, 1057, 1106,
                                    1158, 1214, 1274, 1339, 1410, 1489, 1579, 1684, 1811, 1974, 2209, 2678})
    out.push_back({value * scale, 1});
  return out;
}

// Forty small counts.
std::vector<Excess> small_numbers() {
  return {{1, 14}, {2, 11}, {3, 6}, {4, 4}, {5, 2}, {7, 2}, {9, 1}};
}

// Steps of a thousandth of a value are as good as none. scipy 1.10 genpareto.fit(y, floc=0) of y = 54000 ... 2678000
// gives c = -0.42213316, scale = 1262982.65.
TEST(GeneralisedPareto, is_fitted_as_scipy_fits_it) {
  const GeneralisedPareto fit = ParetoFit(weibull_quantiles(1000)).best();
  EXPECT_NEAR(fit.shape(), -0.422133, 1e-4);
  EXPECT_NEAR(fit.scale(), 1262983.0, 1e-3 * 1262983.0);
}

// scipy's minimize (Nelder-Mead) over the sum of ln(genpareto.sf(y - 1) - genpareto.sf(y)).
TEST(GeneralisedPareto, of_whole_numbers_has_the_largest_likelihood_of_their_intervals) {
  const GeneralisedPareto fit = ParetoFit(small_numbers()).best();
  EXPECT_NEAR(fit.shape(), -0.0910821, 1e-5);
  EXPECT_NEAR(fit.scale(), 2.2241950, 1e-4);
  EXPECT_NEAR(fit.log_survival(12.0), -7.423054, 1e-3);
}

// The same region searched point by point, 1901 shapes x 1201 scales, with scipy: half of the likelihood's logarithm
// and 20 counted events. The upper end of ln(r P(y > 12)) is -2.7323; the lower has distributions that end below 12.
TEST(GeneralisedPareto, has_the_interval_of_a_search_point_by_point) {
  const ParetoFit::LogRange range = ParetoFit(small_numbers()).log_survival_range(12.0, 20.0, 20.0);
  EXPECT_NEAR(range.high, -2.7323, 2e-3);
  EXPECT_EQ(range.low, -std::numeric_limits<double>::infinity());
}

// At the threshold the distribution has no part: the interval is that of a Poisson count alone, the two roots of
// 20 (r - 1 - ln r) = 1.9207.
TEST(GeneralisedPareto, at_the_threshold_has_the_interval_of_the_count) {
  const ParetoFit::LogRange range = ParetoFit(small_numbers()).log_survival_range(0.0, 20.0, 20.0);
  for (const double end : {range.low, range.high}) EXPECT_NEAR(20.0 * (std::exp(end) - 1.0 - end), 1.920729, 1e-6);
  EXPECT_LT(range.low, 0.0);
  EXPECT_GT(range.high, 0.0);
}

TEST(GeneralisedPareto, without_a_shape_is_exponential) {
  const GeneralisedPareto none{0.0, 0.25}, hardly{1e-12, 0.25};
  for (const double y : {0.0, 1.0, 40.0}) {
    EXPECT_DOUBLE_EQ(none.log_survival(y), -0.25 * y);
    EXPECT_NEAR(hardly.log_survival(y), -0.25 * y, 1e-9);
    EXPECT_DOUBLE_EQ(none.quantile(-0.25 * y), y);
    EXPECT_NEAR(hardly.quantile(-0.25 * y), y, 1e-9);
  }
}

// Counts of the geometric distribution with ratio 1/2 are whole parts of the exponential one with rate ln 2.
TEST(GeneralisedPareto, of_geometric_counts_has_the_rate_in_closed_form) {
  std::vector<Excess> excesses;
  for (std::uint64_t value = 1; value <= 20; ++value) excesses.push_back({value, std::uint64_t{1} << (20 - value)});
  const GeneralisedPareto fit = ParetoFit(excesses).best();
  EXPECT_NEAR(fit.shape(), 0.0, 1e-3);
  EXPECT_NEAR(fit.rate, std::log(2.0), 1e-3);
}

TEST(GeneralisedPareto, with_an_end_never_exceeds_it) {
  const GeneralisedPareto fit{-0.1, 0.3};  // ends at 10
  EXPECT_EQ(fit.log_survival(10.0), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(fit.log_survival(11.0), -std::numeric_limits<double>::infinity());
  for (const double y : {0.5, 5.0, 9.99}) EXPECT_NEAR(fit.quantile(fit.log_survival(y)), y, 1e-9);
  EXPECT_NEAR(fit.quantile(-1e4), 10.0, 1e-9);
}

// All numbers up to an end are equally often: the steepest shape that is considered.
TEST(GeneralisedPareto, of_even_numbers_stays_within_its_shapes) {
  std::vector<Excess> excesses;
  for (std::uint64_t value = 1; value <= 50; ++value) excesses.push_back({value, 3});
  const GeneralisedPareto fit = ParetoFit(excesses).best();
  EXPECT_GE(fit.shape(), k_least_shape);
  EXPECT_NEAR(fit.shape(), -1.0, 0.05);
  EXPECT_NEAR(fit.scale() / -fit.shape(), 50.0, 1.0);
}

}  // namespace
}  // namespace clusterbench::measure
