#pragma once
// Spots that may just touch runs of rows, many at once: in doubles with a bound of their error, the point of a run
// that is nearest to a spot's apex. If it lies at the range, or beyond, it tells whether there is a common point; on
// lattices, where nothing or little is rounded, it does even where it is the only one, and then says in which columns.

#include <cstdint>
#include <vector>

#include "assign/cone/spot_cell_filter.h"
#include "assign/cull/row_planes.h"
#include "grid/index_range.h"

namespace clusterbench::assign {

// Pairs of a spot and neighbouring cells of a row, and the answers. Whole vectors can be read and written beyond the
// last.
class SpotTouches {
 public:
  void clear() { runs.count = 0; }
  void add(const SpotCell& run) { runs.add(run); }
  std::uint32_t count() const { return runs.count; }
  // Spots of less reach than planes.least_reach, or of more than k_most_row_reach, are left uncertain.
  void look(const view::LightArrays& lights, const RowPlanes& planes);

  Touch touch(std::uint32_t index) const { return runs.touch[index]; }
  // Columns of a run that are touched, and no others of it are: where a point is all that is shared. Empty where that
  // is not known.
  grid::IndexRange only_columns(std::uint32_t index, const RowPlanes& planes) const;
  std::size_t capacity_bytes() const {
    return runs.capacity_bytes() + bytes_of(x, x_error, depth, depth_error, is_alone, side);
  }

  // For look(): of the nearest point, from the eye.
  SpotCells runs;
  std::vector<double> x, x_error, depth, depth_error;
  std::vector<std::uint8_t> is_alone;  // the only one that is shared
  std::vector<std::int8_t> side;       // -1: on the run's left side, 1: on its right one
};

}  // namespace clusterbench::assign
