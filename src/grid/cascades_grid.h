#pragma once
// Cascades: boxes around the eye, each level twice as coarse and as wide as the previous one.

#include <cmath>
#include <memory>

#include "geom/shapes/cell.h"
#include "grid/broad_phase.h"
#include "grid/cells.h"
#include "grid/grid_spec.h"

namespace clusterbench::grid {

// Nested view-space boxes of cubical cells. Level l has cells of edge finest * 2^l and spans, in units of its edge, x,
// y in [-cells/2, cells/2] and depth in [0, cells.z]. Cells of a level that lie in the finer level's box are holes:
// they have an index and no space. cells.x, cells.y are multiples of 4, cells.z of 2, so a cell is wholly inside or
// outside. z index 0 is nearest the eye; y index 0 is the top.
struct CascadesGrid {
  int levels = 1;
  Vec3i cells{16, 16, 16};  // of each level; grid z runs over level * cells.z + z
  float finest_m = 0.5f;

  float edge_m(int level) const;
  bool is_hole(int level, Vec3i cell) const;

  Kind kind() const { return Kind::cascades; }
  Vec3i counts() const { return {cells.x, cells.y, cells.z * levels}; }
  bool is_hole(Vec3i at) const { return is_hole(at.z / cells.z, {at.x, at.y, at.z % cells.z}); }
  geom::Cell cell(Vec3i at) const;
  std::int64_t lookup(const Sample& sample, Log2 way) const;
  std::unique_ptr<BroadPhase> broad_phase() const;
};

// Inline, since methods and truth call it for every cell.
inline float CascadesGrid::edge_m(int level) const {
  return std::ldexp(finest_m, level);
}

inline geom::Cell CascadesGrid::cell(Vec3i at) const {
  const int level = at.z / cells.z;
  const float edge = edge_m(level);
  // Whole multiples of a power of two times `finest`: the same real boundary rounds to the same float on every level.
  const auto times = [edge](int n) { return static_cast<float>(n) * edge; };
  const int left = at.x - cells.x / 2;
  const int top = cells.y / 2 - at.y;
  const int depth = at.z % cells.z;
  return geom::Box{{times(left), times(top - 1), -times(depth + 1)}, {times(left + 1), times(top), -times(depth)}};
}

// Throws Error (where = configuration key) for an impossible grid.
CascadesGrid make_cascades_grid(const GridSpec& spec, const GridInputs& inputs);
GridInputs cascades_inputs(const GridSpec& spec, const FrameReach& from);

}  // namespace clusterbench::grid
