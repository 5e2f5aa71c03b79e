#include "geom/numbers/integer.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "geom/numbers/two_limbs.h"

namespace clusterbench::geom {
namespace {

void trim(Limbs& limbs) {
  while (!limbs.empty() && limbs.back() == 0) limbs.pop_back();
}

int compared(const Limbs& a, const Limbs& b) {
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  for (std::size_t i = a.size(); i-- > 0;)
    if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
  return 0;
}

// a has no fewer limbs.
Limbs added(const Limbs& a, const Limbs& b) {
  Limbs out(a.size() + 1);
  Limb carried = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const TwoLimbs total = TwoLimbs{a[i]} + (i < b.size() ? b[i] : 0) + carried;
    out[i] = static_cast<Limb>(total);
    carried = static_cast<Limb>(total >> k_limb_bits);
  }
  out[a.size()] = carried;
  return out;
}

// a is no smaller.
Limbs subtracted(const Limbs& a, const Limbs& b) {
  Limbs out(a.size());
  Limb borrowed = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const TwoLimbs total = TwoLimbs{a[i]} - (i < b.size() ? b[i] : 0) - borrowed;
    out[i] = static_cast<Limb>(total);
    borrowed = static_cast<Limb>(total >> k_limb_bits) & 1;
  }
  return out;
}

Limbs shifted_up(const Limbs& a, unsigned bits) {
  const std::size_t whole = bits / k_limb_bits;
  const unsigned part = bits % k_limb_bits;
  Limbs out(a.size() + whole + 1, 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    out[i + whole] |= a[i] << part;
    if (part != 0) out[i + whole + 1] = a[i] >> (k_limb_bits - part);
  }
  return out;
}

Limbs shifted_down(const Limbs& a, unsigned bits) {
  const std::size_t whole = bits / k_limb_bits;
  const unsigned part = bits % k_limb_bits;
  Limbs out(a.size() > whole ? a.size() - whole : 0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = a[i + whole] >> part;
    if (part != 0 && i + whole + 1 < a.size()) out[i] |= a[i + whole + 1] << (k_limb_bits - part);
  }
  return out;
}

Limb divide_by_limb(Limbs& a, Limb divisor) {
  Limb rest = 0;
  for (std::size_t i = a.size(); i-- > 0;) {
    const TwoLimbs value = TwoLimbs{rest} << k_limb_bits | a[i];
    a[i] = static_cast<Limb>(value / divisor);
    rest = static_cast<Limb>(value % divisor);
  }
  return rest;
}

// The quotient's limb for the top of `rest` (at `at`), which it is subtracted from: step D3 to D6 of Knuth's algorithm
// D.
Limb divide_step(Limbs& rest, const Limbs& divisor, std::size_t at) {
  const std::size_t n = divisor.size();
  const TwoLimbs top = TwoLimbs{rest[at + n]} << k_limb_bits | rest[at + n - 1];
  TwoLimbs guess = top / divisor[n - 1], left = top % divisor[n - 1];
  while ((guess >> k_limb_bits) != 0 || guess * divisor[n - 2] > (left << k_limb_bits | rest[at + n - 2])) {
    --guess;
    left += divisor[n - 1];
    if ((left >> k_limb_bits) != 0) break;
  }
  Limb borrowed = 0, carried = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const TwoLimbs product = guess * divisor[i] + carried;
    carried = static_cast<Limb>(product >> k_limb_bits);
    const TwoLimbs total = TwoLimbs{rest[at + i]} - static_cast<Limb>(product) - borrowed;
    rest[at + i] = static_cast<Limb>(total);
    borrowed = static_cast<Limb>(total >> k_limb_bits) & 1;
  }
  const TwoLimbs total = TwoLimbs{rest[at + n]} - carried - borrowed;
  rest[at + n] = static_cast<Limb>(total);
  if ((static_cast<Limb>(total >> k_limb_bits) & 1) == 0) return static_cast<Limb>(guess);
  Limb back = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const TwoLimbs again = TwoLimbs{rest[at + i]} + divisor[i] + back;
    rest[at + i] = static_cast<Limb>(again);
    back = static_cast<Limb>(again >> k_limb_bits);
  }
  rest[at + n] += back;
  return static_cast<Limb>(guess) - 1;
}

struct Division {
  Limbs quotient, rest;
};

// Knuth, The Art of Computer Programming, volume 2, 4.3.1, algorithm D.
Division divided(const Limbs& a, const Limbs& b) {
  Division out;
  if (compared(a, b) < 0) {
    out.rest = a;
    return out;
  }
  if (b.size() == 1) {
    out.quotient = a;
    out.rest.assign(1, divide_by_limb(out.quotient, b[0]));
  } else {
    const auto shift = static_cast<unsigned>(std::countl_zero(b.back()));
    Limbs divisor = shifted_up(b, shift);
    trim(divisor);
    out.rest = shifted_up(a, shift);
    out.quotient.resize(a.size() - b.size() + 1);
    for (std::size_t at = out.quotient.size(); at-- > 0;) out.quotient[at] = divide_step(out.rest, divisor, at);
    trim(out.rest);
    out.rest = shifted_down(out.rest, shift);
  }
  trim(out.quotient);
  trim(out.rest);
  return out;
}

}  // namespace

Integer::Integer(Limbs magnitude, bool is_negative) : limbs_(std::move(magnitude)), is_negative_(is_negative) {
  trim(limbs_);
}

unsigned Integer::bits() const {
  if (limbs_.empty()) return 0;
  return static_cast<unsigned>(limbs_.size()) * k_limb_bits - static_cast<unsigned>(std::countl_zero(limbs_.back()));
}

unsigned Integer::zeros() const {
  for (std::size_t i = 0; i < limbs_.size(); ++i)
    if (limbs_[i] != 0)
      return static_cast<unsigned>(i) * k_limb_bits + static_cast<unsigned>(std::countr_zero(limbs_[i]));
  return 0;
}

Integer Integer::sum(const Integer& a, const Integer& b, bool b_is_negative) {
  if (a.is_negative_ == b_is_negative)
    return {a.limbs_.size() >= b.limbs_.size() ? added(a.limbs_, b.limbs_) : added(b.limbs_, a.limbs_), b_is_negative};
  const bool a_is_larger = compared(a.limbs_, b.limbs_) >= 0;
  return a_is_larger ? Integer(subtracted(a.limbs_, b.limbs_), a.is_negative_)
                     : Integer(subtracted(b.limbs_, a.limbs_), b_is_negative);
}

Integer operator*(const Integer& a, const Integer& b) {
  Limbs out(a.limbs_.size() + b.limbs_.size(), 0);
  for (std::size_t j = 0; j < b.limbs_.size(); ++j) {
    Limb carried = 0;
    for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
      const TwoLimbs product = TwoLimbs{a.limbs_[i]} * b.limbs_[j] + out[i + j] + carried;
      out[i + j] = static_cast<Limb>(product);
      carried = static_cast<Limb>(product >> k_limb_bits);
    }
    out[a.limbs_.size() + j] = carried;
  }
  return {std::move(out), a.is_negative_ != b.is_negative_};
}

Integer operator/(const Integer& a, const Integer& b) {
  return {divided(a.limbs_, b.limbs_).quotient, a.is_negative_ != b.is_negative_};
}

Integer operator%(const Integer& a, const Integer& b) {
  return {divided(a.limbs_, b.limbs_).rest, a.is_negative_};
}

Integer operator<<(const Integer& a, unsigned bits) {
  return {shifted_up(a.limbs_, bits), a.is_negative_};
}

Integer operator>>(const Integer& a, unsigned bits) {
  return {shifted_down(a.limbs_, bits), a.is_negative_};
}

std::strong_ordering operator<=>(const Integer& a, const Integer& b) {
  if (a.sign() != b.sign()) return a.sign() <=> b.sign();
  const int order = compared(a.limbs_, b.limbs_);
  return a.sign() < 0 ? 0 <=> order : order <=> 0;
}

// Newton's steps from above fall until they have the root.
Integer sqrt(const Integer& a) {
  if (a.sign() == 0) return 0;
  Integer root = Integer(1) << ((a.bits() + 1) / 2);
  for (;;) {
    const Integer next = (root + a / root) >> 1;
    if (!(next < root)) return root;
    root = next;
  }
}

Integer greatest_common_divisor(Integer a, Integer b) {
  while (b.sign() != 0) {
    a = a % b;
    std::swap(a, b);
  }
  return {a.limbs_, false};
}

}  // namespace clusterbench::geom
