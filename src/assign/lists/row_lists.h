#pragma once
// The lists of rows of cells, straight from the spans of their lights: each cell asks all of its row's spans at once
// and compress-stores the lights whose span holds it; where spans are many and short, a few cells at a time, for which
// the spans that hold none of them are left out first. SIMD, dispatched at run time.

#include <array>
#include <cstddef>
#include <cstdint>

#include "assign/simd/lanes.h"
#include "core/aligned_vector.h"
#include "grid/index_range.h"

namespace clusterbench::assign {

// The instruction set that is used: "AVX3", "AVX2", "SSE4", "NEON", "SCALAR" ... as Highway names it.
const char* simd_target_name();

// A span of columns in one number.
struct ColumnSpan {
  static constexpr std::uint32_t k_most_columns = 0x7fff;
  // No column; and the mark of a span of perhaps not all of its columns.
  static constexpr std::uint32_t k_none = 0xffffffff, k_uncertain = 0x80000000;
  static constexpr std::uint32_t of(std::uint32_t first, std::uint32_t last) { return first | last << 16; }
  static constexpr std::uint32_t first(std::uint32_t span) { return span & 0xffff; }
  static constexpr std::uint32_t last(std::uint32_t span) { return span >> 16; }
};

// The spans of a band's rows, each ascending by light, and `pitch` spans behind those of the row before it.
// k_most_lanes more of each can be read.
struct BandSpans {
  std::uint32_t *sizes, *columns, *lights;  // columns: ColumnSpan
  std::size_t pitch;
  std::uint32_t rows, row_columns;
  std::uint32_t width = 0;  // about how many columns spans have: says only which way to take
};
// Cells that take no lights: spans may cover them, their lists stay empty.
struct BandHole {
  grid::IndexRange rows, columns;
};

// For each of some strips of a few columns: lights whose spans hold some of it, and a bit for each column. Keeps its
// memory between rows.
struct FewColumns {
  struct Strip {
    AlignedVector<std::uint32_t> lights, bits;
  };
  static constexpr std::size_t k_strips = 4;
  std::array<Strip, k_strips> strips;

  void make_room(std::size_t spans) {
    if (strips[0].bits.size() >= spans + k_most_lanes) return;
    for (Strip& strip : strips) {
      strip.lights.resize(2 * spans + k_most_lanes);
      strip.bits.resize(2 * spans + k_most_lanes);
    }
  }
  std::size_t capacity_bytes() const {
    std::size_t entries = 0;
    for (const Strip& strip : strips) entries += strip.lights.capacity() + strip.bits.capacity();
    return entries * sizeof(std::uint32_t);
  }
};

// ListBuilder's add_batch and add_rows, to rows that have room for a vector more.
bool add_batch_rows(const BandSpans& band, int first_row, int last_row, const std::uint32_t* columns,
                    const std::uint32_t* lights, std::uint8_t* is_left);
void add_listed_rows(const BandSpans& band, int first_row, int last_row, const std::uint32_t* sizes,
                     const std::uint32_t* columns, const std::uint32_t* lights);

// How many columns all spans have.
std::uint64_t pairs_of(const BandSpans& band);

// Writes the lights of each column, row after row, to `to`, and to the next of `begin` where its list begins, counted
// from `lists`. Up to k_most_lanes more than the lights is written. Returns the end.
std::uint32_t* write_band_lists(const BandSpans& band, const BandHole& hole, FewColumns& few, std::uint32_t* to,
                                const std::uint32_t* lists, std::uint32_t* begin);

}  // namespace clusterbench::assign
