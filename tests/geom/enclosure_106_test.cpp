// Numbers of 106 bits between bounds against exact arithmetic, at all sizes that scenes have.

#include "geom/numbers/enclosure_106.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "effort.h"
#include "geom/numbers/rational_trigonometry.h"

namespace clusterbench::geom {
namespace {

Rational rational(const DoubleDouble& value) {
  return exact(value.hi) + exact(value.lo);
}

bool holds_exactly(const Enclosure106& tight, const Rational& value) {
  if (std::isinf(tight.radius())) return true;
  return abs(rational(tight.middle()) - value) <= exact(tight.radius());
}

// A number with bits beyond a double's, and what is known of it a little off-centre and wider.
struct Known {
  Rational value;
  Enclosure106 tight;
};

Known random_number(SplitMix64& random) {
  const double hi = std::ldexp(random.between(-1, 1), static_cast<int>(random.below(80)) - 40);
  const double lo = hi * random.between(-1, 1) * 0x1p-54;
  const DoubleDouble middle = DoubleDouble::exact_sum(hi, lo);
  const double radius = random.below(2) == 0 ? 0.0 : std::abs(hi) * std::ldexp(random.unit(), -60);
  return {rational(middle) + exact(radius * random.between(-1, 1)), Enclosure106(middle, radius)};
}

TEST(Enclosure106, holds_what_exact_arithmetic_gives_and_little_more) {
  SplitMix64 random(41);
  for (int i = 0; i < test::tries(20000); ++i) {
    const Known a = random_number(random), b = random_number(random);
    const auto expect = [&](const Enclosure106& found, const Rational& value, const Rational& size) {
      EXPECT_TRUE(holds_exactly(found, value)) << i;
      if (a.tight.radius() == 0.0 && b.tight.radius() == 0.0) {
        EXPECT_LE(exact(found.radius()), size * exact(0x1p-98)) << i;
      }
    };
    expect(a.tight + b.tight, a.value + b.value, abs(a.value) + abs(b.value));
    expect(a.tight - b.tight, a.value - b.value, abs(a.value) + abs(b.value));
    expect(a.tight * b.tight, a.value * b.value, abs(a.value * b.value));
    expect(a.tight / b.tight, a.value / b.value, abs(a.value / b.value));
    const Enclosure106 root = sqrt(a.tight * a.tight);
    expect(root, abs(a.value), abs(a.value));
    const Enclosure106 root_of_b = sqrt(b.value < 0 ? -b.tight : b.tight);
    EXPECT_TRUE(holds_exactly(root_of_b * root_of_b, abs(b.value)));
  }
}

TEST(Enclosure106, compares_only_what_is_certain) {
  const Enclosure106 x(DoubleDouble(1.0), 0x1p-60), y = Enclosure106(1.0) + Enclosure106(0x1p-90);
  EXPECT_FALSE(x < Enclosure106(1.0) || Enclosure106(1.0) < x || x == x);
  EXPECT_TRUE(Enclosure106(1.0) < y && y > Enclosure106(1.0));
  EXPECT_TRUE(Enclosure106(1.0 - 0x1p-53) < x);
  const Enclosure106 unknown = Enclosure106(1.0) / Enclosure106(DoubleDouble(0.0), 1e-300);
  EXPECT_FALSE(unknown < Enclosure106(1e300) || unknown > Enclosure106(-1e300));
  const Enclosure106 after = Enclosure106(0.0) * unknown + Enclosure106(1.0),
                     overflow = Enclosure106(1e300) * Enclosure106(1e300);
  EXPECT_FALSE(after < Enclosure106(1e300) || overflow > Enclosure106(0.0) || sqrt(unknown) < Enclosure106(1e300));
}

TEST(Enclosure106, is_not_certain_of_what_underflows) {
  const Enclosure106 tiny(1e-300), product = tiny * tiny, ratio = tiny / Enclosure106(3.0);
  EXPECT_FALSE(product > Enclosure106(0.0));
  EXPECT_FALSE(product == Enclosure106(0.0));
  EXPECT_TRUE(holds_exactly(product, exact(1e-300) * exact(1e-300)));
  EXPECT_TRUE(holds_exactly(ratio, exact(1e-300) / 3));
  EXPECT_TRUE(holds_exactly(sqrt(tiny) * sqrt(tiny), exact(1e-300)));
}

TEST(Angle106, holds_cosine_and_sine_of_every_angle) {
  SplitMix64 random(43);
  for (int i = 0; i < test::tries(300); ++i) {
    const double angle = i == 0 ? 0.0 : i == 1 ? 5e-324 : random.between(0, 1.99) * std::ldexp(1.0, -(i % 70));
    const AngleBounds bounds = bounds_of_angle(exact(angle), 320);
    const Angle106 found = angle_106(Enclosure106(angle));
    EXPECT_TRUE(holds_exactly(found.cosine, bounds.cosine.lo) || holds_exactly(found.cosine, bounds.cosine.hi))
        << angle;
    EXPECT_TRUE(holds_exactly(found.sine, bounds.sine.lo) || holds_exactly(found.sine, bounds.sine.hi)) << angle;
    EXPECT_LT(found.cosine.radius(), 0x1p-94);
    EXPECT_LT(found.sine.radius(), 0x1p-92 * angle + 0x1p-600) << angle;
  }
}

TEST(RootsIn106Bits, hold_single_and_multiple_roots) {
  for (const std::array<double, 4>& roots :
       {std::array{-0.7, -0.1, 0.3, 0.9}, {0.3, 0.3, -0.2, 5.0}, {0.3, 0.3, 0.3, 5.0}, {-1.0, 1.0, 0.0, 0.5}}) {
    Polynomial<Enclosure106> p{
        {Enclosure106(1.0), Enclosure106(0.0), Enclosure106(0.0), Enclosure106(0.0), Enclosure106(0.0)}, 4};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = i + 2; k-- > 0;)
        p.c[k] = (k > 0 ? p.c[k - 1] : Enclosure106(0.0)) - Enclosure106(roots[i]) * p.c[k];
    const Roots<Enclosure106> places = roots_of(p, 80);
    for (const double root : roots) {
      if (std::abs(root) > 1.0) continue;
      EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](const Enclosure106& place) {
        return holds_exactly(place, exact(root));
      })) << root;
    }
  }
}

}  // namespace
}  // namespace clusterbench::geom
