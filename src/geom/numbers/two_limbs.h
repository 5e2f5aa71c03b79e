#pragma once
// Whole numbers of two limbs, 128 bits without a sign, modulo 2^128: the compiler's, or our own where it has none
// (Microsoft's). Both are always compiled, and a test compares them.

#include <bit>
#include <compare>
#include <cstdint>
#include <limits>
#include <type_traits>

#if defined(_MSC_VER) && defined(_M_X64)
#include <intrin.h>
#endif

namespace clusterbench::geom {

class OwnTwoLimbs {
 public:
  using Limb = std::uint64_t;

  constexpr OwnTwoLimbs() = default;
  constexpr OwnTwoLimbs(Limb low) : low_(low) {}
  constexpr OwnTwoLimbs(Limb high, Limb low) : high_(high), low_(low) {}

  explicit constexpr operator Limb() const { return low_; }

  friend constexpr OwnTwoLimbs operator+(OwnTwoLimbs a, OwnTwoLimbs b) {
    const Limb low = a.low_ + b.low_;
    return {a.high_ + b.high_ + (low < a.low_ ? 1 : 0), low};
  }
  friend constexpr OwnTwoLimbs operator-(OwnTwoLimbs a, OwnTwoLimbs b) {
    return {a.high_ - b.high_ - (a.low_ < b.low_ ? 1 : 0), a.low_ - b.low_};
  }
  friend constexpr OwnTwoLimbs operator*(OwnTwoLimbs a, OwnTwoLimbs b) {
    OwnTwoLimbs out = product(a.low_, b.low_);
    out.high_ += a.high_ * b.low_ + a.low_ * b.high_;
    return out;
  }
  friend constexpr OwnTwoLimbs operator|(OwnTwoLimbs a, OwnTwoLimbs b) { return {a.high_ | b.high_, a.low_ | b.low_}; }
  // By fewer than 128 bits.
  friend constexpr OwnTwoLimbs operator<<(OwnTwoLimbs a, unsigned bits) {
    if (bits == 0) return a;
    if (bits >= k_bits) return {a.low_ << (bits - k_bits), 0};
    return {a.high_ << bits | a.low_ >> (k_bits - bits), a.low_ << bits};
  }
  friend constexpr OwnTwoLimbs operator>>(OwnTwoLimbs a, unsigned bits) {
    if (bits == 0) return a;
    if (bits >= k_bits) return {0, a.high_ >> (bits - k_bits)};
    return {a.high_ >> bits, a.low_ >> bits | a.high_ << (k_bits - bits)};
  }
  // By a limb, which is not 0.
  friend constexpr OwnTwoLimbs operator/(OwnTwoLimbs a, Limb b) {
    Limb rest = 0;
    return divided(a, b, rest);
  }
  friend constexpr OwnTwoLimbs operator%(OwnTwoLimbs a, Limb b) {
    Limb rest = 0;
    divided(a, b, rest);
    return rest;
  }

  constexpr OwnTwoLimbs& operator+=(OwnTwoLimbs b) { return *this = *this + b; }
  constexpr OwnTwoLimbs& operator--() { return *this = *this - OwnTwoLimbs(1); }

  friend constexpr auto operator<=>(const OwnTwoLimbs&, const OwnTwoLimbs&) = default;

 private:
  static constexpr unsigned k_bits = std::numeric_limits<Limb>::digits;

  // By halves of limbs, as one multiplies on paper.
  static constexpr OwnTwoLimbs product(Limb a, Limb b) {
#if defined(_MSC_VER) && defined(_M_X64)
    if (!std::is_constant_evaluated()) {
      Limb high = 0;
      const Limb low = _umul128(a, b, &high);
      return {high, low};
    }
#endif
    constexpr unsigned k_half = k_bits / 2;
    constexpr Limb k_low = (Limb{1} << k_half) - 1;
    const Limb a_low = a & k_low, a_high = a >> k_half, b_low = b & k_low, b_high = b >> k_half;
    const Limb low = a_low * b_low;
    const Limb middle = a_high * b_low + (low >> k_half);
    const Limb other = a_low * b_high + (middle & k_low);
    return {a_high * b_high + (middle >> k_half) + (other >> k_half), other << k_half | (low & k_low)};
  }

  // Bit by bit; the rest stays below the divisor, so that at most one bit is pushed out of its limb.
  static constexpr OwnTwoLimbs divided(OwnTwoLimbs a, Limb b, Limb& rest) {
    OwnTwoLimbs quotient;
    for (unsigned at = 2 * k_bits; at-- > 0;) {
      const bool is_beyond = rest >> (k_bits - 1) != 0;
      rest = rest << 1 | (static_cast<Limb>(a >> at) & 1);
      const bool fits = is_beyond || rest >= b;
      if (fits) rest -= b;
      quotient = quotient << 1 | OwnTwoLimbs(fits ? 1 : 0);
    }
    return quotient;
  }

  Limb high_ = 0, low_ = 0;  // in the order in which they are compared
};

// clang for Microsoft's linker has the type, and not the functions that divide it.
#if defined(__SIZEOF_INT128__) && !defined(_MSC_VER)
__extension__ using TwoLimbs = unsigned __int128;
#else
using TwoLimbs = OwnTwoLimbs;
#endif

}  // namespace clusterbench::geom
