#pragma once
// The columns that balls touch in every row of cells of a frustum grid: slice by slice, many balls at once, one per
// lane, each through its own rows.
//
// With x / depth, y / depth and 1 / depth as coordinates, columns, rows and slices are slabs. The part of a convex body
// in a row of a slice extends farthest to the side in one point, which is computed from the ball (sphere_setup.h) and
// is moved into the row, then into the slice. A row's columns go from the least slope x / depth in it to the greatest
// (the interval property, as in geom/projection/row_slopes.h). Rows of orthographic grids are boxes, and there a ball's
// part of a row has the width of a disk's chord.
//
// Every ball is enlarged by its slack, which is more than the rounding errors, so no column is lost. The excess of a
// result is bounded, too: see Certainty in slice_rows.cpp. Ends of spans for which the excess may matter are marked.

#include <array>
#include <cstdint>
#include <span>

#include "assign/grid_cull/frustum_cull.h"
#include "assign/grid_cull/row_planes.h"
#include "assign/lists/list_builder.h"
#include "assign/rows/sphere_setup.h"
#include "core/aligned_vector.h"
#include "core/arrays.h"

namespace clusterbench::assign {

// Rows of a batch of balls within one slice. Row r (first_row <= r <= last_row, the rows that any ball may touch) of
// ball i has the columns at columns[r * lanes + i].
struct BatchRows {
  static constexpr std::uint32_t k_none = ColumnSpan::k_none;            // no column
  static constexpr std::uint32_t k_uncertain = ColumnSpan::k_uncertain;  // perhaps with untouched columns at its ends
  static int first_of(std::uint32_t columns) { return static_cast<int>(columns & 0x3fff); }
  static int last_of(std::uint32_t columns) { return static_cast<int>(columns >> 16 & 0x3fff); }

  std::uint32_t lanes = 0;
  alignas(64) std::uint32_t lights[k_most_lanes];
  int first_row = 0, last_row = -1;
  std::uint32_t tests = 0;  // rows of single balls that were tested
  // One row more than the grid has, for unused results.
  AlignedVector<std::uint32_t> columns;

  void make_room(int of_rows) { grow_to((static_cast<std::size_t>(of_rows) + 1) * k_row_lanes, columns); }
  std::size_t capacity_bytes() const { return columns.capacity() * sizeof(std::uint32_t); }
};

// The same as a list: row after row the spans of the balls that may touch it, in the order of the balls. A span is as
// in BatchRows; k_none marks a ball that turned out to have no columns. Whole vectors can be read from each span on.
struct BatchSpans {
  // Marks of a span: that end may be beyond the touched columns.
  static constexpr std::uint32_t k_first_is_uncertain = 0x4000, k_last_is_uncertain = 0x8000;

  int first_row = 0, last_row = -1;
  std::uint32_t tests = 0, count = 0;
  AlignedVector<std::uint32_t> sizes;  // the number of spans of each row, first_row to last_row
  AlignedVector<std::uint32_t> lights, columns;
  // The indices of uncertain spans, ascending.
  std::uint32_t uncertain_count = 0;
  AlignedVector<std::uint32_t> uncertain;
  // Scratch: the row of each span, the lane of its ball, and the ball's extent there (slopes from low to high).
  AlignedVector<std::uint32_t> row_balls;
  AlignedVector<float> low, high;

  // Whole vectors are written and read from each span on, and one after the last.
  void make_room(int of_rows) {
    const auto rows = static_cast<std::size_t>(of_rows), size = (rows + 2) * k_row_lanes;
    if (row_balls.size() >= size) return;
    sizes.resize(rows);
    grow_to(size, lights, columns, uncertain, row_balls, low, high);
  }
  std::size_t capacity_bytes() const { return bytes_of(sizes, lights, columns, uncertain, row_balls, low, high); }
};
inline constexpr int k_most_columns = 0x3fff;

// The number of balls in a batch on this machine.
std::uint32_t balls_per_batch();

// The number of batches found together, each of one slice.
inline constexpr std::uint32_t k_batches_at_once = 4;
using RowBatches = std::array<BatchSpans, k_batches_at_once>;

// Balls of one slice: indices in SphereSetup, from which a whole vector can be read beyond `count`.
struct BallsOfSlice {
  int slice;
  const std::uint32_t* indices;
  std::uint32_t count;  // at most balls_per_batch()
};
// Finds a batch of rows for each of `balls`, which are at most k_batches_at_once.
void find_rows(const RowPlanes& planes, const SphereSetup& shapes, std::span<const BallsOfSlice> balls,
               RowBatches& out);

}  // namespace clusterbench::assign
