#pragma once
// A grid: a partition of space into cells, with two faces: the exact cell and the single-precision lookup of a shader.
// A kind of grid is one file (screen_grid.h, cascades_grid.h, world_grid.h) and one row of k_kinds in grid.cpp.

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
  // Balls around all cells, in the order of their indices; of a hole the empty one.
  std::vector<geom::Ball> balls_around_cells() const;
  // Which cells a ball may touch.
  std::unique_ptr<BroadPhase> broad_phase() const;
  // Of a grid that stays in the world; else its cells are given in view space.
  std::optional<Vec3d> world_origin() const;

  bool has_tiles() const { return std::holds_alternative<ScreenGrid>(shape); }
  const ScreenGrid& screen() const { return std::get<ScreenGrid>(shape); }
  const CascadesGrid& cascades() const { return std::get<CascadesGrid>(shape); }
  const WorldGrid& world() const { return std::get<WorldGrid>(shape); }
};

// The space in which the grid's cells are given.
view::Space space_of(const Grid& grid, const view::Frame& frame);

// The lookup that a shader would do, in single precision. -1: outside the grid.
std::int64_t lookup(const Grid& grid, const Sample& sample, Log2 way = Log2::rounded);

// Throws Error (file "", where = configuration key) for a spec that cannot be in this projection.
Grid make_grid(const GridSpec& spec, const GridInputs& inputs);

// The inputs of one frame by itself. Fields that the spec does not use are left at zero, so that equal inputs mean an
// equal grid. What is needed (of slices with `fit`) is within what is asked for, and does not follow from frames
// before; nor do tiles that react to entries, which are those asked for.
GridInputs grid_inputs(const GridSpec& spec, const view::Frame& frame, double path_far_m, Vec3d rig_lo_m,
                       Vec3d rig_hi_m, const depth::DepthImage* depths = nullptr);

}  // namespace clusterbench::grid
