// Lanes of 32 bits side by side, for files that are compiled once per target. Included after hwy/highway.h;
// defines its names anew for each target.
//
// Instruction sets without an instruction for it look up where lanes go in one table. Highway 1.0's own Compress does
// that, too, but built by g++ it copies its table of a kilobyte to the stack each time: five times slower on AVX2.

#ifndef CLUSTERBENCH_COMPRESS_ONCE  // what all targets share
#define CLUSTERBENCH_COMPRESS_ONCE
#include <array>
#include <cstdint>

namespace clusterbench::assign {

// For every 8 bits: how many are set before each of them.
inline constexpr auto k_ranks_of_bits = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    unsigned before = 0;
    for (unsigned lane = 0; lane < 8; ++lane) {
      table[bits][lane] = static_cast<std::uint8_t>(before);
      before += bits >> lane & 1;
    }
  }
  return table;
}();

// For every 8 bits: the lanes of those that are set, then of the others, both ascending.
inline constexpr auto k_lanes_of_bits = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    unsigned next = 0;
    for (const unsigned wanted : {1u, 0u})
      for (unsigned lane = 0; lane < 8; ++lane)
        if ((bits >> lane & 1) == wanted) table[bits][next++] = static_cast<std::uint8_t>(lane);
  }
  return table;
}();

}  // namespace clusterbench::assign
#endif

#if defined(CLUSTERBENCH_COMPRESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_COMPRESS_INL_H
#undef CLUSTERBENCH_COMPRESS_INL_H
#else
#define CLUSTERBENCH_COMPRESS_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// What a table says of a mask of at most 8 lanes, a lane for each.
template <class D, class M, class Table>
HWY_INLINE auto lanes_of(D d, M wanted, const Table& table) {
  std::uint8_t bits[8];
  StoreMaskBits(d, wanted, bits);
  const auto lanes = LoadU(hn::Rebind<std::uint8_t, D>(), table[bits[0]].data());
  return IndicesFromVec(d, PromoteTo(hn::RebindToSigned<D>(), lanes));
}

// Lanes of 32 bits, the wanted ones first.
template <class D, class V, class M>
HWY_INLINE V compressed([[maybe_unused]] D d, V lanes, M wanted) {
#if HWY_TARGET <= HWY_AVX3
  // Not with zeros behind them, as Highway has it: on Zen 5 that waits for what was in the register before.
  const hn::RebindToFloat<D> df;
  const auto raw = BitCast(df, lanes).raw;
  return BitCast(d, hn::Vec<decltype(df)>{_mm512_mask_compress_ps(raw, wanted.raw, raw)});
#elif HWY_TARGET == HWY_SCALAR
  return Compress(lanes, wanted);
#else
  return TableLookupLanes(lanes, lanes_of(d, wanted, k_lanes_of_bits));
#endif
}

// The other way: the wanted lanes of the answer are the first ones, in their order. Others are anything.
template <class D, class V, class M>
HWY_INLINE V expanded([[maybe_unused]] D d, V lanes, [[maybe_unused]] M wanted) {
#if HWY_TARGET <= HWY_AVX3
  const hn::RebindToFloat<D> df;
  const auto raw = BitCast(df, lanes).raw;
  return BitCast(d, hn::Vec<decltype(df)>{_mm512_mask_expand_ps(raw, wanted.raw, raw)});
#elif HWY_TARGET == HWY_SCALAR
  return lanes;
#else
  return TableLookupLanes(lanes, lanes_of(d, wanted, k_ranks_of_bits));
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#endif
