#include "grid/grid.h"

#include <charconv>
#include <cstdio>
#include <span>

#include "core/error.h"
#include "core/memory.h"
#include "geom/single_precision/bounding_volumes.h"

namespace clusterbench::grid {
namespace {

// A kind of grid as data.
struct KindRow {
  const char* name;
  std::span<const char* const> keys;  // of a request, in the order in which they are written
  Grid (*make)(const GridSpec& spec, const GridInputs& inputs);
  GridInputs (*inputs)(const GridSpec& spec, const FrameReach& from);
};

template <auto make>
Grid made(const GridSpec& spec, const GridInputs& inputs) {
  return {make(spec, inputs)};
}

constexpr const char* k_screen_keys[] = {"tiles", "slices", "react"};
constexpr const char* k_cascades_keys[] = {"cells", "levels", "finest"};
constexpr const char* k_world_keys[] = {"cells", "bounds", "follow", "cell_size"};

// In the order of Kind.
constexpr KindRow k_kinds[k_kind_count] = {
    {"frustum", k_screen_keys, made<make_screen_grid>, screen_inputs},
    {"distance", k_screen_keys, made<make_screen_grid>, screen_inputs},
    {"cascades", k_cascades_keys, made<make_cascades_grid>, cascades_inputs},
    {"world", k_world_keys, made<make_world_grid>, world_inputs},
};

const KindRow& row_of(Kind kind) {
  return k_kinds[static_cast<std::size_t>(kind)];
}

void check_cell_count(const Grid& grid) {
  const Vec3i cells = grid.cells();
  if (static_cast<double>(cells.x) * cells.y * cells.z > 1e9)
    throw Error("", "cells", "are more than 10^9: " + cells_name(cells));
}

}  // namespace

const char* kind_name(Kind kind) {
  return row_of(kind).name;
}

std::span<const char* const> kind_keys(Kind kind) {
  return row_of(kind).keys;
}

const char* name_of(Follow follow) {
  constexpr const char* k_names[] = {"", "camera", "lights"};
  return k_names[static_cast<int>(follow)];
}

GridSpec GridSpec::unfitted() const {
  GridSpec out = *this;
  out.slices.fit.reset();
  return out;
}

GridSpec GridSpec::unreacting() const {
  GridSpec out = *this;
  out.reaction.reset();
  return out;
}

std::string number_name(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g m", value);
  return text;
}

std::string cells_name(Vec3i cells) {
  return std::to_string(cells.x) + "x" + std::to_string(cells.y) + "x" + std::to_string(cells.z);
}

Kind Grid::kind() const {
  return std::visit([](const auto& grid) { return grid.kind(); }, shape);
}

Vec3i Grid::cells() const {
  return std::visit([](const auto& grid) { return grid.counts(); }, shape);
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
  check_memory("spheres around cells", cell_count(), sizeof(geom::Ball));
  balls.reserve(cell_count());
  for (std::uint32_t index = 0; index < cell_count(); ++index)
    balls.push_back(is_hole(index) ? geom::Ball{} : geom::ball_around(cell(index)));
  return balls;
}

bool Grid::is_hole(std::uint32_t index) const {
  const auto* nested = std::get_if<CascadesGrid>(&shape);
  return nested != nullptr && nested->is_hole(cell_at(index));
}

geom::Cell Grid::cell(std::uint32_t index) const {
  const Vec3i at = cell_at(index);
  return std::visit([&](const auto& grid) { return grid.cell(at); }, shape);
}

std::unique_ptr<BroadPhase> Grid::broad_phase() const {
  return std::visit([](const auto& grid) { return grid.broad_phase(); }, shape);
}

std::optional<Vec3d> Grid::world_origin() const {
  const auto* in_world = std::get_if<WorldGrid>(&shape);
  return in_world == nullptr ? std::nullopt : std::optional(in_world->origin);
}

view::Space space_of(const Grid& grid, const view::Frame& frame) {
  if (const std::optional<Vec3d> origin = grid.world_origin()) return {*origin, Mat3d{1.0}};
  return frame.view_space;
}

std::int64_t lookup(const Grid& grid, const Sample& sample, Log2 way) {
  return std::visit([&](const auto& shape) { return shape.lookup(sample, way); }, grid.shape);
}

Grid make_grid(const GridSpec& spec, const GridInputs& inputs) {
  Grid grid = row_of(spec.kind).make(spec, inputs);
  check_cell_count(grid);
  return grid;
}

GridInputs grid_inputs(const GridSpec& spec, const view::Frame& frame, double path_far_m, Vec3d rig_lo_m,
                       Vec3d rig_hi_m, const depth::DepthImage* depths) {
  return row_of(spec.kind).inputs(spec, {frame, path_far_m, rig_lo_m, rig_hi_m, depths});
}

}  // namespace clusterbench::grid
