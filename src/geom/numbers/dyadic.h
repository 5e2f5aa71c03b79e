#pragma once
// Whole numbers times powers of two: floats, doubles, and results of + - * on them, exactly. On the stack, without a
// greatest common divisor. Decisions need only signs: every predicate on such numbers can be written without quotients.

#include <array>
#include <cstdint>
#include <stdexcept>

#include "geom/numbers/square_roots.h"

namespace clusterbench::geom {

// A number that needs more digits than a Dyadic has.
struct TooWide : std::runtime_error {
  TooWide() : std::runtime_error("an exact number needs more than 8192 bits") {}
};

class Dyadic {
 public:
  // 8192 bits. A decision on numbers of a map needs about 300; numbers whose magnitudes are 2^1000 apart need more.
  static constexpr int k_limbs = 128;

  Dyadic() = default;
  // value: finite.
  explicit Dyadic(double value);
  Dyadic(const Dyadic& other);
  Dyadic& operator=(const Dyadic& other);

  // -1, 0 or 1.
  int sign() const { return count_ == 0 ? 0 : is_negative_ ? -1 : 1; }

  Dyadic operator-() const;
  // These throw TooWide.
  friend Dyadic operator+(const Dyadic& a, const Dyadic& b) { return sum(a, b, b.is_negative_); }
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return sum(a, b, !b.is_negative_); }
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b);

  friend bool operator<(const Dyadic& a, const Dyadic& b) { return (a - b).sign() < 0; }
  friend bool operator<=(const Dyadic& a, const Dyadic& b) { return (a - b).sign() <= 0; }
  friend bool operator>(const Dyadic& a, const Dyadic& b) { return b < a; }
  friend bool operator>=(const Dyadic& a, const Dyadic& b) { return b <= a; }

 private:
  using Limb = std::uint64_t;

  // a ± |b|.
  static Dyadic sum(const Dyadic& a, const Dyadic& b, bool b_is_negative);
  // The magnitude with zero bits appended, down to a lower exponent. Written to `out`; returns the number of limbs.
  static int lowered(const Dyadic& a, int exponent, std::array<Limb, k_limbs>& out);
  void trim();

  // The value is ± the whole number in limbs_, least significant first, times 2^exponent_. No leading zero limb.
  std::array<Limb, k_limbs> limbs_;  // the first count_ of them are set
  int count_ = 0, exponent_ = 0;
  bool is_negative_ = false;
};

}  // namespace clusterbench::geom
