#include "view/number_formats.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "core/random.h"

namespace clusterbench::view {
namespace {

constexpr float k_float_infinity = std::numeric_limits<float>::infinity();
constexpr std::uint16_t k_half_infinity = 0x7c00;

// By the definition of binary16: 1 sign, 5 exponent, 10 fraction bits. Finite ones.
double by_definition(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double magnitude = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return (bits & 0x8000) != 0 ? -magnitude : magnitude;
}

bool is_nan(std::uint16_t bits) {
  return (bits & 0x7fff) > k_half_infinity;
}

TEST(Half, every_one_of_the_65536_is_read_by_its_definition_and_written_back) {
  for (int i = 0; i < 65536; ++i) {
    const auto bits = static_cast<std::uint16_t>(i);
    const float value = float_of_half(bits);
    if (is_nan(bits)) {
      EXPECT_TRUE(std::isnan(value)) << i;
      EXPECT_TRUE(is_nan(half_of(value))) << i;
      continue;
    }
    if ((bits & 0x7fff) != k_half_infinity) {
      ASSERT_EQ(static_cast<double>(value), by_definition(bits)) << i;
    }
    ASSERT_EQ(std::signbit(value), (bits & 0x8000) != 0) << i;
    ASSERT_EQ(half_of(value), bits) << i;
  }
  EXPECT_EQ(float_of_half(k_half_infinity), k_float_infinity);
}

// Rounding is monotone, so its steps say all of it: they lie at the middles between neighbours, which are floats.
TEST(Half, rounds_to_the_nearest_and_halves_to_even_between_all_neighbours) {
  for (std::uint16_t below = 0; below < k_half_infinity; ++below) {
    const auto above = static_cast<std::uint16_t>(below + 1);
    const double upper = above == k_half_infinity ? 65536.0 : by_definition(above);
    const auto middle = static_cast<float>(0.5 * (by_definition(below) + upper));
    ASSERT_EQ(half_of(std::nextafter(middle, 0.0f)), below) << below;
    ASSERT_EQ(half_of(middle), below % 2 == 0 ? below : above) << below;
    ASSERT_EQ(half_of(std::nextafter(middle, k_float_infinity)), above) << below;
    ASSERT_EQ(half_of(-middle), half_of(middle) | 0x8000) << below;
  }
  EXPECT_EQ(half_of(65519.9f), half_of(k_largest_half));
  EXPECT_EQ(half_of(3e38f), k_half_infinity);
  EXPECT_EQ(half_of(-k_float_infinity), k_half_infinity | 0x8000);
  EXPECT_EQ(half_of(std::numeric_limits<float>::denorm_min()), 0);
}

#ifdef __FLT16_MANT_DIG__
TEST(Half, is_what_the_compiler_makes_of_it) {
  constexpr std::uint64_t k_stride = 4099;  // a prime, so that all bits vary
  for (std::uint64_t i = 0; i <= 0xffffffffu; i += k_stride) {
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(i));
    if (std::isnan(value)) continue;
    ASSERT_EQ(half_of(value), std::bit_cast<std::uint16_t>(static_cast<_Float16>(value))) << value;
  }
}
#endif

TEST(Half, not_below_is_the_smallest_that_is_not_below) {
  for (std::uint16_t below = 0; below < k_half_infinity - 1; ++below) {
    const float value = float_of_half(below);
    ASSERT_EQ(half_not_below(value), below);
    ASSERT_EQ(half_not_below(std::nextafter(value, k_float_infinity)), below + 1);
  }
  EXPECT_EQ(half_not_below(k_largest_half), k_half_infinity - 1);
  EXPECT_EQ(half_not_below(65504.01f), k_half_infinity);
  EXPECT_EQ(half_not_below(k_float_infinity), k_half_infinity);
}

TEST(Half, rounding_is_what_a_value_can_have_lost_and_no_more) {
  for (std::uint16_t bits = 1; bits < k_half_infinity; ++bits) {
    const double value = by_definition(bits), next = bits + 1 == k_half_infinity ? 65536.0 : by_definition(bits + 1);
    ASSERT_EQ(half_rounding(static_cast<float>(value)), 0.5 * (next - value)) << bits;
    ASSERT_GE(half_rounding(static_cast<float>(-value)), 0.5 * (value - by_definition(bits - 1))) << bits;
  }
  EXPECT_EQ(half_rounding(0.0f), 0x1p-25f);
}

TEST(Norm16, every_step_comes_back_and_between_two_the_nearer_one_is_taken) {
  for (int i = 0; i <= 65535; ++i) {
    ASSERT_EQ(unorm16_of(i / k_unorm16_steps), i);
    ASSERT_EQ(unorm16_of((i + 0.49) / k_unorm16_steps), i);
    ASSERT_EQ(unorm16_of((i - 0.49) / k_unorm16_steps), i);
    ASSERT_EQ(unorm16_not_below((i - 0.49) / k_unorm16_steps), i);
  }
  for (int i = -32767; i <= 32767; ++i) {
    ASSERT_EQ(snorm16_of((i + 0.49) / k_snorm16_steps), i);
    ASSERT_EQ(snorm16_of((i - 0.49) / k_snorm16_steps), i);
  }
  EXPECT_EQ(unorm16_of(1.5), 65535);
  EXPECT_EQ(unorm16_of(-1.0), 0);
  EXPECT_EQ(snorm16_of(-2.0), -32767);
}

double turn_between(const Vec3d& a, const Vec3d& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(Octahedral, no_direction_turns_by_more_than_its_bound_and_some_by_nearly_as_much) {
  SplitMix64 random(5);
  double worst = 0.0;
  for (int i = 0; i < 400000; ++i) {
    const Vec3d ball{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const Vec3d unit = glm::normalize(ball);
    worst = std::max(worst, turn_between(unit, unit_of(octahedral_of(unit))));
  }
  EXPECT_LE(worst, k_octahedral_rad);
  EXPECT_GT(worst, 0.9 * k_octahedral_rad);
}

TEST(Octahedral, axes_and_their_diagonals_come_back) {
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3d unit = glm::normalize(Vec3d(x, y, z));
        EXPECT_LE(turn_between(unit, unit_of(octahedral_of(unit))), k_octahedral_rad) << x << y << z;
      }
  EXPECT_EQ(unit_of(octahedral_of({0, 0, -1})), Vec3d(0, 0, -1));
  EXPECT_EQ(unit_of(octahedral_of({0, 0, 1})), Vec3d(0, 0, 1));
}

}  // namespace
}  // namespace clusterbench::view
