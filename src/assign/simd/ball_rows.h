#pragma once
// The columns that balls touch in every row of cells of a perspective frustum grid, many tile planes at once.
//
// What bounds a row is shared by its neighbours: the circle that a tile plane cuts out of the ball lies beside two
// rows, a slice plane beside two slices, a corner where both planes meet beside four rows. So each corner costs one
// square root, each tile plane two tangents, and a row's interval is the hull of what lies in it (the interval
// property, as in geom/row_slopes.h). All of it twice: for a ball that is larger than the given one by more than
// rounding can lose, and for one that is smaller.

#include <cstdint>
#include <vector>

#include "geom/shapes.h"
#include "grid/grid.h"

namespace clusterbench::assign {

// A row of cells that the larger ball touches, by its place slice * tile rows + tile row.
struct TouchedRow {
  std::uint32_t row;
  std::uint16_t outer_first, outer_last;  // columns; outside of these nothing is touched
  std::uint16_t inner_first, inner_last;  // all of these are touched; none if first > last
};

// The planes of a grid as vectors want them. Made once per grid.
struct RowPlanes {
  std::vector<float> slope, tilt, inverse_tilt;  // of the tile planes from the top; padded by whole vectors
  std::vector<float> depth, inverse_depth;       // of the slice planes
  std::vector<float> row_slope;                  // slope without padding, for scalar searches
  int rows = 0, columns = 0;
  float left = 0.0f, right = 0.0f, columns_per_slope = 0.0f;

  explicit RowPlanes(const grid::ScreenGrid& grid);
  RowPlanes() = default;
};

// The lights of a frame whose balls reach into the view, ascending; `slack` as below. Those left out touch no cell.
void cull_balls(const RowPlanes& planes, const float* x, const float* y, const float* z, const float* radius,
                const float* slack, std::uint32_t count, std::vector<std::uint32_t>& kept);

// Appends the rows that a ball touches, slice by slice. slack: in metres, more than rounding can move the centre or the
// surface by (k_ball_rows_roundings of the light's reach).
inline constexpr float k_ball_rows_roundings = 48.0f;
void find_rows(const RowPlanes& planes, const geom::Ball& ball, float slack, std::vector<float>& scratch,
               std::vector<TouchedRow>& rows);

}  // namespace clusterbench::assign
