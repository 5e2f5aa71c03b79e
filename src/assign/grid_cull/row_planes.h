#pragma once
// The planes of a frustum grid.

#include <vector>

#include "grid/grid.h"

namespace clusterbench::assign {

// The planes of a grid in the layout that vectors need. Made once per grid. A slope is x / depth or y / depth; in an
// orthographic projection, x or y itself.
struct RowPlanes {
  // Planes nearer to the eye than 1e-10 m are moved to that depth.
  static constexpr float k_most_inverse_depth = 1e10f;
  static constexpr float k_least_slice_m = 1e-6f, k_most_slope = 1e4f;

  bool orthographic = false;
  std::vector<float> slope;                 // of the tile planes from the top, padded by whole vectors
  std::vector<float> depth, inverse_depth;  // of the slice planes
  std::vector<float> searched;              // the slices' near depths, padded with +inf to 2^n of them
  std::vector<float> side;                  // slopes of the columns, padded likewise
  int rows = 0, columns = 0, slices = 0;
  float left = 0.0f, right = 0.0f, columns_per_slope = 0.0f, column_tolerance = 0.0f;
  float rows_per_slope = 0.0f, row_tolerance = 0.0f;
  // The rows of lights of less reach are decided exactly. From here to k_most_row_reach, fourth powers of reaches, and
  // squares of these times a slope, are normal numbers, and a ball at the eye is wide in all that is seen. Infinite for
  // grids of coordinates above k_most_row_reach, in perspective also of slices below k_least_slice_m or slopes above
  // k_most_slope.
  //
  // For slices nearer to the eye than k_most_inverse_depth can represent, a ball's slack, 28 * 2^-24 of its reach, is
  // also sixteen times as long as any path along a line through the eye from there to that depth. So for each point of
  // the ball nearer to the eye, the larger ball has a point at that depth, at the same slope; and for each point of the
  // larger ball there, a ball that is larger by a sixteenth of the slack has one nearer to the eye.
  float least_reach = 0.0f;

  explicit RowPlanes(const grid::ScreenGrid& grid);
  RowPlanes() = default;
};

}  // namespace clusterbench::assign
