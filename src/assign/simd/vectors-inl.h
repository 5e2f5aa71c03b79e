// Single-precision vectors of a whole register. Like all of these -inl.h files, for files that are compiled once per
// target: it defines its names anew for each target. Such a file defines HWY_TARGET_INCLUDE and includes
// hwy/foreach_target.h before any of these, as Highway requires.

#if defined(CLUSTERBENCH_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_VECTORS_INL_H
#undef CLUSTERBENCH_VECTORS_INL_H
#else
#define CLUSTERBENCH_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "assign/simd/bit_tables.h"
#include "assign/simd/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DI = hn::ScalableTag<std::int32_t>;
using DU = hn::ScalableTag<std::uint32_t>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using VU = hn::Vec<DU>;
using M = hn::Mask<D>;
using MI = hn::Mask<DI>;
static_assert(MaxLanes(D()) <= k_row_lanes);

// Vectors of doubles, and of as many floats and indices.
using DD = hn::ScalableTag<double>;
using DF = hn::Rebind<float, DD>;
using DH = hn::Rebind<std::int32_t, DD>;
using VD = hn::Vec<DD>;
using VF = hn::Vec<DF>;
using VH = hn::Vec<DH>;
using MD = hn::Mask<DD>;

HWY_INLINE std::uint32_t lane_count() {
  return static_cast<std::uint32_t>(Lanes(D()));
}

// Vectors of a number's own type, a whole register: all lanes equal, and values looked up by index.
template <class T>
HWY_INLINE auto all(T value) {
  return Set(hn::ScalableTag<T>(), value);
}
template <class T>
HWY_INLINE auto gathered(const T* from, VI indices) {
  return GatherIndex(hn::ScalableTag<T>(), from, indices);
}
template <class T, class... Allocator>
HWY_INLINE auto gathered(const std::vector<T, Allocator...>& from, VI indices) {
  return gathered(from.data(), indices);
}

HWY_INLINE V infinity() {
  return all(std::numeric_limits<float>::infinity());
}
HWY_INLINE M is_between(V low, V value, V high) {
  return And(low <= value, value <= high);
}
// NaN becomes `low`, on every target: Highway's Clamp has the value as its second argument, for which targets differ.
HWY_INLINE V clamped(V low, V value, V high) {
  return Min(Max(value, low), high);
}
// The distance of a coordinate outside an interval.
HWY_INLINE V gap(V low, V coordinate, V high) {
  return Max(Zero(D()), Max(low - coordinate, coordinate - high));
}

// Points and directions: x to the right, y up, depth ahead; each coordinate is a vector of numbers.
template <class Numbers>
struct PointOf {
  Numbers x, y, depth;
};
template <class T>
HWY_INLINE PointOf<T> operator+(const PointOf<T>& a, const PointOf<T>& b) {
  return {a.x + b.x, a.y + b.y, a.depth + b.depth};
}
template <class T>
HWY_INLINE PointOf<T> operator-(const PointOf<T>& a, const PointOf<T>& b) {
  return {a.x - b.x, a.y - b.y, a.depth - b.depth};
}
template <class T>
HWY_INLINE PointOf<T> operator*(T s, const PointOf<T>& a) {
  return {s * a.x, s * a.y, s * a.depth};
}
template <class T>
HWY_INLINE T dot(const PointOf<T>& a, const PointOf<T>& b) {
  return a.x * b.x + a.y * b.y + a.depth * b.depth;
}
template <class T>
HWY_INLINE T length(const PointOf<T>& a) {
  return Sqrt(dot(a, a));
}

using Point = PointOf<V>;
HWY_INLINE Point cross(const Point& a, const Point& b) {
  return {a.y * b.depth - a.depth * b.y, a.depth * b.x - a.x * b.depth, a.x * b.y - a.y * b.x};
}

// Unit vectors along an axis, or (side -1) against it.
HWY_INLINE Point x_axis(float side = 1.0f) {
  return {all(side), Zero(D()), Zero(D())};
}
HWY_INLINE Point y_axis() {
  return {Zero(D()), all(1.0f), Zero(D())};
}
HWY_INLINE Point depth_axis(float side = 1.0f) {
  return {Zero(D()), Zero(D()), all(side)};
}

HWY_INLINE Point chosen(M where, const Point& a, const Point& b) {
  return {IfThenElse(where, a.x, b.x), IfThenElse(where, a.y, b.y), IfThenElse(where, a.depth, b.depth)};
}

// Four numbers per lane.
struct Quads {
  V first, second, third, fourth;
};

// Lane i of the result has the four numbers from from[4 * indices[i]] on: several times as fast as gathering each.
HWY_INLINE Quads gathered_quads(const float* from, const std::uint32_t* indices) {
  const D d;
  const auto at = [&](std::size_t lane) { return from + 4 * std::size_t{indices[lane]}; };
#if HWY_TARGET == HWY_SCALAR
  const float* four = at(0);
  return {LoadU(d, four), LoadU(d, four + 1), LoadU(d, four + 2), LoadU(d, four + 3)};
#else
  // For each block of four lanes: vector i of them has the numbers of lane i. Then they are transposed.
  const auto of_lane = [&](std::size_t i) {
    V all_blocks = LoadDup128(d, at(i));
    for (std::size_t lane = 4; lane < Lanes(d); lane += 4) {
      const M from_here_on = Not(FirstN(d, lane));
      all_blocks = IfThenElse(from_here_on, LoadDup128(d, at(lane + i)), all_blocks);
    }
    return all_blocks;
  };
  const V a = of_lane(0), b = of_lane(1), c = of_lane(2), e = of_lane(3);
  const hn::RepartitionToWide<D> pairs;
  const auto low = BitCast(pairs, InterleaveLower(d, a, b));
  const auto high = BitCast(pairs, InterleaveUpper(d, a, b));
  const auto next_low = BitCast(pairs, InterleaveLower(d, c, e));
  const auto next_high = BitCast(pairs, InterleaveUpper(d, c, e));
  return {BitCast(d, InterleaveLower(pairs, low, next_low)), BitCast(d, InterleaveUpper(pairs, low, next_low)),
          BitCast(d, InterleaveLower(pairs, high, next_high)), BitCast(d, InterleaveUpper(pairs, high, next_high))};
#endif
}

// Lane i of the result is lane which[i] of the value.
using Which = decltype(IndicesFromVec(DI(), VI()));
template <class Vector>
HWY_INLINE Vector taken(Vector value, Which which) {
  return BitCast(hn::DFromV<Vector>(), TableLookupLanes(BitCast(DI(), value), which));
}

// A table of up to two registers: several times as fast as gathering.
class RegisterTable {
 public:
  static std::size_t size() { return 2 * Lanes(D()); }
  HWY_INLINE RegisterTable(V first, V second) : first_(first), second_(second) {}

  HWY_INLINE V at(VI index) const {
#if HWY_TARGET <= HWY_AVX3
    return V{_mm512_permutex2var_ps(first_.raw, index.raw, second_.raw)};
#else
    const VI last = all(static_cast<std::int32_t>(Lanes(D())) - 1);
    const Which within = IndicesFromVec(DI(), And(index, last));
    return IfThenElse(RebindMask(D(), index > last), taken(second_, within), taken(first_, within));
#endif
  }

 private:
  V first_, second_;
};

// A table that is in registers if they have room for it. Whole vectors can be read from `values` on.
class Table {
 public:
  HWY_INLINE Table(const std::vector<float>& values, int count)
      : values_(values.data()),
        is_small_(static_cast<std::size_t>(count) <= RegisterTable::size()),
        table_(LoadU(D(), values_), LoadU(D(), values_ + Lanes(D()))) {}

  HWY_INLINE V at(VI index) const { return is_small_ ? table_.at(index) : gathered(values_, index); }

 private:
  const float* values_;
  bool is_small_;
  RegisterTable table_;
};

// first, first + 1, ... Highway's Iota of a number that is not constant goes through memory.
HWY_INLINE VI from_on(std::int32_t first) {
  return all(first) + Iota(DI(), 0);
}

// A whole number from 0 to 2^22 as an integer, faster than ConvertTo, which tests for values out of range. Undefined
// for other values.
HWY_INLINE VI whole(V number) {
  return Xor(BitCast(DI(), number + all(0x1p23f)), BitCast(DI(), all(0x1p23f)));
}

// The root of a square that rounding may have made negative.
HWY_INLINE V root(V square) {
  return Sqrt(Max(square, Zero(D())));
}

// Moves vectors one lane on, vector by vector: the first lane becomes the last one of the vector before.
class Carried {
 public:
  HWY_INLINE Carried() {
    const auto n = static_cast<std::int32_t>(Lanes(D()));
    one_back_ = IndicesFromVec(DI(), And(from_on(n - 1), all(n - 1)));
  }
  // `turned`: set by the call for the vector before.
  template <class Vector>
  HWY_INLINE Vector operator()(Vector value, Vector& turned) const {
    const Vector now = taken(value, one_back_);
    const Vector carried = IfThenElse(FirstN(hn::DFromV<Vector>(), 1), turned, now);
    turned = now;
    return carried;
  }

 private:
  Which one_back_;
};

// --- Compression of lanes of 32 bits. Instruction sets without an instruction for it look up the lanes' new places in
// one table. Highway 1.0's own Compress does that, too, but g++ makes it copy its table of a kilobyte to the stack each
// time: five times slower on AVX2. ---

// Bit i is lane i of a mask of at most 8 lanes.
template <class Tag, class Mask>
HWY_INLINE unsigned bits_of(Tag d, Mask mask) {
  static_assert(MaxLanes(Tag()) <= 8);
  std::uint8_t bits[8];
  StoreMaskBits(d, mask, bits);
  return bits[0];
}

// The table's entry for a mask of at most 8 lanes, one number per lane.
template <class Tag, class Mask, class BitTable>
HWY_INLINE auto lanes_of(Tag d, Mask wanted, const BitTable& table) {
  const auto lanes = LoadU(hn::Rebind<std::uint8_t, Tag>(), table[bits_of(d, wanted)].data());
  return IndicesFromVec(d, PromoteTo(hn::RebindToSigned<Tag>(), lanes));
}

// Lanes of 32 bits, the selected ones first.
template <class Tag, class Vector, class Mask>
HWY_INLINE Vector compressed([[maybe_unused]] Tag d, Vector lanes, Mask wanted) {
#if HWY_TARGET <= HWY_AVX3
  // Not the form with zeros in the other lanes, Highway's default: on Zen 5 that waits for the register's former value.
  const hn::RebindToFloat<Tag> df;
  const auto raw = BitCast(df, lanes).raw;
  return BitCast(d, hn::Vec<decltype(df)>{_mm512_mask_compress_ps(raw, wanted.raw, raw)});
#elif HWY_TARGET == HWY_SCALAR
  return Compress(lanes, wanted);
#else
  return TableLookupLanes(lanes, lanes_of(d, wanted, k_bit_tables.lanes));
#endif
}

// The inverse: the selected lanes of the result are the first lanes of the value, in order. Other lanes are undefined.
template <class Tag, class Vector, class Mask>
HWY_INLINE Vector expanded([[maybe_unused]] Tag d, Vector lanes, [[maybe_unused]] Mask wanted) {
#if HWY_TARGET <= HWY_AVX3
  const hn::RebindToFloat<Tag> df;
  const auto raw = BitCast(df, lanes).raw;
  return BitCast(d, hn::Vec<decltype(df)>{_mm512_mask_expand_ps(raw, wanted.raw, raw)});
#elif HWY_TARGET == HWY_SCALAR
  return lanes;
#else
  return TableLookupLanes(lanes, lanes_of(d, wanted, k_bit_tables.ranks));
#endif
}

// Stores the selected lanes side by side, where there is room for a whole vector.
template <class Vector, class Mask>
HWY_INLINE void store_wanted(Vector value, Mask wanted, hn::TFromV<Vector>* to) {
  const hn::DFromV<Vector> d;
  StoreU(compressed(d, value, RebindMask(d, wanted)), d, to);
}

// from[0] .. from[count - 1], followed by 0 if that is less than a vector.
HWY_INLINE V loaded(const float* from, std::uint32_t count) {
  if (count >= Lanes(D())) return LoadU(D(), from);
  float rest[k_most_lanes] = {};
  std::copy(from, from + count, rest);
  return LoadU(D(), rest);
}

// LightArrays::padded_radius
HWY_INLINE V padded(V radius, V reach, float roundoffs) {
  if (roundoffs == 0.0f) return radius;
  return radius + all(roundoffs) * (all(0x1p-24f) * reach);
}

}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
