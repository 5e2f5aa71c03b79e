#pragma once
// Common to all kinds of grids: the numbering of cells, and the points at which shading looks up a cell.

#include <cstdint>

#include "geom/shapes/vec.h"

namespace clusterbench::grid {

// Cells are numbered x fastest, then y, then z, so that a row is contiguous. There are at most 10^9.
inline std::uint32_t cell_index(Vec3i cell, Vec3i cells) {
  return static_cast<std::uint32_t>((cell.z * cells.y + cell.y) * cells.x + cell.x);
}

// A point where shading happens.
struct Sample {
  float pixel_x, pixel_y;  // from the top left
  Vec3f view;              // view space, single precision
  // The exact position, along the world's axes: relative to the eye, since far from the origin a double only resolves
  // metres.
  Vec3d from_eye, eye;

  Vec3d from(const Vec3d& origin) const { return from_eye + (eye - origin); }
};

}  // namespace clusterbench::grid
