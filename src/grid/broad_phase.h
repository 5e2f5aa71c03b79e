#pragma once
// Broad phase: the cells of a grid that a ball may touch, row by row and in double precision. For each row an outer
// range of columns beyond which no cell is touched, and an inner range of columns that are touched for certain. For the
// truth and for searches; methods have their own.
//
// Outer and inner come from the same formulas with the radius made larger or smaller by a slack. All that double
// precision loses in them (rounded squares under a root, rounded centres, rounded quotients) moves a result no further
// than moving the centre or the surface by a few roundoffs of the coordinates would; the slack is hundreds of these.

#include <cstdint>
#include <vector>

#include "geom/shapes/vec.h"
#include "grid/index_range.h"

namespace clusterbench::grid {

// A light's ball (of a spot: its range) in the grid's space.
struct BallInSpace {
  Vec3d center{0.0};
  double radius = 0.0;  // finite
  double slack = 0.0;
};

// Cells that are neighbours in one row, by their columns.
struct CellRow {
  std::uint32_t first_cell = 0;  // of the row's column 0, in slice 0 of `slices`
  IndexRange outer, inner;
  IndexRange slices{0, 0};  // one cell of each column in each of these
};

// Made for one grid, which outlives it.
class BroadPhase {
 public:
  virtual ~BroadPhase() = default;
  virtual void append_rows(const BallInSpace& ball, std::vector<CellRow>& rows) const = 0;
};

// A block of boxes, numbered x fastest from first_cell. Extents per index, ascending or descending.
struct Extent {
  double lo, hi;
};
struct BoxBlock {
  std::vector<Extent> x, y, z;  // x ascends
  std::uint32_t first_cell = 0;
  IndexRange hole_x{}, hole_y{}, hole_z{};  // indices of the block that is cut out of it
};
// The extents between neighbours among boundaries.
std::vector<Extent> extents_between(const std::vector<float>& boundaries);

// For grids of boxes, as blocks. Rows beside a hole come in two runs.
class BoxBroadPhase final : public BroadPhase {
 public:
  explicit BoxBroadPhase(std::vector<BoxBlock> blocks) : blocks_(std::move(blocks)) {}
  void append_rows(const BallInSpace& ball, std::vector<CellRow>& rows) const override;

 private:
  std::vector<BoxBlock> blocks_;
};

}  // namespace clusterbench::grid
