#pragma once
// The cells that many balls touch within their boxes: slice by slice, one ball per lane, each lane through its own
// rows, and in each row from the box's first column to its last. A lane does the same operations as the scalar methods,
// in the same order, so the cells are the same.

#include <cstdint>
#include <vector>

#include "assign/bounds/cell_extents.h"
#include "assign/bounds/tile_planes.h"
#include "assign/pipeline/bounded_balls.h"
#include "assign/rows/slice_rows.h"
#include "core/arrays.h"
#include "grid/grid.h"

namespace clusterbench::assign {

// Memory for the values of a batch's columns, one per lane; kept between batches.
struct LaneColumns {
  AlignedVector<float> first, second;

  void reserve(std::size_t size) { grow_to(size, first, second); }
  std::size_t capacity_bytes() const { return bytes_of(first, second); }
};

// All cells of the boxes.
void find_bounds_rows(int rows, const BallBatch& batch, BatchRows& out);

// Sphere refinement (assigners/sphere_refinement.cpp).
struct RefinementPlanes {
  std::vector<TilePlane> columns, rows;
  std::vector<float> depths;  // of the slices

  RefinementPlanes() = default;
  explicit RefinementPlanes(const grid::ScreenGrid& grid)
      : columns(tile_planes(grid.tiles.x, grid.tiles.orthographic)),
        rows(tile_planes(grid.tiles.y, grid.tiles.orthographic)),
        depths(grid.slices.boundaries) {}
  std::size_t capacity_bytes() const { return bytes_of(columns, rows, depths); }
};
void find_refined_rows(const RefinementPlanes& planes, const BallBatch& batch, LaneColumns& columns, BatchRows& out);

// With the boxes around the cells (assigners/aabb.cpp), or with boxes that are the cells (assign/box_grid/).
void find_box_rows(const CellExtents& cells, const BallBatch& batch, LaneColumns& columns, BatchRows& out);

}  // namespace clusterbench::assign
