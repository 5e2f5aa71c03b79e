#pragma once
// A grid: a partition of space into cells, with two faces: the exact cell and the single-precision lookup of a shader.
// Cells are numbered x fastest, then y, then z, so that a row is contiguous.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "geom/shapes.h"
#include "grid/slicing.h"
#include "grid/tiling.h"
#include "view/frame.h"

namespace clusterbench::grid {

// The index of a cell among so many along each axis. At most 10^9 there are.
inline std::uint32_t cell_index(Vec3i cell, Vec3i cells) {
  return static_cast<std::uint32_t>((cell.z * cells.y + cell.y) * cells.x + cell.x);
}

enum class Kind : std::uint8_t { frustum, distance, cascades, world };
inline constexpr int k_kind_count = 4;
const char* kind_name(Kind kind);

// Tiles x depth slices; or tiles x distance shells around the eye. Cells are numbered from the top left near corner.
struct ScreenGrid {
  Kind kind = Kind::frustum;  // frustum or distance
  Tiles tiles;
  Slices slices;  // of depth (frustum) or distance
};

// Nested view-space boxes of cubical cells. Level l has cells of edge finest * 2^l and spans, in units of its edge,
// x, y in [-cells/2, cells/2] and depth in [0, cells.z]. Cells of a level that lie in the finer level's box are holes:
// they have an index and no space. cells.x, cells.y are multiples of 4, cells.z of 2, so a cell is wholly inside or
// outside. z index 0 is nearest the eye; y index 0 is the top.
struct CascadesGrid {
  int levels = 1;
  Vec3i cells{16, 16, 16};  // of each level; grid z runs over level * cells.z + z
  float finest_m = 0.5f;

  float edge_m(int level) const;
  bool is_hole(int level, Vec3i cell) const;
};

// A fixed box grid in world space. Boundaries are relative to `origin`, single precision, ascending. Index (x, y, z)
// runs along the world axes.
struct WorldGrid {
  Vec3d origin{0.0};
  std::vector<float> x, y, z;
};

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

  const ScreenGrid& screen() const { return std::get<ScreenGrid>(shape); }
  const CascadesGrid& cascades() const { return std::get<CascadesGrid>(shape); }
  const WorldGrid& world() const { return std::get<WorldGrid>(shape); }
};

// The space in which the grid's cells are given.
view::Space space_of(const Grid& grid, const view::Frame& frame);

// A point where shading happens.
struct Sample {
  float pixel_x, pixel_y;  // from the top left
  Vec3f view;              // view space, single precision
  // The exact position, along the world's axes: from the eye, as far from the origin a double holds metres only.
  Vec3d from_eye, eye;

  Vec3d from(const Vec3d& origin) const { return from_eye + (eye - origin); }
};

// The lookup that a shader would do, in single precision. -1: outside the grid.
std::int64_t lookup(const Grid& grid, const Sample& sample, Log2 way = Log2::rounded);

// What a configuration asks for; one kind of these is filled.
struct GridSpec {
  Kind kind = Kind::frustum;
  Tiling tiles;             // frustum, distance
  Slicing slices;           // frustum, distance
  Vec3i cells{64, 16, 64};  // world, cascades
  int levels = 5;           // cascades
  double finest_m = 0.5;    // cascades
  bool has_bounds = false;  // world; without: the box around all lights' balls over the path
  Vec3d bounds_lo_m{0.0}, bounds_hi_m{0.0};

  // "frustum 64px x 16 exponential-first 0.1..5..500": unique among specs that differ, used in case names.
  std::string name() const;
};

// What a grid is made from besides its spec. A grid is rebuilt only when these change; `fit` slices and an unnamed far
// depend on the lights in view.
struct GridInputs {
  view::Projection projection;
  Vec2i viewport{0, 0};
  double light_near_m = 0.0, light_far_m = 0.0;  // reach of the lights in view of this frame, as depth (or distance)
  Vec3d rig_lo_m{0.0}, rig_hi_m{0.0};            // box around the bounded lights over the whole path

  friend bool operator==(const GridInputs&, const GridInputs&) = default;
};

// Throws Error (file "", where = configuration key) for a spec that cannot be in this projection.
Grid make_grid(const GridSpec& spec, const GridInputs& inputs);

// The inputs of one frame. Fields that the spec does not use are left at zero, so that equal inputs mean an equal grid.
// path_far_m: the farthest light reach over the whole path (used for a far that nobody gives).
GridInputs grid_inputs(const GridSpec& spec, const view::Frame& frame, double path_far_m, Vec3d rig_lo_m,
                       Vec3d rig_hi_m);

}  // namespace clusterbench::grid
