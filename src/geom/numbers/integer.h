#pragma once
// Whole numbers without limit. Multiplied and divided as on paper: those of exact decisions have a few dozen limbs.

#include <compare>
#include <concepts>
#include <cstdint>
#include <vector>

namespace clusterbench::geom {

// Magnitudes: limbs, least significant first, without a leading zero; none for 0.
using Limb = std::uint64_t;
using Limbs = std::vector<Limb>;
inline constexpr unsigned k_limb_bits = 64;

class Integer {
 public:
  Integer() = default;
  template <std::integral Number>
  Integer(Number value) : is_negative_(value < 0) {
    if (value != 0) limbs_.assign(1, value < 0 ? Limb{0} - static_cast<Limb>(value) : static_cast<Limb>(value));
  }
  Integer(Limbs magnitude, bool is_negative);

  // -1, 0 or 1.
  int sign() const { return limbs_.empty() ? 0 : is_negative_ ? -1 : 1; }
  // Of the magnitude: its length, and the zeros at its end (0 for 0).
  unsigned bits() const;
  unsigned zeros() const;
  const Limbs& limbs() const { return limbs_; }

  Integer operator-() const { return {limbs_, !is_negative_}; }
  friend Integer operator+(const Integer& a, const Integer& b) { return sum(a, b, b.is_negative_); }
  friend Integer operator-(const Integer& a, const Integer& b) { return sum(a, b, !b.is_negative_); }
  friend Integer operator*(const Integer& a, const Integer& b);
  // Quotients are rounded towards 0; b is not 0.
  friend Integer operator/(const Integer& a, const Integer& b);
  friend Integer operator%(const Integer& a, const Integer& b);
  // Of the magnitude.
  friend Integer operator<<(const Integer& a, unsigned bits);
  friend Integer operator>>(const Integer& a, unsigned bits);
  Integer& operator+=(const Integer& b) { return *this = *this + b; }
  Integer& operator-=(const Integer& b) { return *this = *this - b; }

  friend bool operator==(const Integer& a, const Integer& b) { return a.limbs_ == b.limbs_ && a.sign() == b.sign(); }
  friend std::strong_ordering operator<=>(const Integer& a, const Integer& b);

  // The largest whole number that is not above the root; a is not negative.
  friend Integer sqrt(const Integer& a);
  // Of the magnitudes; neither is 0.
  friend Integer greatest_common_divisor(Integer a, Integer b);

 private:
  static Integer sum(const Integer& a, const Integer& b, bool b_is_negative);

  Limbs limbs_;
  bool is_negative_ = false;
};

}  // namespace clusterbench::geom
