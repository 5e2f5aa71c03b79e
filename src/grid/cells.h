#pragma once
// What all kinds of grids share: how cells are numbered, and where shading looks a cell up.

#include <cstdint>

#include "geom/shapes/vec.h"

namespace clusterbench::grid {

// Cells are numbered x fastest, then y, then z, so that a row is contiguous. At most 10^9 there are.
inline std::uint32_t cell_index(Vec3i cell, Vec3i cells) {
  return static_cast<std::uint32_t>((cell.z * cells.y + cell.y) * cells.x + cell.x);
}

// A point where shading happens.
struct Sample {
  float pixel_x, pixel_y;  // from the top left
  Vec3f view;              // view space, single precision
  // The exact position, along the world's axes: from the eye, as far from the origin a double holds metres only.
  Vec3d from_eye, eye;

  Vec3d from(const Vec3d& origin) const { return from_eye + (eye - origin); }
};

}  // namespace clusterbench::grid
