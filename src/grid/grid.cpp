#include "grid/grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/memory.h"
#include "geom/domain.h"
#include "geom/predicates.h"

namespace clusterbench::grid {
namespace {

template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

geom::Cell screen_cell(const ScreenGrid& grid, Vec3i cell) {
  const Tiles& tiles = grid.tiles;
  const float x0 = tiles.x[at(cell.x)], x1 = tiles.x[at(cell.x) + 1];
  const float y0 = tiles.y_min(cell.y), y1 = tiles.y_max(cell.y);
  const float near = grid.slices.boundaries[at(cell.z)], far = grid.slices.boundaries[at(cell.z) + 1];
  if (grid.kind == Kind::distance) return geom::ShellPiece{x0, x1, y0, y1, near, far};
  return geom::FrustumPiece{x0, x1, y0, y1, near, far, tiles.orthographic};
}

geom::Cell cascade_cell(const CascadesGrid& grid, Vec3i cell) {
  const int level = cell.z / grid.cells.z;
  const float edge = grid.edge_m(level);
  // Whole multiples of a power of two times `finest`: the same real boundary rounds to the same float on every level.
  const auto times = [edge](int n) { return static_cast<float>(n) * edge; };
  const int left = cell.x - grid.cells.x / 2;
  const int top = grid.cells.y / 2 - cell.y;
  const int depth = cell.z % grid.cells.z;
  return geom::Box{{times(left), times(top - 1), -times(depth + 1)}, {times(left + 1), times(top), -times(depth)}};
}

geom::Cell world_cell(const WorldGrid& grid, Vec3i cell) {
  return geom::Box{{grid.x[at(cell.x)], grid.y[at(cell.y)], grid.z[at(cell.z)]},
                   {grid.x[at(cell.x) + 1], grid.y[at(cell.y) + 1], grid.z[at(cell.z) + 1]}};
}

std::int64_t lookup_screen(const ScreenGrid& grid, Vec3i cells, const Sample& sample, Log2 way) {
  const Vec3f& p = sample.view;
  const float along = grid.kind == Kind::distance ? std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z) : -p.z;
  const int slice = grid.slices.slice_of(along, way);
  if (slice < 0) return -1;
  const Vec2i tile = grid.tiles.tile_of(sample.pixel_x, sample.pixel_y);
  return cell_index({tile.x, tile.y, slice}, cells);
}

bool lies_within(const Vec3f& point, const Vec3i& cells) {
  const Vec3f end(cells);
  return point.x >= 0.0f && point.y >= 0.0f && point.z >= 0.0f && point.x < end.x && point.y < end.y && point.z < end.z;
}

std::int64_t lookup_cascades(const CascadesGrid& grid, Vec3i cells, const Sample& sample) {
  for (int level = 0; level < grid.levels; ++level) {
    const float edge = grid.edge_m(level);
    const float half_x = 0.5f * static_cast<float>(grid.cells.x), half_y = 0.5f * static_cast<float>(grid.cells.y);
    const Vec3f in_cells{sample.view.x / edge + half_x, half_y - sample.view.y / edge, -sample.view.z / edge};
    if (!lies_within(in_cells, grid.cells)) continue;
    const Vec3i cell(in_cells);
    // A point that rounds out of a level rounds out of the hole that this level fills: both divide by powers of two
    // apart.
    if (!grid.is_hole(level, cell)) return cell_index({cell.x, cell.y, level * grid.cells.z + cell.z}, cells);
  }
  return -1;
}

std::int64_t lookup_world(const WorldGrid& grid, Vec3i cells, const Sample& sample) {
  Vec3i cell{0};
  const std::vector<float>* axes[3] = {&grid.x, &grid.y, &grid.z};
  const Vec3f point_in_grid(sample.from(grid.origin));
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<float>& bounds = *axes[axis];
    const float local = point_in_grid[axis];
    const float scale = static_cast<float>(cells[axis]) / (bounds.back() - bounds.front());
    const float index = std::floor((local - bounds.front()) * scale);
    if (!(local >= bounds.front() && local <= bounds.back())) return -1;
    cell[axis] = std::clamp(static_cast<int>(index), 0, cells[axis] - 1);
  }
  return cell_index(cell, cells);
}

SliceRange slice_range(const GridInputs& inputs) {
  return {inputs.projection.near_m, inputs.projection.far_m, inputs.light_near_m, inputs.light_far_m};
}

// The farthest corners of a perspective grid are as far to the side as their slopes say.
void check_extent(const ScreenGrid& grid) {
  const Tiles& tiles = grid.tiles;
  if (tiles.orthographic) return;
  const float steepest = std::max(
      {std::fabs(tiles.x.front()), std::fabs(tiles.x.back()), std::fabs(tiles.y.front()), std::fabs(tiles.y.back())});
  if (!geom::is_in_domain(static_cast<double>(steepest) * static_cast<double>(grid.slices.boundaries.back())))
    throw Error("", "slices.far", "is too far for so wide a view: the picture's corners there are beyond 1e15 m");
}

Grid make_screen(const GridSpec& spec, const GridInputs& inputs) {
  if (spec.kind == Kind::distance && inputs.projection.orthographic)
    throw Error("", "kind", "distance grids have their shells around the eye; an orthographic camera has none");
  ScreenGrid grid;
  grid.kind = spec.kind;
  grid.tiles = make_tiles(spec.tiles, inputs.projection, inputs.viewport);
  grid.slices = make_slices(spec.slices, slice_range(inputs), inputs.projection.orthographic);
  check_extent(grid);
  return {grid};
}

Grid make_cascades(const GridSpec& spec) {
  const Vec3i& n = spec.cells;
  if (n.x < 4 || n.y < 4 || n.z < 2 || n.x % 4 != 0 || n.y % 4 != 0 || n.z % 2 != 0)
    throw Error("", "cells",
                "of cascades must be multiples of 4, 4 and 2, so that a level's cells are wholly inside or outside of "
                "the finer level");
  if (spec.levels < 1 || spec.levels > 24) throw Error("", "levels", "must be 1 to 24");
  const auto finest_m = static_cast<float>(spec.finest_m);
  const double coarsest_m = std::ldexp(static_cast<double>(finest_m), spec.levels - 1);
  if (!(static_cast<double>(finest_m) >= geom::k_nearest_m) ||
      !geom::is_in_domain(coarsest_m * std::max({n.x, n.y, n.z})))
    throw Error("", "finest", "must be at least 1e-15 m, and small enough for the coarsest level to end within 1e15 m");
  return {CascadesGrid{spec.levels, n, finest_m}};
}

// Boundaries relative to the box's middle, where single precision is finest; the outermost enclose the box.
std::vector<float> world_planes(double lo, double hi, double origin, int count) {
  constexpr float k_infinity = std::numeric_limits<float>::infinity();
  std::vector<float> planes;
  for (int i = 0; i <= count; ++i) planes.push_back(static_cast<float>(lo - origin + (hi - lo) * i / count));
  planes.front() = std::nextafter(planes.front(), -k_infinity);
  planes.back() = std::nextafter(planes.back(), k_infinity);
  if (!std::isfinite(planes.front()) || !std::isfinite(planes.back()))
    throw Error("", "bounds", "must be finite in single precision");
  for (int i = 0; i < count; ++i)
    if (!(planes[at(i)] < planes[at(i) + 1]))
      throw Error("", "cells", "are too thin: two boundaries coincide in single precision");
  return planes;
}

Grid make_world(const GridSpec& spec, const GridInputs& inputs) {
  Vec3d lo = spec.has_bounds ? spec.bounds_lo_m : inputs.rig_lo_m;
  Vec3d hi = spec.has_bounds ? spec.bounds_hi_m : inputs.rig_hi_m;
  WorldGrid grid;
  std::vector<float>* axes[3] = {&grid.x, &grid.y, &grid.z};
  for (int axis = 0; axis < 3; ++axis) {
    if (spec.cells[axis] < 1) throw Error("", "cells", "must be at least 1 along each axis");
    if (spec.has_bounds && !(lo[axis] < hi[axis]))
      throw Error("", "bounds", "must have its minimum below its maximum on each axis");
    if (spec.has_bounds && !(geom::is_in_domain(lo[axis]) && geom::is_in_domain(hi[axis])))
      throw Error("", "bounds", "must be within 1e15 m from the origin");
    if (!(lo[axis] < hi[axis])) {  // a rig without extent
      lo[axis] -= 0.5;
      hi[axis] += 0.5;
    }
    grid.origin[axis] = std::round((lo[axis] + hi[axis]) / 2.0);
    *axes[axis] = world_planes(lo[axis], hi[axis], grid.origin[axis], spec.cells[axis]);
  }
  return {grid};
}

void check_cell_count(const Grid& grid) {
  const Vec3i cells = grid.cells();
  if (static_cast<double>(cells.x) * cells.y * cells.z > 1e9) throw Error("", "cells", "are more than 10^9");
}

// What the lights in view reach, as depth for frustum grids or as distance.
struct LightReach {
  double near = std::numeric_limits<double>::infinity(), far = 0.0;
};

// Does a ball reach into the half-spaces of the camera's near and far planes and of the picture's sides? A ball outside
// of an edge or a corner of the view may seem to.
bool may_be_in_view(const view::Projection& projection, const Vec3d& center, double radius) {
  const double depth = -center.z;
  if (depth + radius < projection.near_m || depth - radius > projection.far_m) return false;
  const auto beyond = [&](double coordinate, double side) {
    if (projection.orthographic) return coordinate - side;
    return (coordinate - side * depth) / std::sqrt(1.0 + side * side);
  };
  return -beyond(center.x, projection.left) <= radius && beyond(center.x, projection.right) <= radius &&
         -beyond(center.y, projection.bottom) <= radius && beyond(center.y, projection.top) <= radius;
}

LightReach reach_in_view(const view::Frame& frame, Kind kind) {
  LightReach reach;
  for (const scene::WorldLight& light : frame.lights) {
    if (light.range_m == 0.0 || !std::isfinite(light.range_m)) continue;
    const Vec3d c = frame.view_space.rotation * (light.position - frame.view_space.origin);
    const double along = kind == Kind::distance ? std::sqrt(c.x * c.x + c.y * c.y + c.z * c.z) : -c.z;
    if (!may_be_in_view(frame.projection, c, light.range_m)) continue;
    reach.near = std::min(reach.near, along - light.range_m);
    reach.far = std::max(reach.far, along + light.range_m);
  }
  return reach;
}

}  // namespace

const char* kind_name(Kind kind) {
  constexpr const char* k_names[k_kind_count] = {"frustum", "distance", "cascades", "world"};
  return k_names[static_cast<int>(kind)];
}

float CascadesGrid::edge_m(int level) const {
  return std::ldexp(finest_m, level);
}

bool CascadesGrid::is_hole(int level, Vec3i cell) const {
  return level > 0 && cell.x >= cells.x / 4 && cell.x < 3 * cells.x / 4 && cell.y >= cells.y / 4 &&
         cell.y < 3 * cells.y / 4 && cell.z < cells.z / 2;
}

Kind Grid::kind() const {
  return std::visit(
      Overloaded{[](const ScreenGrid& g) { return g.kind; }, [](const CascadesGrid&) { return Kind::cascades; },
                 [](const WorldGrid&) { return Kind::world; }},
      shape);
}

Vec3i Grid::cells() const {
  const auto planes = [](const std::vector<float>& bounds) { return static_cast<int>(bounds.size()) - 1; };
  return std::visit(Overloaded{[](const ScreenGrid& g) {
                                 return Vec3i{g.tiles.count.x, g.tiles.count.y, g.slices.count()};
                               },
                               [](const CascadesGrid& g) {
                                 return Vec3i{g.cells.x, g.cells.y, g.cells.z * g.levels};
                               },
                               [&](const WorldGrid& g) {
                                 return Vec3i{planes(g.x), planes(g.y), planes(g.z)};
                               }},
                    shape);
}

std::uint32_t Grid::cell_count() const {
  const Vec3i n = cells();
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(n.x) * n.y * n.z);
}

Vec3i Grid::cell_at(std::uint32_t index) const {
  const Vec3i n = cells();
  const auto nx = static_cast<std::uint32_t>(n.x), ny = static_cast<std::uint32_t>(n.y);
  return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny), static_cast<int>(index / nx / ny)};
}

std::vector<geom::Ball> Grid::balls_around_cells() const {
  std::vector<geom::Ball> balls;
  check_memory("balls around cells", cell_count(), sizeof(geom::Ball));
  balls.reserve(cell_count());
  for (std::uint32_t index = 0; index < cell_count(); ++index)
    balls.push_back(is_hole(index) ? geom::Ball{} : geom::ball_around(cell(index)));
  return balls;
}

bool Grid::is_hole(std::uint32_t index) const {
  const auto* nested = std::get_if<CascadesGrid>(&shape);
  if (nested == nullptr) return false;
  const Vec3i cell = cell_at(index);
  return nested->is_hole(cell.z / nested->cells.z, {cell.x, cell.y, cell.z % nested->cells.z});
}

geom::Cell Grid::cell(std::uint32_t index) const {
  const Vec3i at = cell_at(index);
  return std::visit(Overloaded{[&](const ScreenGrid& g) { return screen_cell(g, at); },
                               [&](const CascadesGrid& g) { return cascade_cell(g, at); },
                               [&](const WorldGrid& g) { return world_cell(g, at); }},
                    shape);
}

view::Space space_of(const Grid& grid, const view::Frame& frame) {
  if (grid.kind() == Kind::world) return {grid.world().origin, Mat3d{1.0}};
  return frame.view_space;
}

std::int64_t lookup(const Grid& grid, const Sample& sample, Log2 way) {
  const Vec3i cells = grid.cells();
  return std::visit(Overloaded{[&](const ScreenGrid& g) { return lookup_screen(g, cells, sample, way); },
                               [&](const CascadesGrid& g) { return lookup_cascades(g, cells, sample); },
                               [&](const WorldGrid& g) { return lookup_world(g, cells, sample); }},
                    grid.shape);
}

Grid make_grid(const GridSpec& spec, const GridInputs& inputs) {
  Grid grid;
  switch (spec.kind) {
    case Kind::frustum:
    case Kind::distance:
      grid = make_screen(spec, inputs);
      break;
    case Kind::cascades:
      grid = make_cascades(spec);
      break;
    case Kind::world:
      grid = make_world(spec, inputs);
      break;
  }
  check_cell_count(grid);
  return grid;
}

GridInputs grid_inputs(const GridSpec& spec, const view::Frame& frame, double path_far_m, Vec3d rig_lo_m,
                       Vec3d rig_hi_m) {
  GridInputs inputs;
  if (spec.kind == Kind::world) {
    if (!spec.has_bounds) {
      inputs.rig_lo_m = rig_lo_m;
      inputs.rig_hi_m = rig_hi_m;
    }
    return inputs;
  }
  if (spec.kind == Kind::cascades) return inputs;
  inputs.projection = frame.projection;
  inputs.viewport = frame.viewport;
  inputs.light_far_m = path_far_m;
  if (spec.slices.scheme == Scheme::fit) {
    const LightReach reach = reach_in_view(frame, spec.kind);
    inputs.light_near_m = reach.near;
    inputs.light_far_m = reach.far;
  }
  return inputs;
}

}  // namespace clusterbench::grid
