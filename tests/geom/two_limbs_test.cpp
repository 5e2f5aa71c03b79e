// Our own numbers of 128 bits against the compiler's.

#include "geom/numbers/two_limbs.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace clusterbench::geom {
namespace {

#ifdef __SIZEOF_INT128__
using Limb = OwnTwoLimbs::Limb;

struct Both {
  TwoLimbs known;
  OwnTwoLimbs own;
};

bool are_equal(TwoLimbs known, OwnTwoLimbs own) {
  return static_cast<Limb>(known) == static_cast<Limb>(own) &&
         static_cast<Limb>(known >> 64) == static_cast<Limb>(own >> 64);
}

// Few bits, all bits, and all in between: carries need long rows of ones.
Limb random_limb(std::mt19937_64& random) {
  const Limb bits = random();
  switch (random() % 6) {
    case 0:
      return 0;
    case 1:
      return ~Limb{0};
    case 2:
      return ~Limb{0} << random() % 64;
    case 3:
      return ~Limb{0} >> random() % 64;
    case 4:
      return bits >> random() % 64;
    default:
      return bits;
  }
}

Both random_number(std::mt19937_64& random) {
  const Limb high = random_limb(random), low = random_limb(random);
  return {static_cast<TwoLimbs>(high) << 64 | low, OwnTwoLimbs(high, low)};
}

TEST(TwoLimbs, own_sums_differences_and_products_are_the_compilers) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const Both a = random_number(random), b = random_number(random);
    ASSERT_TRUE(are_equal(a.known + b.known, a.own + b.own)) << i;
    ASSERT_TRUE(are_equal(a.known - b.known, a.own - b.own)) << i;
    ASSERT_TRUE(are_equal(a.known * b.known, a.own * b.own)) << i;
    ASSERT_TRUE(are_equal(a.known | b.known, a.own | b.own)) << i;
    Both less = a;
    ASSERT_TRUE(are_equal(--less.known, --less.own)) << i;
  }
}

TEST(TwoLimbs, own_numbers_have_the_compilers_order) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100'000; ++i) {
    const Both a = random_number(random), b = random_number(random);
    ASSERT_EQ(a.known > b.known, a.own > b.own) << i;
    ASSERT_EQ(a.known == b.known, a.own == b.own) << i;
  }
}

TEST(TwoLimbs, own_shifts_are_the_compilers) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 1000; ++i)
    for (unsigned bits = 0; bits < 128; ++bits) {
      const Both a = random_number(random);
      ASSERT_TRUE(are_equal(a.known << bits, a.own << bits)) << bits;
      ASSERT_TRUE(are_equal(a.known >> bits, a.own >> bits)) << bits;
    }
}

TEST(TwoLimbs, own_quotients_and_rests_by_a_limb_are_the_compilers) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 20'000; ++i) {
    const Both a = random_number(random);
    const Limb b = random_limb(random) | 1;
    ASSERT_TRUE(are_equal(a.known / b, a.own / b)) << i;
    ASSERT_TRUE(are_equal(a.known % b, a.own % b)) << i;
  }
}
#endif

}  // namespace
}  // namespace clusterbench::geom
