#include "geom/numbers/wide_enclosure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"

namespace clusterbench::geom {
namespace {

const Rational k_slack = Rational(1) / Rational(Integer(1) << 60);

// An enclosure around a rational number, off-centre and wider than rounding makes it.
template <class Interval = Enclosure>
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
  expect_holds_what_exact_arithmetic_gives<Enclosure>(2000);
  expect_holds_what_exact_arithmetic_gives<HugeEnclosure>(100);
}

// Where 1024 bits and a double's exponent tell nothing.
TEST(Enclosure, of_3072_bits_tells_numbers_apart_that_differ_by_2_to_the_minus_2900) {
  const Rational hair = Rational(1) / Rational(Integer(1) << 2900), third = Rational(1) / 3;
  const HugeEnclosure x = HugeEnclosure::of(third), y = HugeEnclosure::of(Rational(third + hair));
  EXPECT_TRUE(x < y);
  EXPECT_TRUE(holds(y - x, hair));
  EXPECT_TRUE(sqrt(x) < sqrt(y));
  EXPECT_FALSE(y < x);
  EXPECT_FALSE(Enclosure::of(third) < Enclosure::of(Rational(third + hair)));
  EXPECT_TRUE(holds(HugeEnclosure::of(hair) * HugeEnclosure::of(hair), hair * hair));
  EXPECT_TRUE(HugeEnclosure(0.0) < HugeEnclosure::of(hair) * HugeEnclosure::of(hair));
  const HugeEnclosure nothing = HugeEnclosure(1.0) / (x - x);
  EXPECT_FALSE(nothing < HugeEnclosure(1e300));
  EXPECT_FALSE(nothing > HugeEnclosure(-1e300));
}

template <unsigned bits>
void expect_square_roots(int tries) {
  SplitMix64 random(11);
  for (int i = 0; i < tries; ++i) {
    const auto exponent = static_cast<int>(random.below(4000)) - 2000;
    const FloatOf<bits> third = FloatOf<bits>(random.between(0.1, 1.0)) / 3, square = ldexp(third, exponent);
    const FloatOf<bits> root = SquareRoot<FloatOf<bits>>::of(square);
    // In the last place: of the root, half of what its square is off by.
    const Rational off = abs(squared(exact<bits>(root)) / exact<bits>(square) - 1) * Rational(Integer(1) << bits);
    EXPECT_LT(off, 6) << bits << " bits, 2^" << exponent;
  }
  for (const double exactly : {0.0, 1.0, 0.5, 3.0, 0x1p-537, 1.5})
    EXPECT_EQ(SquareRoot<FloatOf<bits>>::of(FloatOf<bits>(exactly * exactly)), FloatOf<bits>(exactly)) << exactly;
  EXPECT_EQ(SquareRoot<FloatOf<bits>>::of(FloatOf<bits>(-1)), 0);
}

TEST(SquareRoot, is_right_to_the_last_bits) {
  expect_square_roots<256>(2000);
  expect_square_roots<1024>(500);
  expect_square_roots<3072>(100);
}

TEST(Enclosure, compares_only_what_is_certain) {
  SplitMix64 random(5);
  const Rational a = exact(0.3);
  const Enclosure x = loosely(a, random);
  EXPECT_FALSE(x < Enclosure::of(a));
  EXPECT_FALSE(x > Enclosure::of(a));
  EXPECT_TRUE(x < Enclosure::of(a + 2 * k_slack));
  EXPECT_TRUE(x > Enclosure::of(a - 2 * k_slack));
  EXPECT_FALSE(x == x);
  EXPECT_TRUE(Enclosure(0.5) == Enclosure(0.5));
}

TEST(Enclosure, knows_nothing_after_a_division_by_what_may_be_zero) {
  SplitMix64 random(7);
  const Enclosure nothing = Enclosure(1.0) / loosely(0, random);
  EXPECT_FALSE(nothing < Enclosure(1e300));
  EXPECT_FALSE(nothing > Enclosure(-1e300));
  const Enclosure after = sqrt(Enclosure(0.0) * nothing + Enclosure(1.0));
  EXPECT_FALSE(after < Enclosure(1e300));
}

TEST(Enclosure, is_never_too_narrow_however_small_the_numbers_are) {
  for (const unsigned exponent : {0u, 60u, 900u, 1074u, 1100u, 2200u}) {
    const Rational scale = Rational(1) / Rational(Integer(1) << exponent), third = scale / 3;
    const Enclosure x = Enclosure::of(third), y = Enclosure::of(scale) / Enclosure(3.0);
    EXPECT_TRUE(holds(x, third)) << exponent;
    EXPECT_TRUE(holds(y, third)) << exponent;
    EXPECT_GT(x.radius(), 0.0) << exponent;
    EXPECT_GT(y.radius(), 0.0) << exponent;
    EXPECT_TRUE(holds(x * x, third * third)) << exponent;
    EXPECT_GT((x * x).radius(), 0.0) << exponent;
    EXPECT_TRUE(holds(x - y, 0)) << exponent;
    const Enclosure around_0 = Enclosure::of(RationalInterval{-third, third});
    EXPECT_TRUE(holds(around_0 * around_0, third * third)) << exponent;
  }
}

TEST(Enclosure, is_never_too_narrow_near_the_largest_double) {
  const Rational largest = exact(std::numeric_limits<double>::max());
  for (const Rational& hi : {largest, Rational(2 * largest), Rational(8 * largest)}) {
    const Enclosure wide = Enclosure::of(RationalInterval{1, hi});
    EXPECT_TRUE(holds(Enclosure(1.0) / wide, 1));
    EXPECT_TRUE(holds(Enclosure(1.0) / wide, 1 / hi));
    EXPECT_TRUE(holds(sqrt(wide), 1));
    EXPECT_FALSE(Enclosure(2.0) < wide);
  }
}

Polynomial<Enclosure> with_roots(const std::array<double, 4>& roots) {
  Polynomial<Enclosure> p{{Enclosure(1.0), Enclosure(0.0), Enclosure(0.0), Enclosure(0.0), Enclosure(0.0)}, 4};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = i + 2; k-- > 0;) p.c[k] = (k > 0 ? p.c[k - 1] : Enclosure(0.0)) - Enclosure(roots[i]) * p.c[k];
  return p;
}

void expect_found(const std::array<double, 4>& roots, std::size_t count) {
  const Places<Enclosure> places = root_places(with_roots(roots), 200);
  EXPECT_EQ(places.count, count);
  for (const double root : roots) {
    if (root < -1.0 || root > 1.0) continue;
    EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](const Enclosure& place) {
      return holds(place, exact(root)) && place.radius() < 0x1p-90;
    })) << root;
  }
}

TEST(RootPlaces, hold_single_and_multiple_roots_and_those_at_the_ends) {
  expect_found({-0.7, -0.1, 0.3, 0.9}, 4);
  expect_found({-0.7, -0.7 + 0x1p-50, 0.3, 3.0}, 3);
  expect_found({0.3, 0.3, -0.2, 5.0}, 2);
  expect_found({0.3, 0.3, 0.3, 5.0}, 1);
  expect_found({-1.0, 1.0, 0.0, 0.5}, 4);
  expect_found({2.0, 3.0, -4.0, 1.5}, 0);
}

TEST(RootPlaces, are_the_whole_interval_where_everything_is_a_root) {
  Polynomial<Enclosure> p{{}, 4};
  const Places<Enclosure> places = root_places(p, 200);
  ASSERT_EQ(places.count, 1u);
  EXPECT_TRUE(holds(*places.begin(), -1) && holds(*places.begin(), 1));
}

}  // namespace
}  // namespace clusterbench::geom
