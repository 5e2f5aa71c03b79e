#pragma once
// The lists of a row of cells, straight from the spans of its lights: each cell compares all of the row's spans at once
// and compress-stores the lights whose span holds it, as 8, 16 or 32 bits wide indices; or all cells at once take each
// span's bit. SIMD, dispatched at run time.

#include <cstdint>
#include <type_traits>

namespace clusterbench::assign {

inline constexpr std::size_t k_most_lanes = 64;  // of any target: what arrays are padded by

// The spans of one row, ascending by light, and the columns whose lists are wanted. k_most_lanes more of each can be
// read. Index is std::uint8_t, std::uint16_t or std::uint32_t; column + 1 fits into its signed twin.
template <class Index>
struct RowSpans {
  using Column = std::make_signed_t<Index>;
  const Index* lights;
  const Column* before;  // first column - 1
  const Column* after;   // last column + 1
  std::uint32_t count, column, end_column;
};

// Writes each column's lights to `to`, and to begin[column] where its list begins, counted from `lists`. Up to
// k_most_lanes more than the lights is written. Returns the end.
std::uint8_t* write_row_lists(const RowSpans<std::uint8_t>& row, std::uint8_t* to, const std::uint8_t* lists,
                              std::uint32_t* begin);
std::uint16_t* write_row_lists(const RowSpans<std::uint16_t>& row, std::uint16_t* to, const std::uint16_t* lists,
                               std::uint32_t* begin);
std::uint32_t* write_row_lists(const RowSpans<std::uint32_t>& row, std::uint32_t* to, const std::uint32_t* lists,
                               std::uint32_t* begin);

// Light l of column c is bit l % 32 of words[c * words_per_cell + l / 32]. All words of these columns are written.
void write_row_bits(const RowSpans<std::uint32_t>& row, std::uint32_t words_per_cell, std::uint32_t* words);

}  // namespace clusterbench::assign
