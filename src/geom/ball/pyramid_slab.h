#pragma once
// A pyramid of tile planes between two depths, as BallDecider uses it.

#include <cmath>
#include <limits>

#include "geom/ball/pyramid_view.h"
#include "geom/shapes/cell.h"

namespace clusterbench::geom {

inline constexpr double k_infinity = std::numeric_limits<double>::infinity();

// The part between four tile planes and two depths; far may be infinite.
struct PyramidSlab {
  float x0, x1, y0, y1;
  double near, far;
};

inline double slope_on(Side side, float low, float high) {
  return side == Side::low ? low : side == Side::high ? high : 0.0;
}

// Tests the rays in which the tile planes of a pyramid meet, by their slopes. True as soon as test(x, y) is.
template <class Test>
bool any_ray(const PyramidSlab& pyramid, Test&& test) {
  for (const float x : {pyramid.x0, pyramid.x1})
    for (const float y : {pyramid.y0, pyramid.y1})
      if (test(x, y)) return true;
  return false;
}

inline PyramidSlab pyramid_of(const ShellCell& cell) {
  return {cell.x0, cell.x1, cell.y0, cell.y1, 0.0, k_infinity};
}

}  // namespace clusterbench::geom
