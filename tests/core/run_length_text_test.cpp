#include "core/run_length_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace clusterbench {
namespace {

std::string text(const std::vector<std::uint32_t>& numbers) {
  return run_length_text(numbers);
}
std::string text(const std::vector<double>& numbers) {
  return run_length_text(numbers);
}

TEST(RunLengthText, repeats_are_counted_and_no_numbers_are_no_text) {
  EXPECT_EQ(text(std::vector<std::uint32_t>{}), "");
  EXPECT_EQ(text(std::vector<std::uint32_t>{7}), "7");
  EXPECT_EQ(text(std::vector<std::uint32_t>{5, 1, 1, 1, 0, 0, 4294967295u}), "5 1*3 0*2 4294967295");
}

TEST(RunLengthText, reals_have_six_digits_and_infinity_a_name) {
  constexpr double k_infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(text(std::vector<double>{0.25, -1.0 / 3.0, 1234567.0, 1e-9, -0.0, k_infinity, k_infinity}),
            "0.25 -0.333333 1.23457e+06 1e-09 0 Infinity*2");
}

TEST(RunLengthText, gaps_begin_with_the_first_number) {
  const std::vector<std::uint32_t> ascending{3, 4, 5, 9};
  EXPECT_EQ(gaps_of(ascending), (std::vector<std::uint32_t>{3, 1, 1, 4}));
  EXPECT_TRUE(gaps_of({}).empty());
}

}  // namespace
}  // namespace clusterbench
