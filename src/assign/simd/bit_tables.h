#pragma once
// Lookup tables of the bits set in 8 bits.

#include <array>
#include <cstdint>

namespace clusterbench::assign {

// For every 8 bits: the number of set bits before each of them; and the indices of the set bits, ascending, followed by
// 0.
struct BitTables {
  std::array<std::array<std::uint8_t, 8>, 256> ranks, lanes;
};
inline constexpr BitTables k_bit_tables = [] {
  BitTables tables{};
  for (unsigned bits = 0; bits < 256; ++bits)
    for (unsigned lane = 0, set = 0; lane < 8; ++lane) {
      tables.ranks[bits][lane] = static_cast<std::uint8_t>(set);
      if ((bits >> lane & 1) != 0) tables.lanes[bits][set++] = static_cast<std::uint8_t>(lane);
    }
  return tables;
}();

}  // namespace clusterbench::assign
