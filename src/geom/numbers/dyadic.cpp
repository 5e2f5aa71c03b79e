#include "geom/numbers/dyadic.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

#include "geom/numbers/two_limbs.h"

namespace clusterbench::geom {
namespace {

constexpr int k_bits = 64;

}  // namespace

Dyadic::Dyadic(double value) {
  if (value == 0.0) return;
  constexpr int k_digits = 52, k_bias = 1023 + k_digits;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const auto exponent = static_cast<int>(bits >> k_digits & 0x7ff);
  const Limb below_one = bits & ((Limb{1} << k_digits) - 1);
  const Limb digits = exponent == 0 ? below_one : below_one | Limb{1} << k_digits;
  const int zeros = std::countr_zero(digits);
  limbs_[0] = digits >> zeros;
  count_ = 1;
  exponent_ = std::max(exponent, 1) - k_bias + zeros;
  is_negative_ = value < 0.0;
}

Dyadic::Dyadic(const Dyadic& other)
    : count_(other.count_), exponent_(other.exponent_), is_negative_(other.is_negative_) {
  std::copy_n(other.limbs_.begin(), count_, limbs_.begin());
}

Dyadic& Dyadic::operator=(const Dyadic& other) {
  count_ = other.count_;
  exponent_ = other.exponent_;
  is_negative_ = other.is_negative_;
  if (this != &other) std::copy_n(other.limbs_.begin(), count_, limbs_.begin());
  return *this;
}

Dyadic Dyadic::operator-() const {
  Dyadic result(*this);
  result.is_negative_ = !is_negative_;
  return result;
}

void Dyadic::trim() {
  while (count_ > 0 && limbs_[static_cast<std::size_t>(count_) - 1] == 0) --count_;
}

int Dyadic::lowered(const Dyadic& a, int exponent, std::array<Limb, k_limbs>& out) {
  const int shift = a.exponent_ - exponent, limbs = shift / k_bits, bits = shift % k_bits;
  const int count = a.count_ + limbs + (bits == 0 ? 0 : 1);
  if (count > k_limbs) throw TooWide();
  std::fill_n(out.begin(), limbs, 0);
  Limb* to = out.data() + limbs;
  if (bits == 0) {
    std::copy_n(a.limbs_.begin(), a.count_, to);
    return count;
  }
  Limb carried = 0;
  for (int i = 0; i < a.count_; ++i) {
    const Limb limb = a.limbs_[static_cast<std::size_t>(i)];
    to[i] = limb << bits | carried;
    carried = limb >> (k_bits - bits);
  }
  to[a.count_] = carried;
  return count;
}

Dyadic Dyadic::sum(const Dyadic& a, const Dyadic& b, bool b_is_negative) {
  if (b.count_ == 0) return a;
  if (a.count_ == 0) {
    Dyadic result(b);
    result.is_negative_ = b_is_negative;
    return result;
  }
  // The bits of both from the lower exponent on; only the number with the higher exponent is shifted.
  const bool a_is_lower = a.exponent_ <= b.exponent_;
  const Dyadic &low = a_is_lower ? a : b, &high = a_is_lower ? b : a;
  std::array<Limb, k_limbs> moved;
  const int moved_count = lowered(high, low.exponent_, moved);
  const Limb *x = low.limbs_.data(), *y = moved.data();
  int x_count = low.count_, y_count = moved_count;
  bool x_is_negative = a_is_lower ? a.is_negative_ : b_is_negative;
  const bool y_is_negative = a_is_lower ? b_is_negative : a.is_negative_;

  Dyadic result;
  result.exponent_ = low.exponent_;
  Limb* to = result.limbs_.data();
  const bool adds = x_is_negative == y_is_negative;
  if (!adds) {
    while (y_count > 0 && y[y_count - 1] == 0) --y_count;
    const bool x_is_smaller =
        x_count != y_count
            ? x_count < y_count
            : std::lexicographical_compare(std::make_reverse_iterator(x + x_count), std::make_reverse_iterator(x),
                                           std::make_reverse_iterator(y + y_count), std::make_reverse_iterator(y));
    if (x_is_smaller) x_is_negative = y_is_negative;
    if (x_is_smaller) {
      std::swap(x, y);
      std::swap(x_count, y_count);
    }
  } else if (x_count < y_count) {
    std::swap(x, y);
    std::swap(x_count, y_count);
  }
  // x has no fewer limbs than y and, where they are subtracted, is no smaller.
  Limb carried = 0;
  for (int i = 0; i < x_count; ++i) {
    const Limb other = i < y_count ? y[i] : 0;
    if (adds) {
      const TwoLimbs total = TwoLimbs{x[i]} + other + carried;
      to[i] = static_cast<Limb>(total);
      carried = static_cast<Limb>(total >> k_bits);
    } else {
      const TwoLimbs total = TwoLimbs{x[i]} - other - carried;
      to[i] = static_cast<Limb>(total);
      carried = static_cast<Limb>(total >> k_bits) & 1;
    }
  }
  result.count_ = x_count;
  if (adds && carried != 0) {
    if (x_count == k_limbs) throw TooWide();
    to[result.count_++] = carried;
  }
  result.is_negative_ = x_is_negative;
  result.trim();
  return result;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
  Dyadic result;
  if (a.count_ == 0 || b.count_ == 0) return result;
  if (a.count_ + b.count_ > Dyadic::k_limbs) throw TooWide();
  Dyadic::Limb* to = result.limbs_.data();
  std::fill_n(to, a.count_, 0);
  for (int j = 0; j < b.count_; ++j) {
    const TwoLimbs factor = b.limbs_[static_cast<std::size_t>(j)];
    Dyadic::Limb carried = 0;
    for (int i = 0; i < a.count_; ++i) {
      const TwoLimbs product = factor * a.limbs_[static_cast<std::size_t>(i)] + to[i + j] + carried;
      to[i + j] = static_cast<Dyadic::Limb>(product);
      carried = static_cast<Dyadic::Limb>(product >> k_bits);
    }
    to[a.count_ + j] = carried;
  }
  result.count_ = a.count_ + b.count_;
  result.exponent_ = a.exponent_ + b.exponent_;
  result.is_negative_ = a.is_negative_ != b.is_negative_;
  result.trim();
  return result;
}

}  // namespace clusterbench::geom
