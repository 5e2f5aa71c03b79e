#include "grid/cascades_grid.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "geom/shapes/domain.h"

namespace clusterbench::grid {
namespace {

bool lies_within(const Vec3f& point, const Vec3i& cells) {
  const Vec3f end(cells);
  return point.x >= 0.0f && point.y >= 0.0f && point.z >= 0.0f && point.x < end.x && point.y < end.y && point.z < end.z;
}

// The cells of a level. Holes have no cell, so extents come from the outermost column and row, which are never part of
// a hole.
BoxBlock block_of_level(const CascadesGrid& grid, int level) {
  const Vec3i cells = grid.cells;
  const auto box_at = [&](int x, int y, int z) { return std::get<geom::Box>(grid.cell({x, y, level * cells.z + z})); };
  BoxBlock block;
  for (int x = 0; x < cells.x; ++x) block.x.push_back({box_at(x, 0, 0).lo.x, box_at(x, 0, 0).hi.x});
  for (int y = 0; y < cells.y; ++y) block.y.push_back({box_at(0, y, 0).lo.y, box_at(0, y, 0).hi.y});
  for (int z = 0; z < cells.z; ++z) block.z.push_back({box_at(0, 0, z).lo.z, box_at(0, 0, z).hi.z});
  block.first_cell = cell_index({0, 0, level * cells.z}, cells);
  const auto hole = [&](int count, const auto& is_hole) {
    IndexRange range{count, -1};
    for (int i = 0; i < count; ++i)
      if (is_hole(i)) range = {std::min(range.first, i), i};
    return range;
  };
  const Vec3i middle{cells.x / 2, cells.y / 2, 0};
  block.hole_x = hole(cells.x, [&](int x) { return grid.is_hole(level, {x, middle.y, middle.z}); });
  block.hole_y = hole(cells.y, [&](int y) { return grid.is_hole(level, {middle.x, y, middle.z}); });
  block.hole_z = hole(cells.z, [&](int z) { return grid.is_hole(level, {middle.x, middle.y, z}); });
  return block;
}

}  // namespace

bool CascadesGrid::is_hole(int level, Vec3i cell) const {
  return level > 0 && cell.x >= cells.x / 4 && cell.x < 3 * cells.x / 4 && cell.y >= cells.y / 4 &&
         cell.y < 3 * cells.y / 4 && cell.z < cells.z / 2;
}

std::int64_t CascadesGrid::lookup(const Sample& sample, Log2) const {
  for (int level = 0; level < levels; ++level) {
    const float edge = edge_m(level);
    const float half_x = 0.5f * static_cast<float>(cells.x), half_y = 0.5f * static_cast<float>(cells.y);
    const Vec3f in_cells{sample.view.x / edge + half_x, half_y - sample.view.y / edge, -sample.view.z / edge};
    if (!lies_within(in_cells, cells)) continue;
    const Vec3i at(in_cells);
    // A point that rounds out of a level also rounds out of the hole in the next level: both divide by powers of two.
    if (!is_hole(level, at)) return cell_index({at.x, at.y, level * cells.z + at.z}, counts());
  }
  return -1;
}

std::unique_ptr<BroadPhase> CascadesGrid::broad_phase() const {
  std::vector<BoxBlock> blocks;
  for (int level = 0; level < levels; ++level) blocks.push_back(block_of_level(*this, level));
  return std::make_unique<BoxBroadPhase>(std::move(blocks));
}

CascadesGrid make_cascades_grid(const GridSpec& spec, const GridInputs&) {
  const Vec3i& n = spec.cells;
  if (n.x < 4 || n.y < 4 || n.z < 2 || n.x % 4 != 0 || n.y % 4 != 0 || n.z % 2 != 0)
    throw Error("", "cells",
                "of cascades are " + cells_name(n) +
                    "; allowed: multiples of 4, 4 and 2, so that a level's cells are wholly inside or outside of the "
                    "finer level");
  if (spec.levels < 1 || spec.levels > 24)
    throw Error("", "levels", "are " + std::to_string(spec.levels) + "; allowed: 1 to 24");
  const auto finest_m = static_cast<float>(spec.finest_m);
  const double coarsest_m = std::ldexp(static_cast<double>(finest_m), spec.levels - 1);
  if (!(static_cast<double>(finest_m) >= geom::k_nearest_m) ||
      !geom::is_in_domain(coarsest_m * std::max({n.x, n.y, n.z})))
    throw Error("", "finest",
                "is " + metres(spec.finest_m) + "; allowed: at least 1e-15 m, and so small that the coarsest of " +
                    std::to_string(spec.levels) + " levels, with " + cells_name(n) + " cells, ends within 1e15 m");
  return {spec.levels, n, finest_m};
}

GridInputs cascades_inputs(const GridSpec&, const FrameReach&) {
  return {};
}

}  // namespace clusterbench::grid
