#pragma once
// The rows of cells that spots touch and the columns in each of them, guessed in closed form and then proven, many at
// once.
//
// What a spot has in a slice is convex, and so is what it has in a row (between two tile planes and two slice planes).
// So its extreme slopes y / w and x / w (w: the depth, without perspective 1) are at points that can be listed: the
// apex, where the sphere, the rim and the cone's side reach farthest, and where these meet the planes. That is a guess
// in single precision, and may be wrong. It counts where there is evidence larger than its own error
// (spot_cell_filter-inl.h): a common point for the cell at an end, and a plane between the spot and all that is beyond
// it.

#include <cstdint>
#include <vector>

#include "assign/cone/spot_cell_filter.h"
#include "core/arrays.h"

namespace clusterbench::assign {

// Spots (light index - points), each in a slice that it may reach. Whole vectors can be read and written beyond
// `count`.
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

// The rows that spots in slices can touch, in the order of these and from the top: no other row is touched. Of each the
// columns, first > last: none. Whole vectors can be written beyond `count`.
struct SpotRows {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> spot, slice, row;
  std::vector<std::int32_t> first, last;
  std::vector<std::uint8_t> known;  // what is proven of the columns

  static constexpr std::uint8_t k_none_before = 1, k_none_behind = 2, k_first_is_touched = 4, k_last_is_touched = 8;
  static constexpr std::uint8_t k_all = 15;

  // The rows of some spots in slices, one after the other: the index of their slice among these, the row's number.
  std::vector<std::int32_t> listed_slice, listed_row;

  void make_room(std::size_t rows);
  std::size_t capacity_bytes() const {
    return bytes_of(spot, slice, row, first, last, known, listed_slice, listed_row);
  }
};

void find_spot_rows(const view::LightArrays& lights, const RowPlanes& planes, SpotSlices& slices, SpotRows& out);

}  // namespace clusterbench::assign
