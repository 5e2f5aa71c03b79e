#include "geom/numbers/rational_trigonometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

namespace clusterbench::geom {
namespace {

void expect_holds(const RationalInterval& bounds, const Rational& value, unsigned bits) {
  EXPECT_TRUE(bounds.lo <= value);
  EXPECT_TRUE(bounds.hi >= value);
  EXPECT_LT((bounds.hi - bounds.lo) * Rational(Integer(1) << (bits - 12)), 1);
}

// The decimal fraction 0.<digits>.
Rational decimal_fraction(std::string_view digits) {
  Integer numerator = 0, denominator = 1;
  for (const char digit : digits) {
    numerator = numerator * 10 + (digit - '0');
    denominator = denominator * 10;
  }
  return {numerator, denominator};
}

TEST(BoundsOfAngle, hold_the_first_hundred_digits_of_the_cosine_and_sine_of_one) {
  const Rational cosine = decimal_fraction(
      "5403023058681397174009366074429766037323104206179222276700972553811003947744717645179518560871830893");
  const Rational sine = decimal_fraction(
      "8414709848078965066525023216302989996225630607983710656727517099919104043912396689486397435430526958");
  const AngleBounds bounds = bounds_of_angle(1, 320);  // 96 digits
  const Rational last = decimal_fraction("0" + std::string(98, '0') + "1");
  expect_holds({bounds.cosine.lo - last, bounds.cosine.hi + last}, cosine, 318);
  expect_holds({bounds.sine.lo - last, bounds.sine.hi + last}, sine, 318);
}

TEST(BoundsOfAngle, hold_numbers_whose_squares_add_to_one) {
  for (const double angle : {1e-300, 1e-9, 0.1, std::numbers::pi / 4.0, 1.0, std::numbers::pi / 2.0, 1.99})
    for (const unsigned bits : {320u, 1040u}) {
      const AngleBounds bounds = bounds_of_angle(exact(angle), bits);
      const Rational outer = std::max(abs(bounds.cosine.lo), abs(bounds.cosine.hi));
      const Rational inner = std::min(abs(bounds.cosine.lo), abs(bounds.cosine.hi));
      EXPECT_TRUE(squared(outer) + squared(bounds.sine.hi) >= 1) << angle;
      EXPECT_TRUE(squared(inner) + squared(std::max(Rational(0), bounds.sine.lo)) <= 1) << angle;
      EXPECT_TRUE(abs(bounds.sine.hi - exact(std::sin(angle))) <= exact(1e-15));
      EXPECT_TRUE(abs(bounds.cosine.lo - exact(std::cos(angle))) <= exact(1e-15));
    }
}

TEST(BoundsOfAngle, are_exact_for_an_angle_of_zero) {
  const AngleBounds bounds = bounds_of_angle(0, 320);
  EXPECT_EQ(bounds.cosine.lo, 1);
  EXPECT_EQ(bounds.cosine.hi, 1);
  EXPECT_EQ(bounds.sine.lo, 0);
  EXPECT_EQ(bounds.sine.hi, 0);
}

TEST(BoundsOfAngle, of_the_least_angles_are_bounds_of_a_cosine_below_1_and_of_a_sine_above_0) {
  for (const double angle : {5e-324, 1e-300, 1e-160, 1e-100, 1e-60, 1e-30, 1e-20, 1e-9})
    for (const unsigned bits : {320u, 1040u}) {
      const AngleBounds bounds = bounds_of_angle(exact(angle), bits);
      EXPECT_LE(bounds.cosine.hi, 1) << angle;
      EXPECT_GE(bounds.sine.lo, 0) << angle;
      const Rational x = exact(angle), square = squared(x);
      EXPECT_LE(bounds.cosine.lo, 1 - square / 2 + squared(square) / 24) << angle;
      EXPECT_GE(bounds.cosine.hi, 1 - square / 2) << angle;
      EXPECT_GE(bounds.sine.hi, x - x * square / 6) << angle;
      // To the third power of the angle at least, relative to it: what tells a touch from none is of that size.
      if (bits == 1040u && angle < 1e-80) {
        EXPECT_LT(bounds.cosine.hi - bounds.cosine.lo, squared(square) / 1000) << angle;
        EXPECT_LT(bounds.sine.hi - bounds.sine.lo, x * square / 1000) << angle;
      }
      EXPECT_LE(bounds.sine.lo, x) << angle;
      EXPECT_GE(bounds.sine.hi, x - x * square / 6) << angle;
      EXPECT_LE(bounds.cosine.hi - bounds.cosine.lo, Rational(1) / Rational(Integer(1) << (bits - 12)));
      EXPECT_LE(bounds.sine.hi - bounds.sine.lo, Rational(1) / Rational(Integer(1) << (bits - 12)));
    }
}

TEST(RootAbove, is_above_the_root_by_a_hair) {
  for (const Rational& value :
       {Rational(2), Rational(Integer(1), Integer(3)), exact(1e-300), exact(1e300), Rational(4)}) {
    const Rational root = root_above(value), below = root * (1 - Rational(1) / Rational(Integer(1) << 300));
    EXPECT_GE(squared(root), value);
    EXPECT_LT(squared(below), value);
  }
  EXPECT_EQ(root_above(0), 0);
}

TEST(AtMostRoot, compares_with_both_signs) {
  EXPECT_TRUE(at_most_root<Rational>(3, 1, 9));
  EXPECT_FALSE(at_most_root<Rational>(4, 1, 9));
  EXPECT_TRUE(at_most_root<Rational>(-3, -1, 9));
  EXPECT_FALSE(at_most_root<Rational>(-2, -1, 9));
  EXPECT_TRUE(at_most_root<Rational>(-4, -1, 9));
  EXPECT_TRUE(at_most_root<Rational>(-1, 1, 2));
  EXPECT_FALSE(at_most_root<Rational>(1, -1, 2));
  EXPECT_TRUE(at_most_root<Rational>(0, -1, 0));
  EXPECT_FALSE(at_most_root<Rational>(0, -1, 2));
  EXPECT_TRUE(at_most_root<Rational>(0, 0, 2));
  EXPECT_FALSE(at_most_root<Rational>(1, 0, 2));
}

}  // namespace
}  // namespace clusterbench::geom
