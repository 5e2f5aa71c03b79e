#include "assign/storages/list_encodings.h"

#include <algorithm>

#define HWY_TARGET_INCLUDE "assign/storages/list_encodings.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

template <class T>
void narrow_to(const std::uint32_t* from, std::size_t count, T* to) {
  const hn::Rebind<T, DU> slim;
  std::size_t i = 0;
  for (; i + lane_count() <= count; i += lane_count()) StoreU(TruncateTo(slim, LoadU(DU(), from + i)), slim, to + i);
  for (; i < count; ++i) to[i] = static_cast<T>(from[i]);
}

void narrow_to_8(const std::uint32_t* from, std::size_t count, std::uint8_t* to) {
  narrow_to(from, count, to);
}

void narrow_to_16(const std::uint32_t* from, std::size_t count, std::uint16_t* to) {
  narrow_to(from, count, to);
}

HWY_INLINE void set_bit(std::uint32_t light, std::uint32_t* words) {
  words[light / 32] |= 1u << light % 32;
}

// If lists are dense, a vector of lights fills few words: each word gets the sum of its bits. Otherwise, and if lights
// do not ascend, light by light.
HWY_INLINE void set_bits(const std::uint32_t* lights, std::size_t count, std::uint32_t* words) {
  const std::size_t lanes = lane_count();
  constexpr std::size_t k_lanes_per_word = 4;  // below this, a sum costs more than it saves
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const std::uint32_t first = lights[i] / 32, last = lights[i + lanes - 1] / 32;
    const VU light = LoadU(DU(), lights + i), word = ShiftRight<5>(light);
    const VU between = Min(Max(word, all(first)), all(last));
    if ((last - first + 1) * k_lanes_per_word <= lanes && AllTrue(DU(), between == word)) {
      const VU bit = Shl(all(1u), And(light, all(31u)));
      for (std::uint32_t at = first; at <= last; ++at)
        words[at] |= GetLane(SumOfLanes(DU(), IfThenElseZero(word == all(at), bit)));
    } else {
      for (std::size_t k = i; k < i + lanes; ++k) set_bit(lights[k], words);
    }
  }
  for (; i < count; ++i) set_bit(lights[i], words);
}

void bits(const Lists& lists, std::uint32_t words_per_cell, std::uint32_t* words) {
  std::fill_n(words, std::size_t{lists.cell_count()} * words_per_cell, 0);
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell, words += words_per_cell)
    set_bits(lists.lights.data() + lists.begin[cell], lists.begin[cell + 1] - lists.begin[cell], words);
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(narrow_to_8);
HWY_EXPORT(narrow_to_16);
HWY_EXPORT(bits);

void narrow(const std::uint32_t* from, std::size_t count, std::uint8_t* to) {
  HWY_DYNAMIC_DISPATCH(narrow_to_8)(from, count, to);
}

void narrow(const std::uint32_t* from, std::size_t count, std::uint16_t* to) {
  HWY_DYNAMIC_DISPATCH(narrow_to_16)(from, count, to);
}

void write_bits(const Lists& lists, std::uint32_t words_per_cell, std::uint32_t* words) {
  HWY_DYNAMIC_DISPATCH(bits)(lists, words_per_cell, words);
}

}  // namespace clusterbench::assign
#endif
