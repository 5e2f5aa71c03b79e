#pragma once
// Exact corners of cells bounded by planes: products of floats are doubles.

#include <array>

#include "geom/numbers/point3.h"
#include "geom/shapes/cell.h"

namespace clusterbench::geom {

// Bits of the index select the low or high side: 1 for x, 2 for y, 4 for z, from near to far.
using Corners = std::array<Point3<double>, 8>;

inline Corners exact_corners(const Box& cell) {
  Corners corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {(i & 1) != 0 ? cell.hi.x : cell.lo.x, (i & 2) != 0 ? cell.hi.y : cell.lo.y,
                  (i & 4) != 0 ? cell.lo.z : cell.hi.z};
  return corners;
}

inline Corners exact_corners(const FrustumCell& cell) {
  if (cell.orthographic) return exact_corners(Box{{cell.x0, cell.y0, -cell.depth1}, {cell.x1, cell.y1, -cell.depth0}});
  Corners corners;
  for (unsigned i = 0; i < 8; ++i) {
    const double depth = (i & 4) != 0 ? cell.depth1 : cell.depth0;
    corners[i] = {double{(i & 1) != 0 ? cell.x1 : cell.x0} * depth, double{(i & 2) != 0 ? cell.y1 : cell.y0} * depth,
                  -depth};
  }
  return corners;
}

}  // namespace clusterbench::geom
