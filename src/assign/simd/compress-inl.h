// Lanes of 32, 16 or 8 bits side by side, for files that are compiled once per target. Included after hwy/highway.h;
// defines its names anew for each target.
//
// Instruction sets without an instruction for it look up where lanes go in one table. Highway 1.0's own Compress does
// that, too, but built by g++ it copies its table of a kilobyte to the stack each time: five times slower on AVX2.

#ifndef CLUSTERBENCH_COMPRESS_ONCE  // what all targets share
#define CLUSTERBENCH_COMPRESS_ONCE
#include <array>
#include <cstdint>

namespace clusterbench::assign {

// For every 8 bits: the places of those that are set, then of the others, both ascending.
inline constexpr auto k_places_of_bits = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    unsigned next = 0;
    for (const unsigned wanted : {1u, 0u})
      for (unsigned place = 0; place < 8; ++place)
        if ((bits >> place & 1) == wanted) table[bits][next++] = static_cast<std::uint8_t>(place);
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

// Whether there is an instruction for it, or nothing to do.
template <class T>
constexpr bool k_compresses = HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_AVX3_DL ||
                              (HWY_TARGET == HWY_AVX3 && sizeof(T) == 4);

// At most 8 lanes, the wanted ones first.
template <class D, class V>
HWY_INLINE V compressed_by_table(D d, V lanes, std::uint8_t bits) {
  const std::uint8_t* table = k_places_of_bits[bits].data();
  const auto places = hn::LoadU(hn::Rebind<std::uint8_t, D>(), table);
  if constexpr (sizeof(hn::TFromD<D>) == 4) {
    return hn::TableLookupLanes(lanes, hn::IndicesFromVec(d, hn::PromoteTo(hn::RebindToSigned<D>(), places)));
  } else if constexpr (sizeof(hn::TFromD<D>) == 2) {
    const hn::RebindToUnsigned<D> du;
    const auto low = hn::ShiftLeft<1>(hn::PromoteTo(du, places));  // byte; the lane's other one follows
    const auto both = hn::Or(low, hn::ShiftLeft<8>(hn::Add(low, hn::Set(du, 1))));
    return hn::BitCast(d, hn::TableLookupBytes(lanes, hn::BitCast(d, both)));
  } else {
    return hn::TableLookupBytes(lanes, places);
  }
}

// Lanes of 32 bits, the wanted ones first.
template <class D, class V, class M>
HWY_INLINE V compressed(D d, V lanes, M wanted) {
  if constexpr (k_compresses<hn::TFromD<D>>) {
    return hn::Compress(lanes, wanted);
  } else {
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, wanted, bits);
    return compressed_by_table(d, lanes, bits[0]);
  }
}

// Writes the wanted ones of `lanes`, which were loaded from `from`, to `to`, and up to a vector of anything behind
// them. Returns their end.
template <class D, class V, class M, class T>
HWY_INLINE T* append(D d, [[maybe_unused]] const T* from, [[maybe_unused]] V lanes, M wanted, T* to) {
  if constexpr (sizeof(T) == 4) {
    // Compressing in a register and storing it whole is faster than a compressing store.
    hn::StoreU(compressed(d, lanes, wanted), d, to);
    return to + hn::CountTrue(d, wanted);
  } else if constexpr (k_compresses<T>) {
    return to + hn::CompressStore(lanes, wanted, d, to);
  } else if constexpr (k_compresses<std::uint32_t> && sizeof(T) == 2) {  // on their way through lanes of 32 bits
    const hn::ScalableTag<std::uint32_t> wide;
    const hn::Rebind<T, decltype(wide)> slim;
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, wanted, bits);
    for (std::size_t i = 0; i < hn::Lanes(d); i += hn::Lanes(wide)) {
      const auto some = hn::LoadMaskBits(wide, bits + i / 8);
      const auto first = hn::Compress(hn::PromoteTo(wide, hn::LoadU(slim, from + i)), some);
      hn::StoreU(hn::TruncateTo(slim, first), slim, to);
      to += hn::CountTrue(wide, some);
    }
    return to;
  } else {
    const hn::CappedTag<T, 8> eight;
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, wanted, bits);
    for (std::size_t i = 0; i < hn::Lanes(d); i += 8) {
      hn::StoreU(compressed_by_table(eight, hn::LoadU(eight, from + i), bits[i / 8]), eight, to);
      to += hwy::PopCount(bits[i / 8]);
    }
    return to;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#endif
