#pragma once
// The cells of their boxes that many balls touch: slice by slice, one ball per lane, each lane through its own rows,
// and in each row from the box's first column to its last. What a lane does is what the scalar methods do, the same
// operations in the same order, so the cells are the same.

#include <cstdint>
#include <vector>

#include "assign/bounds/tile_planes.h"
#include "assign/pipeline/bounded_balls.h"
#include "assign/rows/slice_rows.h"
#include "core/arrays.h"
#include "grid/grid.h"

namespace clusterbench::assign {

// Memory for what a batch's lanes know of their columns; kept between batches.
struct LaneColumns {
  AlignedVector<float> first, second;

  void reserve(std::size_t size) { grow_to(size, first, second); }
  std::size_t capacity_bytes() const { return bytes_of(first, second); }
};

// All cells of the boxes.
void find_bounds_rows(int rows, const BallBatch& batch, BatchRows& out);

// Sphere refinement (assigners/sphere_refinement.cpp).
struct RefinementPlanes {
  std::vector<float> column_across, column_along, row_across, row_along;  // of the tile planes
  std::vector<float> column_offset, row_offset;                           // none in perspective: all are 0
  std::vector<float> depths;                                              // of the slices

  explicit RefinementPlanes(const grid::ScreenGrid& grid);
  RefinementPlanes() = default;
  std::size_t capacity_bytes() const;
};
void find_refined_rows(const RefinementPlanes& planes, const BallBatch& batch, LaneColumns& columns, BatchRows& out);

// The boxes around the cells (assigners/aabb.cpp), or those that are the cells (assign/box_grid/box_ranges.h). Within a
// slice a cell's box has its column's extent in x, its row's in y and the slice's in z.
struct CellExtents {
  struct Axis {
    std::vector<float> lo, hi;
    int pitch = 0;  // from one slice to the next; 0: the same for all slices
  };
  Axis x, y, z;
  int columns = 0, rows = 0;

  explicit CellExtents(const grid::Grid& grid);
  CellExtents() = default;
  std::size_t capacity_bytes() const;
};
void find_box_rows(const CellExtents& cells, const BallBatch& batch, LaneColumns& columns, BatchRows& out);

}  // namespace clusterbench::assign
