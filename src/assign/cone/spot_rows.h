#pragma once
// Which cells does a spot touch? A cascade of four stages decides, each more expensive and for fewer cells:
//    1. bounds: this file. Rows and columns per spot, guessed in closed form and then proven, many at once.
//    2. filter: spot_cell_filter.h (cells) and exact/nearest_points.h (contact in a single point).
//    3. refine: the last steps of spot_cell_filter.h, and SpotSpans::refine_long_spans() for long rows.
//    4. exact:  SpotCellTest (exact/exact_rows.h), one cell at a time.
// SpotSpans (exact/spot_spans.h) runs the stages.
//
// The part of a spot in a slice is convex, and so is its part in a row (between two tile planes and two slice planes).
// So its extreme slopes y / w and x / w (w: the depth, without perspective 1) are at points that can be listed: the
// apex, the points where the sphere, the rim and the cone's side extend farthest, and the points where these meet the
// planes. This guess in single precision may be wrong. It counts only with evidence that is larger than its rounding
// error (spot_cell_filter-inl.h): a common point for the cell at each end, and a plane between the spot and the cells
// beyond that end.

#include <cstdint>
#include <vector>

#include "assign/cone/spot_cell_filter.h"
#include "core/arrays.h"

namespace clusterbench::assign {

// Spots (light index - number of points), each in a slice that it may reach. Whole vectors can be read and written
// beyond `count`.
struct SpotSlices {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> spot, slice;

  void add(std::uint32_t of_spot, std::uint32_t of_slice) {
    if (count + k_most_lanes >= spot.size()) make_room();
    spot[count] = of_spot;
    slice[count++] = of_slice;
  }
  void make_room();
  std::size_t capacity_bytes() const { return bytes_of(spot, slice); }
};

// The rows that spots in slices can touch, in the order of the input and from the top; no other rows are touched.
// `first` and `last` are the columns; first > last: none. Whole vectors can be written beyond `count`.
struct SpotRows {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> spot, slice, row;
  std::vector<std::int32_t> first, last;
  std::vector<std::uint8_t> proven;  // flags: the facts about the columns that are proven

  static constexpr std::uint8_t k_none_before = 1, k_none_after = 2, k_first_is_touched = 4, k_last_is_touched = 8;
  static constexpr std::uint8_t k_all = 15;

  // Scratch: the rows of some spots in slices, one after the other: the index of the slice in its block, and the row's
  // number.
  std::vector<std::int32_t> listed_slice, listed_row;

  void make_room(std::size_t rows);
  std::size_t capacity_bytes() const {
    return bytes_of(spot, slice, row, first, last, proven, listed_slice, listed_row);
  }
};

void find_spot_rows(const view::LightArrays& lights, const RowPlanes& planes, SpotSlices& slices, SpotRows& out);

}  // namespace clusterbench::assign
