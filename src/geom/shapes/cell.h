#pragma once
// The shapes of cells. Lengths in metres. Cells are closed sets; the single-precision bounds are used as exact numbers.

#include <variant>

#include "geom/shapes/vec.h"

namespace clusterbench::geom {

// A cell of a frustum grid, in view space (x right, y up, camera looks down -z; depth = -z):
// perspective:  x0*depth <= x <= x1*depth, y0*depth <= y <= y1*depth, depth0 <= depth <= depth1
// orthographic: x0 <= x <= x1, y0 <= y <= y1, depth0 <= depth <= depth1
struct FrustumCell {
  float x0, x1, y0, y1;  // slopes (perspective) or metres (orthographic), ascending
  float depth0, depth1;  // ascending; >= 0 for perspective
  bool orthographic;
};

// A pyramid through the eye cut by two shells: x0*depth <= x <= x1*depth, y0*depth <= y <= y1*depth, depth >= 0,
// distance0 <= |p| <= distance1.
struct ShellCell {
  float x0, x1, y0, y1;
  float distance0, distance1;
};

struct Box {
  Vec3f lo, hi;
};

using Cell = std::variant<FrustumCell, ShellCell, Box>;

}  // namespace clusterbench::geom
