#pragma once
// Broad phase: the cells of a grid that a ball may touch, row by row and in double precision. Each row has an outer
// range of columns, beyond which no cell is touched, and an inner range of columns that are certainly touched. Used by
// the truth and by searches; methods have their own.
//
// Outer and inner ranges come from the same formulas, with the radius increased or decreased by a slack. The rounding
// errors of double precision (squares under a root, centres, quotients) move a result no further than a move of the
// centre or the surface by a few roundoffs of the coordinates; the slack is hundreds of these.

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

// Neighbouring cells of one row, by their columns.
struct CellRow {
  std::uint32_t first_cell = 0;  // of the row's column 0, in slice 0 of `slices`
  IndexRange outer, inner;
  IndexRange slices{0, 0};  // one cell of each column in each of these
};

// Made for one grid, which must outlive it.
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
  IndexRange hole_x{}, hole_y{}, hole_z{};  // indices that are cut out of the block
};
// The extents between neighbouring boundaries.
std::vector<Extent> extents_between(const std::vector<float>& boundaries);

// For grids of boxes, as blocks. A row with a hole gives two runs.
class BoxBroadPhase final : public BroadPhase {
 public:
  explicit BoxBroadPhase(std::vector<BoxBlock> blocks) : blocks_(std::move(blocks)) {}
  void append_rows(const BallInSpace& ball, std::vector<CellRow>& rows) const override;

 private:
  std::vector<BoxBlock> blocks_;
};

}  // namespace clusterbench::grid
