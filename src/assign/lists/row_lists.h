#pragma once
// The lists of rows of cells, directly from the spans of their lights: each cell tests all of its row's spans at once
// and compress-stores the lights whose span contains it. If spans are many and short, a few cells are done at a time,
// and the spans that miss all of them are removed first. SIMD, dispatched at run time.

#include <array>
#include <cstddef>
#include <cstdint>

#include "assign/simd/lanes.h"
#include "core/aligned_vector.h"
#include "grid/index_range.h"

namespace clusterbench::assign {

// The instruction set in use: "AVX3", "AVX2", "SSE4", "NEON", "SCALAR" ... as Highway names it.
const char* simd_target_name();

// A span of columns in one number.
struct ColumnSpan {
  static constexpr std::uint32_t k_most_columns = 0x7fff;
  // No column; and the mark of a span of which some columns may be untouched.
  static constexpr std::uint32_t k_none = 0xffffffff, k_uncertain = 0x80000000;
  static constexpr std::uint32_t of(std::uint32_t first, std::uint32_t last) { return first | last << 16; }
  static constexpr std::uint32_t first(std::uint32_t span) { return span & 0xffff; }
  static constexpr std::uint32_t last(std::uint32_t span) { return span >> 16; }
};

// The spans of a band's rows, each ascending by light; each row begins `pitch` spans after the row before it.
// k_most_lanes more of each can be read.
struct BandSpans {
  std::uint32_t *sizes, *columns, *lights;  // columns: ColumnSpan
  std::size_t pitch;
  std::uint32_t rows, row_columns;
  std::uint32_t width = 0;  // approximate number of columns of a span: only selects the faster algorithm
};
// Cells without lights: spans may cover them, but their lists stay empty.
struct BandHole {
  grid::IndexRange rows, columns;
};

// For each of some strips of a few columns: the lights whose spans touch it, and a bit for each column. Keeps its
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

// ListBuilder's add_batch and add_rows, for rows that have room for one more vector.
bool add_batch_rows(const BandSpans& band, int first_row, int last_row, const std::uint32_t* columns,
                    const std::uint32_t* lights, std::uint8_t* is_left);
void add_listed_rows(const BandSpans& band, int first_row, int last_row, const std::uint32_t* sizes,
                     const std::uint32_t* columns, const std::uint32_t* lights);

// The number of columns of all spans.
std::uint64_t pairs_of(const BandSpans& band);

// Writes the lights of each column, row after row, to `to`, and the start of each list, relative to `lists`, to
// `begin`. Up to k_most_lanes more numbers than the lights are written. Returns the end.
std::uint32_t* write_band_lists(const BandSpans& band, const BandHole& hole, FewColumns& few, std::uint32_t* to,
                                const std::uint32_t* lists, std::uint32_t* begin);

}  // namespace clusterbench::assign
