#include "report/sizing/counts.h"

#include <limits>

namespace clusterbench::report {
namespace {

constexpr std::uint64_t k_largest_count = std::numeric_limits<std::uint64_t>::max();

}  // namespace

std::uint64_t sum_of_counts(std::uint64_t a, std::uint64_t b) {
  return a > k_largest_count - b ? k_largest_count : a + b;
}

std::uint64_t product_of_counts(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > k_largest_count / b ? k_largest_count : a * b;
}

std::uint64_t up_to_multiple(std::uint64_t value, std::uint64_t step) {
  const std::uint64_t over = value % step;
  return over == 0 || value > k_largest_count - (step - over) ? value : value + (step - over);
}

std::uint64_t as_count(double value) {
  constexpr double k_end = 18446744073709551616.0;  // 2^64
  return value >= k_end ? k_largest_count : static_cast<std::uint64_t>(value);
}

}  // namespace clusterbench::report
