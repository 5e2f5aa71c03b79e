#pragma once
// World grids: boxes that stay where they are.

#include <vector>

#include "geom/shapes.h"
#include "grid/cells.h"
#include "grid/grid_spec.h"

namespace clusterbench::grid {

// A fixed box grid in world space. Boundaries are relative to `origin`, single precision, ascending. Index (x, y, z)
// runs along the world axes.
struct WorldGrid {
  Vec3d origin{0.0};
  std::vector<float> x, y, z;

  Kind kind() const { return Kind::world; }
  Vec3i counts() const;
  geom::Cell cell(Vec3i at) const;
  std::int64_t lookup(const Sample& sample, Log2 way) const;
};

// Throws Error (where = configuration key) for what cannot be.
WorldGrid make_world_grid(const GridSpec& spec, const GridInputs& inputs);
GridInputs world_inputs(const GridSpec& spec, const FrameReach& from);
std::string world_grid_name(const GridSpec& spec);

}  // namespace clusterbench::grid
