#pragma once
// Frustum and distance grids: tiles of the picture x slices of depth, or x shells of distance around the eye.

#include <cmath>
#include <memory>

#include "geom/shapes/cell.h"
#include "grid/broad_phase.h"
#include "grid/cells.h"
#include "grid/grid_spec.h"

namespace clusterbench::grid {

// Cells are numbered from the top left near corner.
struct ScreenGrid {
  bool by_distance = false;  // slices are shells of distance; else of depth
  Tiles tiles;
  Slices slices;

  Kind kind() const { return by_distance ? Kind::distance : Kind::frustum; }
  // The coordinate along which slices are cut: the depth of a point in view space, or its distance.
  template <class Point>
  auto along(const Point& p) const {
    return by_distance ? std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z) : -p.z;
  }

  Vec3i counts() const { return {tiles.count.x, tiles.count.y, slices.count()}; }
  geom::Cell cell(Vec3i at) const;
  std::int64_t lookup(const Sample& sample, Log2 way) const;
  std::unique_ptr<BroadPhase> broad_phase() const;  // screen_broad_phase.cpp
};

// Inline, since methods and truth call it for every cell.
inline geom::Cell ScreenGrid::cell(Vec3i at) const {
  const auto x = static_cast<std::size_t>(at.x), z = static_cast<std::size_t>(at.z);
  const float x0 = tiles.x[x], x1 = tiles.x[x + 1], y0 = tiles.y_min(at.y), y1 = tiles.y_max(at.y);
  const float near = slices.boundaries[z], far = slices.boundaries[z + 1];
  if (by_distance) return geom::ShellCell{x0, x1, y0, y1, near, far};
  return geom::FrustumCell{x0, x1, y0, y1, near, far, tiles.orthographic};
}

// Throws Error (where = configuration key) for a grid that is impossible in this projection.
ScreenGrid make_screen_grid(const GridSpec& spec, const GridInputs& inputs);
GridInputs screen_inputs(const GridSpec& spec, const FrameReach& from);

}  // namespace clusterbench::grid
