#pragma once
// Points on the surface of a cell and the directions in which a light can lie there and just touch it.

#include "core/random.h"
#include "grid/grid.h"

namespace clusterbench::stress {

// A convex body on the side of `outward` (unit) that touches the plane through `point` touches the cell there, and has
// no point nearer to it.
struct Contact {
  Vec3d point{0.0}, outward{0.0, 0.0, 1.0};
};

// A random cell, not a hole.
std::uint32_t random_cell(const grid::Grid& grid, SplitMix64& random);

// On a face, an edge or a corner. Of a shell cell: on its outer shell or its planes; its inner shell, which bulges into
// the cell, only for balls.
Contact random_contact(const geom::Cell& cell, SplitMix64& random);

}  // namespace clusterbench::stress
