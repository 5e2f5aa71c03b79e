#pragma once
// Finished lists in the formats of buffers: narrow indices, or bits. SIMD, dispatched at run time.

#include <cstddef>
#include <cstdint>

#include "assign/contract/lists.h"

namespace clusterbench::assign {

// to[i] = from[i]; the values fit.
void narrow(const std::uint32_t* from, std::size_t count, std::uint8_t* to);
void narrow(const std::uint32_t* from, std::size_t count, std::uint16_t* to);

// Cell c's light l becomes bit l % 32 of words[c * words_per_cell + l / 32]; all other bits become 0.
void write_bits(const Lists& lists, std::uint32_t words_per_cell, std::uint32_t* words);

}  // namespace clusterbench::assign
