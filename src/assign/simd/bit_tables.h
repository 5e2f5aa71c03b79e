#pragma once
// Which bits of 8 are set, looked up.

#include <array>
#include <cstdint>

namespace clusterbench::assign {

// For every 8 bits: how many are set before each of them, and which are set, ascending, and 0 behind them.
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
