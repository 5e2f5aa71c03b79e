#include "geom/numbers/wide_enclosure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"

namespace clusterbench::geom {
namespace {

const Rational k_slack = Rational(1) / Rational(Integer(1) << 60);

// An enclosure around a rational number, off-centre and wider than rounding makes it.
template <class Interval = Enclosure1024>
Interval loosely(const Rational& value, SplitMix64& random) {
  return Interval::of(RationalInterval{value - exact(random.unit()) * k_slack, value + exact(random.unit()) * k_slack});
}

template <class Interval>
bool holds(const Interval& enclosure, const Rational& value) {
  const Interval exactly = Interval::of(value);
  return !(enclosure < exactly) && !(exactly < enclosure);
}

template <class Interval>
void expect_holds_what_exact_arithmetic_gives(int tries) {
  SplitMix64 random(3);
  for (int i = 0; i < tries; ++i) {
    const Rational a = exact(random.between(-2, 2)), b = exact(random.between(0.1, 2));
    const Interval x = loosely<Interval>(a, random), y = loosely<Interval>(b, random);
    EXPECT_TRUE(holds(x + y, a + b));
    EXPECT_TRUE(holds(x - y, a - b));
    EXPECT_TRUE(holds(x * y, a * b));
    EXPECT_TRUE(holds(x / y, a / b));
    EXPECT_TRUE(holds(-x, -a));
    EXPECT_TRUE(holds(sqrt(x * x), abs(a)));
    EXPECT_TRUE(holds(sqrt(y) * sqrt(y), b));
    // Not by being wide.
    for (const Interval& result : {x + y, x - y, x * y, x / y, sqrt(y)}) EXPECT_LT(result.radius(), 0x1p-48);
  }
}

TEST(Enclosure, holds_what_exact_arithmetic_gives) {
  expect_holds_what_exact_arithmetic_gives<Enclosure1024>(2000);
  expect_holds_what_exact_arithmetic_gives<Enclosure3072>(100);
}

// Where 1024 bits and a double's exponent tell nothing.
TEST(Enclosure, of_3072_bits_tells_numbers_apart_that_differ_by_2_to_the_minus_2900) {
  const Rational hair = Rational(1) / Rational(Integer(1) << 2900), third = Rational(1) / 3;
  const Enclosure3072 x = Enclosure3072::of(third), y = Enclosure3072::of(Rational(third + hair));
  EXPECT_TRUE(x < y);
  EXPECT_TRUE(holds(y - x, hair));
  EXPECT_TRUE(sqrt(x) < sqrt(y));
  EXPECT_FALSE(y < x);
  EXPECT_FALSE(Enclosure1024::of(third) < Enclosure1024::of(Rational(third + hair)));
  EXPECT_TRUE(holds(Enclosure3072::of(hair) * Enclosure3072::of(hair), hair * hair));
  EXPECT_TRUE(Enclosure3072(0.0) < Enclosure3072::of(hair) * Enclosure3072::of(hair));
  const Enclosure3072 nothing = Enclosure3072(1.0) / (x - x);
  EXPECT_FALSE(nothing < Enclosure3072(1e300));
  EXPECT_FALSE(nothing > Enclosure3072(-1e300));
}

template <unsigned bits>
void expect_square_roots(int tries) {
  SplitMix64 random(11);
  for (int i = 0; i < tries; ++i) {
    const auto exponent = static_cast<int>(random.below(4000)) - 2000;
    const BinaryFloat<bits> third = BinaryFloat<bits>(random.between(0.1, 1.0)) / 3, square = ldexp(third, exponent);
    const BinaryFloat<bits> root = SquareRoot<BinaryFloat<bits>>::of(square);
    // In the last place: of the root, half of what its square is off by.
    const Rational off = abs(squared(exact<bits>(root)) / exact<bits>(square) - 1) * Rational(Integer(1) << bits);
    EXPECT_LT(off, 6) << bits << " bits, 2^" << exponent;
  }
  for (const double exactly : {0.0, 1.0, 0.5, 3.0, 0x1p-537, 1.5})
    EXPECT_EQ(SquareRoot<BinaryFloat<bits>>::of(BinaryFloat<bits>(exactly * exactly)), BinaryFloat<bits>(exactly))
        << exactly;
  EXPECT_EQ(SquareRoot<BinaryFloat<bits>>::of(BinaryFloat<bits>(-1)), 0);
}

TEST(SquareRoot, is_right_to_the_last_bits) {
  expect_square_roots<256>(2000);
  expect_square_roots<1024>(500);
  expect_square_roots<3072>(100);
}

TEST(Enclosure, compares_only_what_is_certain) {
  SplitMix64 random(5);
  const Rational a = exact(0.3);
  const Enclosure1024 x = loosely(a, random);
  EXPECT_FALSE(x < Enclosure1024::of(a));
  EXPECT_FALSE(x > Enclosure1024::of(a));
  EXPECT_TRUE(x < Enclosure1024::of(a + 2 * k_slack));
  EXPECT_TRUE(x > Enclosure1024::of(a - 2 * k_slack));
  EXPECT_FALSE(x == x);
  EXPECT_TRUE(Enclosure1024(0.5) == Enclosure1024(0.5));
}

TEST(Enclosure, knows_nothing_after_a_division_by_what_may_be_zero) {
  SplitMix64 random(7);
  const Enclosure1024 nothing = Enclosure1024(1.0) / loosely(0, random);
  EXPECT_FALSE(nothing < Enclosure1024(1e300));
  EXPECT_FALSE(nothing > Enclosure1024(-1e300));
  const Enclosure1024 after = sqrt(Enclosure1024(0.0) * nothing + Enclosure1024(1.0));
  EXPECT_FALSE(after < Enclosure1024(1e300));
}

TEST(Enclosure, is_never_too_narrow_however_small_the_numbers_are) {
  for (const unsigned exponent : {0u, 60u, 900u, 1074u, 1100u, 2200u}) {
    const Rational scale = Rational(1) / Rational(Integer(1) << exponent), third = scale / 3;
    const Enclosure1024 x = Enclosure1024::of(third), y = Enclosure1024::of(scale) / Enclosure1024(3.0);
    EXPECT_TRUE(holds(x, third)) << exponent;
    EXPECT_TRUE(holds(y, third)) << exponent;
    EXPECT_GT(x.radius(), 0.0) << exponent;
    EXPECT_GT(y.radius(), 0.0) << exponent;
    EXPECT_TRUE(holds(x * x, third * third)) << exponent;
    EXPECT_GT((x * x).radius(), 0.0) << exponent;
    EXPECT_TRUE(holds(x - y, 0)) << exponent;
    const Enclosure1024 around_0 = Enclosure1024::of(RationalInterval{-third, third});
    EXPECT_TRUE(holds(around_0 * around_0, third * third)) << exponent;
  }
}

TEST(Enclosure, is_never_too_narrow_near_the_largest_double) {
  const Rational largest = exact(std::numeric_limits<double>::max());
  for (const Rational& hi : {largest, Rational(2 * largest), Rational(8 * largest)}) {
    const Enclosure1024 wide = Enclosure1024::of(RationalInterval{1, hi});
    EXPECT_TRUE(holds(Enclosure1024(1.0) / wide, 1));
    EXPECT_TRUE(holds(Enclosure1024(1.0) / wide, 1 / hi));
    EXPECT_TRUE(holds(sqrt(wide), 1));
    EXPECT_FALSE(Enclosure1024(2.0) < wide);
  }
}

Polynomial<Enclosure1024> with_roots(const std::array<double, 4>& roots) {
  Polynomial<Enclosure1024> p{
      {Enclosure1024(1.0), Enclosure1024(0.0), Enclosure1024(0.0), Enclosure1024(0.0), Enclosure1024(0.0)}, 4};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = i + 2; k-- > 0;)
      p.c[k] = (k > 0 ? p.c[k - 1] : Enclosure1024(0.0)) - Enclosure1024(roots[i]) * p.c[k];
  return p;
}

void expect_found(const std::array<double, 4>& roots, std::size_t count) {
  const Roots<Enclosure1024> places = roots_of(with_roots(roots), 200);
  EXPECT_EQ(places.count, count);
  for (const double root : roots) {
    if (root < -1.0 || root > 1.0) continue;
    EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](const Enclosure1024& place) {
      return holds(place, exact(root)) && place.radius() < 0x1p-90;
    })) << root;
  }
}

TEST(Roots, hold_single_and_multiple_roots_and_those_at_the_ends) {
  expect_found({-0.7, -0.1, 0.3, 0.9}, 4);
  expect_found({-0.7, -0.7 + 0x1p-50, 0.3, 3.0}, 3);
  expect_found({0.3, 0.3, -0.2, 5.0}, 2);
  expect_found({0.3, 0.3, 0.3, 5.0}, 1);
  expect_found({-1.0, 1.0, 0.0, 0.5}, 4);
  expect_found({2.0, 3.0, -4.0, 1.5}, 0);
}

TEST(Roots, are_the_whole_interval_where_everything_is_a_root) {
  Polynomial<Enclosure1024> p{{}, 4};
  const Roots<Enclosure1024> places = roots_of(p, 200);
  ASSERT_EQ(places.count, 1u);
  EXPECT_TRUE(holds(*places.begin(), -1) && holds(*places.begin(), 1));
}

}  // namespace
}  // namespace clusterbench::geom
