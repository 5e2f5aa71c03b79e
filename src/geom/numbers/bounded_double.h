#pragma once
// Doubles with a bound of their distance from the true number. The bound is 0 where nothing was rounded. That is the
// usual case on lattices, where thousands of lights touch cells exactly; there, equal numbers are known to be equal.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace clusterbench::geom {

// |value - true number| <= error.
struct Bounded {
  double value = 0.0, error = 0.0;

  Bounded() = default;
  // Implicit, because a double represents itself exactly.
  Bounded(double exactly) : value(exactly) {}
  Bounded(double rounded, double by) : value(rounded), error(by) {}

  bool is_surely_not_above(double limit) const { return value - limit <= -k_more * error; }
  bool is_surely_above(double limit) const { return value - limit > k_more * error; }

  Bounded operator-() const { return {-value, error}; }

 private:
  // More than the rounding of a difference and a product.
  static constexpr double k_more = 1.0 + 0x1p-50;
};

namespace bounded {

// Errors are sums and products of a few non-negative doubles. This makes up for their rounding, and for products that
// underflow.
inline double rounded_up(double error) {
  return error * (1.0 + 0x1p-48) + 0x1p-1000;
}

// The number of zero bits at the end of a double's 53 bits.
inline int free_digits(double value) {
  return std::countr_zero(std::bit_cast<std::uint64_t>(value) | std::uint64_t{1} << 52);
}

// Does the product need no more than 53 bits, and is it well above the smallest numbers?
inline bool is_exact_product(double a, double b, double product) {
  if (a == 0.0 || b == 0.0) return true;
  return free_digits(a) + free_digits(b) >= 53 && std::abs(product) > 0x1p-900;
}

}  // namespace bounded

inline Bounded operator+(const Bounded& a, const Bounded& b) {
  const double sum = a.value + b.value;
  // The rounding error (Knuth 1969): always a double.
  const double from_b = sum - a.value;
  const double lost = (a.value - (sum - from_b)) + (b.value - from_b);
  const double error = a.error + b.error + std::abs(lost);
  return {sum, error == 0.0 ? 0.0 : bounded::rounded_up(error)};
}

inline Bounded operator-(const Bounded& a, const Bounded& b) {
  return a + -b;
}

// Products of errors may underflow, but must not become 0.
inline Bounded operator*(const Bounded& a, const Bounded& b) {
  const double product = a.value * b.value;
  if ((a.value == 0.0 && a.error == 0.0) || (b.value == 0.0 && b.error == 0.0)) return product;
  const bool is_exact = bounded::is_exact_product(a.value, b.value, product);
  if (is_exact && a.error == 0.0 && b.error == 0.0) return product;
  const double roundoff = is_exact ? 0.0 : std::abs(product) * 0x1p-53;
  return {product, bounded::rounded_up(std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error +
                                       roundoff)};
}

// |a/b - a'/b'| <= (error of a + |a'/b'| * error of b) / |b|. Exact where the product of quotient and divisor is.
inline Bounded operator/(const Bounded& a, const Bounded& b) {
  const double divisor = std::abs(b.value) * (1.0 - 0x1p-50) - b.error * (1.0 + 0x1p-50);
  if (!(divisor > 0.0)) return {0.0, std::numeric_limits<double>::infinity()};
  const double quotient = a.value / b.value, product = quotient * b.value;
  if (a.error == 0.0 && b.error == 0.0 && product == a.value && bounded::is_exact_product(quotient, b.value, product))
    return quotient;
  return {quotient, bounded::rounded_up((a.error + std::abs(quotient) * b.error) / divisor +
                                        std::abs(quotient) * 0x1p-53 + 0x1p-1000 / divisor)};
}

// The larger of two; if it is uncertain which one is larger, a bound that covers both.
inline Bounded larger_of(const Bounded& a, const Bounded& b) {
  const Bounded &high = a.value < b.value ? b : a, &low = a.value < b.value ? a : b;
  const bool is_sure = high.value - low.value >= bounded::rounded_up(high.error + low.error);
  return {high.value, is_sure || (high.error == 0.0 && low.error == 0.0) ? high.error : std::max(a.error, b.error)};
}

// The largest of a, b and 0.
inline Bounded largest_or_zero(const Bounded& a, const Bounded& b) {
  const Bounded larger = larger_of(a, b);
  if (larger.value > 0.0) return larger;
  const double most = larger.error == 0.0 ? 0.0 : bounded::rounded_up(larger.value + larger.error);
  return {0.0, std::max(most, 0.0)};
}

// Root of the part that is not negative: for numbers that are known not to be negative.
inline Bounded sqrt(const Bounded& a) {
  if (a.value <= a.error)
    return {0.0, a.error == 0.0 ? 0.0 : bounded::rounded_up(std::sqrt(std::max(a.value, 0.0) + a.error))};
  const double root = std::sqrt(a.value), square = root * root;
  if (a.error == 0.0 && square == a.value && bounded::is_exact_product(root, root, square)) return root;
  return {root, bounded::rounded_up(a.error / root + root * 0x1p-52)};
}

}  // namespace clusterbench::geom
