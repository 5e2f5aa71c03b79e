#pragma once
// The columns of a row that a spot touches, guessed in closed form and then proven, many rows at once.
//
// What a spot has in a row (between two tile planes and two slice planes) is convex, so its extreme slopes x / depth
// are at places that can be listed: the apex, where the sphere, the rim and the cone's side lean most, and where these
// meet the row's faces and edges. That is a guess in single precision, and may be wrong. It counts where there is
// evidence larger than its own error (spot_cells.h): a common point for the cell at an end, and a plane between the
// spot and the cell beyond it.

#include <cstdint>
#include <vector>

#include "assign/simd/spot_cells.h"

namespace clusterbench::assign {

// Of rows that are given as pairs of a spot and the columns that it can touch at most. Whole vectors can be written
// beyond their count.
struct SpotRowEnds {
  std::vector<std::int32_t> first, last;  // the guesses
  std::vector<std::uint8_t> known;        // the guesses that are proven

  // The first column, the last; that none was found, which is not proven.
  static constexpr std::uint8_t k_first = 1, k_last = 2, k_found_none = 4;

  void make_room(std::uint32_t rows);
  std::size_t capacity_bytes() const { return first.capacity() * (2 * sizeof(std::int32_t) + 1); }
};

void find_ends(const SpotsAndPlanes& from, const RowPlanes& planes, SpotCells& rows, SpotRowEnds& ends);

}  // namespace clusterbench::assign
