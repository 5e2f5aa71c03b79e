#pragma once
// Lists without scattering over the grid: the spans of a row of cells are collected side by side. Then each cell
// compares all of them at once and compress-stores the lights whose span contains it (row_lists.h). Bands of rows are
// finished one after the other, so that their spans are still in the cache. SIMD, dispatched at run time; the same
// lists as PairBuffer on every target.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "assign/contract/lists.h"
#include "assign/lists/row_lists.h"

namespace clusterbench::assign {

// Keeps its memory between frames.
class ListBuilder {
 public:
  // Starts a frame of `bands` bands; a band is `rows` rows (a slice, say) of `columns` cells, at most
  // ColumnSpan::k_most_columns. `out` must outlive finish().
  void start(std::uint32_t bands, std::uint32_t rows, std::uint32_t columns, Lists& out);
  // Adds a span to the present band. Lights must come in ascending order within a row, in each cell once. first <= last
  // < columns.
  void add(std::uint32_t row, std::uint32_t first, std::uint32_t last, std::uint32_t light) {
    std::uint32_t& size = sizes_[row];
    if (size == band_.pitch) grow();
    const std::size_t index = row * band_.pitch + size++;
    most_ = std::max(most_, size);
    lights_[index] = light;
    columns_[index] = ColumnSpan::of(first, last);
  }
  // Adds a batch of lights' spans to rows first_row .. last_row. columns[row * lanes + i]: the span of lights[i] as a
  // ColumnSpan, k_none, or with k_uncertain set a span that must not be added as it is. Rows with such spans are
  // skipped: is_left[row] is set for them, and the result is whether there are any. `lanes`: as many as fit into a
  // vector.
  bool add_batch(int first_row, int last_row, const std::uint32_t* columns, const std::uint32_t* lights,
                 std::uint8_t* is_left);
  // Adds spans row after row: sizes[row] to each of rows first_row .. last_row, at most as many as fit into a vector.
  // k_none is a span without columns. Whole vectors can be read from each span on.
  void add_rows(int first_row, int last_row, const std::uint32_t* sizes, const std::uint32_t* columns,
                const std::uint32_t* lights);
  // Writes the band's lists; the next band begins. Throws Error beyond 2^32 - 1 pairs or the limit on memory.
  void finish_band(const BandHole& hole = {});
  // After the last band.
  void finish();

  std::size_t capacity_bytes() const;

 private:
  void make_room(std::uint32_t spans);
  void point_to_spans();
  void grow();

  std::uint32_t bands_done_ = 0;
  std::uint64_t pairs_ = 0;
  Lists* out_ = nullptr;
  std::vector<std::uint32_t> sizes_;  // of the rows
  std::uint32_t most_ = 0;            // the largest of sizes_
  FewColumns few_;
  // Whole vectors can be read and written beyond the last row.
  AlignedVector<std::uint32_t> lights_, columns_;
  BandSpans band_{};  // pointers into these
};

}  // namespace clusterbench::assign
