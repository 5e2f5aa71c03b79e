#pragma once
// Do point lights touch single cells of a frustum grid? Many pairs at once, in doubles with a bound of their error, as
// geom::BallDecider does before it turns to exact numbers (its answers are the same; which pairs are left open is not).
// Where a machine cannot multiply and add with one rounding, every pair is.

#include <cstdint>
#include <vector>

#include "assign/simd/spot_cells.h"
#include "geom/shapes.h"
#include "view/frame.h"

namespace clusterbench::assign {

// Pairs of a ball and a cell, and the answers. Whole vectors can be read and written beyond `count`.
struct BallCells {
  std::uint32_t count = 0;
  std::vector<double> x, y, z, range;                  // the light, in world space; of endless ones nothing is said
  std::vector<double> x0, x1, y0, y1, depth0, depth1;  // the cell, as in geom::FrustumPiece
  std::vector<Touch> touch;

  // Before the first add().
  void reserve(std::size_t most);
  void add(const scene::WorldLight& light, const geom::FrustumPiece& cell);
  std::size_t capacity_bytes() const { return touch.capacity() * (10 * sizeof(double) + sizeof(Touch)); }
};

// `space`: that of the grid, in which the cells are given.
void look_at_balls(const view::Space& space, bool orthographic, BallCells& cells);

}  // namespace clusterbench::assign
