#pragma once
// World grids: boxes along the world's axes. They are fixed, or follow the camera in whole cells, or the lights in
// view.

#include <memory>
#include <vector>

#include "geom/shapes/cell.h"
#include "grid/broad_phase.h"
#include "grid/cells.h"
#include "grid/grid_spec.h"

namespace clusterbench::grid {

// A box grid in world space. Boundaries are relative to `origin`, single precision, ascending. Index (x, y, z) runs
// along the world axes.
struct WorldGrid {
  Vec3d origin{0.0};
  std::vector<float> x, y, z;

  Kind kind() const { return Kind::world; }
  Vec3i counts() const;
  geom::Cell cell(Vec3i at) const;
  std::int64_t lookup(const Sample& sample, Log2 way) const;
  std::unique_ptr<BroadPhase> broad_phase() const;
};

// Inline, since methods and truth call it for every cell.
inline Vec3i WorldGrid::counts() const {
  const auto count = [](const std::vector<float>& planes) { return static_cast<int>(planes.size()) - 1; };
  return {count(x), count(y), count(z)};
}

inline geom::Cell WorldGrid::cell(Vec3i at) const {
  const auto i = static_cast<std::size_t>(at.x), j = static_cast<std::size_t>(at.y), k = static_cast<std::size_t>(at.z);
  return geom::Box{{x[i], y[j], z[k]}, {x[i + 1], y[j + 1], z[k + 1]}};
}

// Throws Error (where = configuration key) for an impossible grid.
WorldGrid make_world_grid(const GridSpec& spec, const GridInputs& inputs);
GridInputs world_inputs(const GridSpec& spec, const FrameReach& from);

}  // namespace clusterbench::grid
