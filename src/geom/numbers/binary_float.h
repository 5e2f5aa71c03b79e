#pragma once
// Floating point with a fixed number of bits. Results are rounded to nearest, ties to even; the exponent has 64 bits.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <concepts>
#include <cstdint>
#include <limits>

#include "geom/numbers/integer.h"
#include "geom/numbers/two_limbs.h"

namespace clusterbench::geom {

template <unsigned bits>
class BinaryFloat {
  static constexpr std::size_t k_limbs = bits / k_limb_bits;
  static_assert(k_limbs * k_limb_bits == bits && k_limbs > 0);
  using Digits = std::array<Limb, k_limbs>;
  template <unsigned>
  friend class BinaryFloat;

 public:
  BinaryFloat() = default;
  template <std::integral Number>
  BinaryFloat(Number value) : BinaryFloat(Integer(value)) {}
  template <std::floating_point Number>
  BinaryFloat(Number value) {
    if (std::isnan(value)) kind_ = Kind::nan;
    if (std::isinf(value)) kind_ = Kind::infinite;
    is_negative_ = std::signbit(value);
    if (value == Number(0) || !std::isfinite(value)) return;
    int exponent = 0;
    const double part = std::frexp(std::abs(static_cast<double>(value)), &exponent);
    kind_ = Kind::number;
    exponent_ = exponent;
    digits_[k_limbs - 1] = static_cast<Limb>(std::ldexp(part, 64));
  }
  explicit BinaryFloat(const Integer& value) : is_negative_(value.sign() < 0) {
    if (value.sign() == 0) return;
    kind_ = Kind::number;
    exponent_ = value.bits();
    const unsigned below = value.bits() > bits ? value.bits() - bits : 0;
    const Integer top = below > 0 ? value >> below : value << (bits - value.bits());
    std::copy(top.limbs().begin(), top.limbs().end(), digits_.begin());
    if (below > 0) round((value >> (below - 1)).zeros() == 0, value.zeros() + 1 < below);
  }
  template <unsigned others>
  requires(others != bits) explicit BinaryFloat(const BinaryFloat<others>& other) {
    if (other.kind_ == BinaryFloat<others>::Kind::number) {
      *this = made(other.digits_, other.exponent_, other.is_negative_, false);
    } else {
      kind_ = static_cast<Kind>(other.kind_);
      is_negative_ = other.is_negative_;
    }
  }

  explicit operator double() const {
    if (kind_ == Kind::nan) return std::numeric_limits<double>::quiet_NaN();
    double size = kind_ == Kind::zero ? 0.0 : std::numeric_limits<double>::infinity();
    if (kind_ == Kind::number && exponent_ <= 2000) {
      const bool has_more = std::any_of(digits_.begin(), digits_.end() - 1, [](Limb limb) { return limb != 0; });
      const Limb top = digits_[k_limbs - 1] | (has_more ? 1 : 0);
      // Rounded once, to the bits that a double of this size has: 53, or fewer below 2^-1022.
      const std::int64_t kept = std::min<std::int64_t>(53, exponent_ + 1074);
      if (kept < 0) return is_negative_ ? -0.0 : 0.0;
      const auto dropped = static_cast<unsigned>(k_limb_bits - kept);
      const Limb half = Limb{1} << (dropped - 1), rest = top & (half | (half - 1));
      Limb digits = dropped == k_limb_bits ? 0 : top >> dropped;
      if (rest > half || (rest == half && digits % 2 == 1)) ++digits;
      size = std::ldexp(static_cast<double>(digits), static_cast<int>(exponent_ - kept));
    }
    return is_negative_ ? -size : size;
  }
  // Towards 0; for a number.
  explicit operator Integer() const {
    if (kind_ == Kind::zero || exponent_ <= 0) return 0;
    const Integer all(Limbs(digits_.begin(), digits_.end()), is_negative_);
    return exponent_ >= bits ? all << static_cast<unsigned>(exponent_ - bits)
                             : all >> static_cast<unsigned>(bits - exponent_);
  }

  BinaryFloat operator-() const {
    BinaryFloat out = *this;
    out.is_negative_ = !is_negative_;
    return out;
  }
  friend BinaryFloat operator+(const BinaryFloat& a, const BinaryFloat& b) { return sum(a, b); }
  friend BinaryFloat operator-(const BinaryFloat& a, const BinaryFloat& b) { return sum(a, -b); }
  friend BinaryFloat operator*(const BinaryFloat& a, const BinaryFloat& b) { return a.times(b); }
  friend BinaryFloat operator/(const BinaryFloat& a, const BinaryFloat& b) { return a.over(b); }
  BinaryFloat& operator+=(const BinaryFloat& b) { return *this = *this + b; }
  BinaryFloat& operator-=(const BinaryFloat& b) { return *this = *this - b; }
  BinaryFloat& operator*=(const BinaryFloat& b) { return *this = *this * b; }
  BinaryFloat& operator/=(const BinaryFloat& b) { return *this = *this / b; }

  friend std::partial_ordering operator<=>(const BinaryFloat& a, const BinaryFloat& b) {
    if (a.kind_ == Kind::nan || b.kind_ == Kind::nan) return std::partial_ordering::unordered;
    if (a.sign() != b.sign()) return a.sign() <=> b.sign();
    return a.sign() < 0 ? 0 <=> compared(a, b) : compared(a, b) <=> 0;
  }
  friend bool operator==(const BinaryFloat& a, const BinaryFloat& b) { return std::is_eq(a <=> b); }

  friend BinaryFloat abs(const BinaryFloat& a) { return a.is_negative_ ? -a : a; }
  friend BinaryFloat ldexp(BinaryFloat a, std::int64_t exponent) {
    a.exponent_ += exponent;
    return a;
  }
  friend BinaryFloat frexp(BinaryFloat a, int* exponent) {
    *exponent = a.kind_ == Kind::number ? static_cast<int>(a.exponent_) : 0;
    if (a.kind_ == Kind::number) a.exponent_ = 0;
    return a;
  }
  // Series; for angles of a few radians.
  friend BinaryFloat cos(const BinaryFloat& angle) { return series(angle, BinaryFloat(1), 1); }
  friend BinaryFloat sin(const BinaryFloat& angle) { return series(angle, angle, 2); }

  static BinaryFloat infinity() {
    BinaryFloat out;
    out.kind_ = Kind::infinite;
    return out;
  }

 private:
  enum class Kind : std::uint8_t { zero, number, infinite, nan };

  static BinaryFloat not_a_number() {
    BinaryFloat out;
    out.kind_ = Kind::nan;
    return out;
  }
  BinaryFloat with_sign(bool is_negative) const {
    BinaryFloat out = *this;
    out.is_negative_ = is_negative;
    return out;
  }
  int sign() const { return kind_ == Kind::zero ? 0 : is_negative_ ? -1 : 1; }

  // Of the magnitudes; neither is nan.
  static int compared(const BinaryFloat& a, const BinaryFloat& b) {
    if (a.kind_ != b.kind_) return a.kind_ < b.kind_ ? -1 : 1;
    if (a.kind_ != Kind::number) return 0;
    if (a.exponent_ != b.exponent_) return a.exponent_ < b.exponent_ ? -1 : 1;
    for (std::size_t i = k_limbs; i-- > 0;)
      if (a.digits_[i] != b.digits_[i]) return a.digits_[i] < b.digits_[i] ? -1 : 1;
    return 0;
  }

  static BinaryFloat sum(const BinaryFloat& a, const BinaryFloat& b) {
    if (a.kind_ == Kind::nan || b.kind_ == Kind::nan) return not_a_number();
    if (a.kind_ == Kind::infinite || b.kind_ == Kind::infinite) {
      const bool cancel = a.kind_ == b.kind_ && a.is_negative_ != b.is_negative_;
      return cancel ? not_a_number() : a.kind_ == Kind::infinite ? a : b;
    }
    if (a.kind_ == Kind::zero) return b;
    if (b.kind_ == Kind::zero) return a;
    return compared(a, b) >= 0 ? sum_of_numbers(a, b) : sum_of_numbers(b, a);
  }

  // |a| >= |b|. With 64 bits below the last one of a.
  static BinaryFloat sum_of_numbers(const BinaryFloat& a, const BinaryFloat& b) {
    const std::int64_t distance = a.exponent_ - b.exponent_;
    if (distance >= static_cast<std::int64_t>(bits) + k_limb_bits) return a;
    std::array<Limb, k_limbs + 2> wide{};  // guard, digits, carry
    std::copy(a.digits_.begin(), a.digits_.end(), wide.begin() + 1);
    const bool adds = a.is_negative_ == b.is_negative_;
    Limb carried = 0;
    for (std::size_t i = 0; i + 1 < wide.size(); ++i) {
      const Limb other = b.limb_moved_down(i, static_cast<unsigned>(distance));
      const TwoLimbs total = adds ? TwoLimbs{wide[i]} + other + carried : TwoLimbs{wide[i]} - other - carried;
      wide[i] = static_cast<Limb>(total);
      carried = static_cast<Limb>(total >> k_limb_bits) & 1;
    }
    wide.back() = adds ? carried : 0;
    // What lies below the guard: a little more than this sum, or a little less than this difference.
    const bool has_more = b.has_bits_below(static_cast<unsigned>(distance));
    if (has_more && !adds)
      for (std::size_t i = 0; wide[i]-- == 0;) ++i;
    return made(wide, a.exponent_ + k_limb_bits, a.is_negative_, has_more);
  }

  // Limb i of {guard, digits} moved down.
  Limb limb_moved_down(std::size_t i, unsigned distance) const {
    const std::size_t whole = distance / k_limb_bits;
    const unsigned part = distance % k_limb_bits;
    const auto limb = [&](std::size_t at) { return at >= 1 && at <= k_limbs ? digits_[at - 1] : Limb{0}; };
    const Limb low = limb(i + whole), high = limb(i + whole + 1);
    return part == 0 ? low : low >> part | high << (k_limb_bits - part);
  }

  // Of {guard, digits}, moved down by so much.
  bool has_bits_below(unsigned distance) const {
    if (distance <= k_limb_bits) return false;
    const unsigned lost = distance - k_limb_bits;  // of the digits
    for (std::size_t i = 0; i < k_limbs && i * k_limb_bits < lost; ++i) {
      const unsigned here = lost - static_cast<unsigned>(i) * k_limb_bits;
      if ((here >= k_limb_bits ? digits_[i] : digits_[i] << (k_limb_bits - here)) != 0) return true;
    }
    return false;
  }

  // By the first bit that is cut off, and whether there are others behind it.
  void round(bool half, bool has_more) {
    if (!half || (!has_more && (digits_[0] & 1) == 0)) return;
    for (Limb& limb : digits_)
      if (++limb != 0) return;
    digits_[k_limbs - 1] = Limb{1} << (k_limb_bits - 1);
    ++exponent_;
  }

  // The top bits of a whole number whose highest possible bit has this exponent.
  template <std::size_t size>
  static BinaryFloat made(const std::array<Limb, size>& wide, std::int64_t exponent, bool is_negative, bool has_more) {
    std::size_t top = size;
    while (top > 0 && wide[top - 1] == 0) --top;
    if (top == 0) return {};
    const auto zeros = static_cast<unsigned>(std::countl_zero(wide[top - 1]));
    BinaryFloat out;
    out.kind_ = Kind::number;
    out.is_negative_ = is_negative;
    out.exponent_ = exponent - static_cast<std::int64_t>((size - top) * k_limb_bits + zeros);
    // Limb i from the top, after the zeros.
    const auto limb = [&](std::size_t i) {
      if (i >= top) return Limb{0};
      const Limb high = wide[top - 1 - i], low = i + 2 <= top ? wide[top - 2 - i] : 0;
      return zeros == 0 ? high : high << zeros | low >> (k_limb_bits - zeros);
    };
    for (std::size_t i = 0; i < k_limbs; ++i) out.digits_[k_limbs - 1 - i] = limb(i);
    const Limb next = limb(k_limbs);
    for (std::size_t i = k_limbs + 1; i < top && !has_more; ++i) has_more = limb(i) != 0;
    out.round(next >> (k_limb_bits - 1) != 0, has_more || next << 1 != 0);
    return out;
  }

  BinaryFloat times(const BinaryFloat& b) const {
    const bool is_negative = is_negative_ != b.is_negative_;
    if (kind_ == Kind::nan || b.kind_ == Kind::nan) return not_a_number();
    if (kind_ != Kind::number || b.kind_ != Kind::number) {
      if (kind_ != Kind::infinite && b.kind_ != Kind::infinite) return {};
      return kind_ == Kind::zero || b.kind_ == Kind::zero ? not_a_number() : infinity().with_sign(is_negative);
    }
    std::array<Limb, 2 * k_limbs> wide{};
    for (std::size_t j = 0; j < k_limbs; ++j) {
      if (b.digits_[j] == 0) continue;
      Limb carried = 0;
      for (std::size_t i = 0; i < k_limbs; ++i) {
        const TwoLimbs product = TwoLimbs{digits_[i]} * b.digits_[j] + wide[i + j] + carried;
        wide[i + j] = static_cast<Limb>(product);
        carried = static_cast<Limb>(product >> k_limb_bits);
      }
      wide[j + k_limbs] = carried;
    }
    return made(wide, exponent_ + b.exponent_, is_negative, false);
  }

  BinaryFloat over(const BinaryFloat& b) const {
    const bool is_negative = is_negative_ != b.is_negative_;
    if (kind_ == Kind::nan || b.kind_ == Kind::nan || (kind_ == b.kind_ && kind_ != Kind::number))
      return not_a_number();
    if (kind_ == Kind::zero || b.kind_ == Kind::infinite) return {};
    if (kind_ == Kind::infinite || b.kind_ == Kind::zero) return infinity().with_sign(is_negative);
    const Integer dividend(Limbs(digits_.begin(), digits_.end()), false),
        divisor(Limbs(b.digits_.begin(), b.digits_.end()), false);
    // Two bits more than needed, and one that says whether there is a rest.
    const Integer moved = dividend << (bits + 2), quotient = moved / divisor;
    const bool has_rest = !(quotient * divisor == moved);
    BinaryFloat out((quotient << 1) + (has_rest ? 1 : 0));
    out.exponent_ += exponent_ - b.exponent_ - static_cast<std::int64_t>(bits) - 3;
    out.is_negative_ = is_negative;
    return out;
  }

  // first - first x²/(n (n + 1)) + ...: of the cosine from 1 and n = 1, of the sine from x and n = 2.
  static BinaryFloat series(const BinaryFloat& x, const BinaryFloat& first, int n) {
    const BinaryFloat square = x * x;
    BinaryFloat term = first, total = first;
    for (; term.kind_ == Kind::number && term.exponent_ > total.exponent_ - static_cast<std::int64_t>(bits) - 8;
         n += 2) {
      term = -(term * square / BinaryFloat(n * (n + 1)));
      total += term;
    }
    return total;
  }

  Kind kind_ = Kind::zero;
  bool is_negative_ = false;
  std::int64_t exponent_ = 0;  // of a number that is digits_ / 2^bits * 2^exponent_; the highest bit is set
  Digits digits_{};
};

}  // namespace clusterbench::geom

template <unsigned bits>
class std::numeric_limits<clusterbench::geom::BinaryFloat<bits>> {
 public:
  static constexpr bool is_specialized = true;
  static clusterbench::geom::BinaryFloat<bits> infinity() { return clusterbench::geom::BinaryFloat<bits>::infinity(); }
};
