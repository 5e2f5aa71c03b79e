// Our integers, rational numbers and floats against Boost's.

#include <gtest/gtest.h>

#if defined(__GNUC__) && !defined(__clang__)
// g++ 13 and 14 see shifts beyond the ends of Boost's long numbers, which their exponents rule out.
#pragma GCC diagnostic ignored "-Warray-bounds"
#endif
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

#include "core/random.h"
#include "effort.h"
#include "geom/numbers/binary_float.h"
#include "geom/numbers/rational.h"

namespace clusterbench::geom {
namespace {

namespace mp = boost::multiprecision;

mp::cpp_int of_boost(const Integer& value) {
  mp::cpp_int out = 0;
  for (std::size_t i = value.limbs().size(); i-- > 0;) out = (out << k_limb_bits) + value.limbs()[i];
  return value.sign() < 0 ? mp::cpp_int(-out) : out;
}

mp::cpp_rational of_boost(const Rational& value) {
  return mp::cpp_rational(of_boost(numerator(value)), of_boost(denominator(value)));
}

// Of up to `limbs` limbs. Some limbs are 0 or all ones, where carries run through and quotients are guessed wrongly.
Integer drawn(SplitMix64& random, std::size_t limbs) {
  Limbs out(random.below(limbs + 1));
  for (Limb& limb : out) {
    const std::uint64_t kind = random.below(5);
    limb = kind == 0 ? 0 : kind == 1 ? ~Limb{0} : kind == 2 ? Limb{1} << 63 : random.next();
  }
  return {out, random.below(2) == 1};
}

TEST(Integers, computes_as_Boost_does) {
  SplitMix64 random(3);
  for (int i = 0; i < test::tries(20000); ++i) {
    const Integer a = drawn(random, 12), b = drawn(random, 6);
    const mp::cpp_int c = of_boost(a), d = of_boost(b);
    ASSERT_EQ(of_boost(a + b), c + d);
    ASSERT_EQ(of_boost(a - b), c - d);
    ASSERT_EQ(of_boost(a * b), c * d);
    ASSERT_EQ(a < b, c < d);
    ASSERT_EQ(a == b, c == d);
    ASSERT_EQ(a.sign(), c.sign());
    const auto shift = static_cast<unsigned>(random.below(300));
    ASSERT_EQ(of_boost(a << shift), c << shift);
    if (a.sign() >= 0) {
      ASSERT_EQ(of_boost(a >> shift), c >> shift);
      ASSERT_EQ(of_boost(sqrt(a)), mp::sqrt(c));
    }
    if (b.sign() == 0) continue;
    ASSERT_EQ(of_boost(a / b), c / d) << c << " / " << d;
    ASSERT_EQ(of_boost(a % b), c % d) << c << " % " << d;
    if (a.sign() == 0) continue;
    ASSERT_EQ(of_boost(greatest_common_divisor(a, b)), mp::gcd(c, d));
  }
}

TEST(Integers, has_bits_and_zeros_at_its_end) {
  EXPECT_EQ(Integer(0).bits(), 0u);
  EXPECT_EQ(Integer(0).zeros(), 0u);
  EXPECT_EQ(Integer(-12).bits(), 4u);
  EXPECT_EQ(Integer(-12).zeros(), 2u);
  EXPECT_EQ((Integer(5) << 200).bits(), 203u);
  EXPECT_EQ((Integer(5) << 200).zeros(), 200u);
  EXPECT_EQ(of_boost(Integer(std::numeric_limits<std::int64_t>::min())),
            mp::cpp_int(std::numeric_limits<std::int64_t>::min()));
}

double drawn_double(SplitMix64& random) {
  const std::uint64_t kind = random.below(8);
  if (kind == 0) return 0.0;
  if (kind == 1) return std::ldexp(random.between(-1.0, 1.0), -1050);
  return std::ldexp(random.between(-1.0, 1.0), static_cast<int>(random.below(120)) - 60);
}

TEST(Rationals, computes_as_Boost_does_also_where_fractions_become_long) {
  SplitMix64 random(5);
  for (int round = 0; round < test::tries(300); ++round) {
    Rational a(drawn_double(random));
    mp::cpp_rational b = of_boost(a);
    for (int step = 0; step < 30; ++step) {
      const double number = drawn_double(random);
      const Rational c(number);
      const mp::cpp_rational d(number);
      ASSERT_EQ(of_boost(c), d);
      switch (random.below(number == 0.0 ? 3 : 4)) {
        case 0:
          a += c, b += d;
          break;
        case 1:
          a = c - a, b = d - b;
          break;
        case 2:
          a = a * c + 1, b = b * d + 1;
          break;
        default:
          a = (a + 3) / c, b = (b + 3) / d;
      }
      ASSERT_EQ(of_boost(a), b);
      ASSERT_EQ(a.sign(), b.sign());
      ASSERT_EQ(a < c, b < d);
      ASSERT_EQ(abs(a) > abs(c), abs(b) > abs(d));
      ASSERT_TRUE(a == a + c - c);
    }
  }
}

template <class Number>
class BinaryFloats : public testing::Test {};
template <unsigned bits>
struct Bits {
  static constexpr unsigned k_bits = bits;
  using Own = BinaryFloat<bits>;
  using Boosts = mp::number<mp::cpp_bin_float<bits, mp::digit_base_2>, mp::et_off>;
};
using Widths = testing::Types<Bits<64>, Bits<256>, Bits<1024>, Bits<3072>>;
TYPED_TEST_SUITE(BinaryFloats, Widths);

// The exact value.
template <class Wide, unsigned bits>
Wide in_boost(const BinaryFloat<bits>& value) {
  int exponent = 0;
  const Integer digits(ldexp(frexp(value, &exponent), bits));
  return ldexp(Wide(of_boost(digits)), exponent - static_cast<int>(bits));
}

// value * 2^power as a multiple of the least positive double, to nearest and ties to even; by whole numbers.
template <class Wide>
double nearest_subnormal(const Wide& value, int power) {
  const Wide steps = ldexp(Wide(abs(value)), power + 1074);
  mp::cpp_int whole(steps);
  const Wide rest = steps - Wide(whole);
  if (rest > 0.5 || (rest == 0.5 && whole % 2 == 1)) ++whole;
  if (whole > (mp::cpp_int(1) << 53)) return static_cast<double>(Wide(ldexp(value, power)));
  const double size = std::ldexp(static_cast<double>(whole), -1074);
  return value < 0 ? -size : size;
}

TYPED_TEST(BinaryFloats, round_to_nearest) {
  using Own = typename TypeParam::Own;
  using Wide = mp::number<mp::cpp_bin_float<2 * TypeParam::k_bits + 128, mp::digit_base_2>, mp::et_off>;
  using Boosts = typename TypeParam::Boosts;
  SplitMix64 random(9);
  // Boost rounds to nearest, too, except differences of numbers that lie one bit more apart than their digits: so exact
  // ones are rounded in one step.
  const auto check_against_boost = [](const char* name, const Own& made, const Boosts& of_boost) {
    ASSERT_EQ(in_boost<Boosts>(made), of_boost) << name;
  };
  const auto check = [](const char* name, const Own& made, const Wide& exact) {
    const Wide error = abs(in_boost<Wide>(made) - exact);
    ASSERT_LE(error, ldexp(Wide(abs(exact)), -static_cast<int>(TypeParam::k_bits))) << name;
  };
  for (int i = 0; i < test::tries(1000); ++i) {
    // Quotients have all of their bits; some are close to each other, so that their difference has few.
    Own a = Own(random.between(-2.0, 2.0)) / Own(random.between(0.5, 3.0));
    Own b = Own(random.between(-2.0, 2.0)) / Own(random.between(0.5, 3.0));
    if (i % 3 == 0) b = ldexp(b, static_cast<std::int64_t>(random.below(2 * TypeParam::k_bits)) - TypeParam::k_bits);
    if (i % 3 == 1) b = a + ldexp(b, -static_cast<std::int64_t>(random.below(TypeParam::k_bits)));
    const Wide c = in_boost<Wide>(a), d = in_boost<Wide>(b);
    check("sum", a + b, c + d);
    check("difference", a - b, c - d);
    check("product", a * b, c * d);
    check("quotient", a / b, c / d);
    const Boosts e = in_boost<Boosts>(a), f = in_boost<Boosts>(b);
    check_against_boost("sum", a + b, Boosts(c + d));
    check_against_boost("difference", a - b, Boosts(c - d));
    check_against_boost("product", a * b, e * f);
    check_against_boost("quotient", a / b, e / f);
    ASSERT_EQ(a < b, c < d);
    ASSERT_EQ(abs(a) <= abs(b), abs(c) <= abs(d));
    ASSERT_EQ(static_cast<double>(a), static_cast<double>(c));
    const int power = static_cast<int>(random.below(120)) - 1100;  // where doubles have fewer bits, and beyond
    ASSERT_EQ(static_cast<double>(ldexp(a, power)), nearest_subnormal(c, power));
    ASSERT_EQ(of_boost(static_cast<Integer>(ldexp(a, 100))), mp::cpp_int(ldexp(c, 100)));
  }
}

TYPED_TEST(BinaryFloats, have_cosines_and_sines_to_nearly_all_bits) {
  using Own = typename TypeParam::Own;
  using Wide = mp::number<mp::cpp_bin_float<TypeParam::k_bits + 128, mp::digit_base_2>, mp::et_off>;
  SplitMix64 random(13);
  for (int i = 0; i < 20; ++i) {
    const double angle = i == 0 ? 0.0 : i < 4 ? std::ldexp(1.0, -20 * i) : random.between(0.0, 1.6);
    const Wide most = ldexp(Wide(1), 8 - static_cast<int>(TypeParam::k_bits));
    EXPECT_LE(abs(in_boost<Wide>(cos(Own(angle))) - cos(Wide(angle))), most) << angle;
    EXPECT_LE(abs(in_boost<Wide>(sin(Own(angle))) - sin(Wide(angle))), most) << angle;
  }
}

TYPED_TEST(BinaryFloats, convert_among_their_widths_and_from_whole_numbers) {
  using Own = typename TypeParam::Own;
  const BinaryFloat<3072> third = BinaryFloat<3072>(1) / 3;
  EXPECT_LT(std::abs(static_cast<double>(Own(third) * 3 - 1)), 0x1p-60);
  EXPECT_TRUE(Own(BinaryFloat<64>(0.3)) == Own(0.3));
  EXPECT_TRUE(Own(Integer(1) << 5000) == ldexp(Own(1), 5000));
  EXPECT_TRUE(Own(-7) == -Own(7.0));
}

TYPED_TEST(BinaryFloats, know_zero_infinity_and_nan) {
  using Own = typename TypeParam::Own;
  const Own zero = 0, endless = Own::infinity(), nan = endless - endless;
  EXPECT_TRUE(zero == -zero);
  EXPECT_TRUE(zero < Own(1) && Own(-1) < zero && Own(1) < endless && -endless < Own(-1));
  EXPECT_FALSE(nan == nan || nan < Own(1) || nan > Own(1));
  EXPECT_TRUE(Own(1) / zero == endless && Own(-1) / zero == -endless && Own(3) / endless == zero);
  EXPECT_FALSE(zero / zero == zero);
  EXPECT_FALSE(zero * endless == zero);
  EXPECT_TRUE(endless + Own(5) == endless && Own(5) * -endless == -endless);
  EXPECT_EQ(static_cast<double>(endless), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(static_cast<double>(nan)));
  EXPECT_TRUE(Own(1) - Own(1) == zero);
}

}  // namespace
}  // namespace clusterbench::geom
