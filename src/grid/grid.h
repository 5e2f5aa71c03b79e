#pragma once
// A grid: a partition of space into cells, with two interfaces: the exact cell, and the single-precision lookup of a
// shader. A kind of grid is one file (screen_grid.h, cascades_grid.h, world_grid.h) and one row of k_kinds in grid.cpp.

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "grid/cascades_grid.h"
#include "grid/screen_grid.h"
#include "grid/world_grid.h"

namespace clusterbench::grid {

struct Grid {
  std::variant<ScreenGrid, CascadesGrid, WorldGrid> shape;

  Kind kind() const;
  Vec3i cells() const;  // cascades: z counts all levels
  std::uint32_t cell_count() const;
  Vec3i cell_at(std::uint32_t index) const;
  bool is_hole(std::uint32_t index) const;

  // The exact cell, in the grid's space (view space, or world relative to the origin). Not for holes.
  geom::Cell cell(std::uint32_t index) const;
  // Balls around all cells, in the order of their indices; empty for a hole.
  std::vector<geom::Ball> balls_around_cells() const;
  // Finds the cells that a ball may touch.
  std::unique_ptr<BroadPhase> broad_phase() const;
  // For a grid that is fixed in the world; otherwise its cells are in view space.
  std::optional<Vec3d> world_origin() const;

  bool has_tiles() const { return std::holds_alternative<ScreenGrid>(shape); }
  const ScreenGrid& screen() const { return std::get<ScreenGrid>(shape); }
  const CascadesGrid& cascades() const { return std::get<CascadesGrid>(shape); }
  const WorldGrid& world() const { return std::get<WorldGrid>(shape); }
};

// The space of the grid's cells.
view::Space space_of(const Grid& grid, const view::Frame& frame);

// The lookup of a shader, in single precision. -1: outside the grid.
std::int64_t lookup(const Grid& grid, const Sample& sample, Log2 way = Log2::rounded);

// Throws Error (file "", where = configuration key) for a spec that is impossible in this projection.
Grid make_grid(const GridSpec& spec, const GridInputs& inputs);

// The inputs of a single frame. Fields that the spec does not use are zero, so that equal inputs mean an equal grid.
// The needed span (of slices with `fit`) is limited to the requested range and does not depend on earlier frames. Tiles
// that react to entries are the requested ones.
GridInputs grid_inputs(const GridSpec& spec, const view::Frame& frame, double path_far_m, Vec3d rig_lo_m,
                       Vec3d rig_hi_m, const depth::DepthImage* depths = nullptr);

}  // namespace clusterbench::grid
