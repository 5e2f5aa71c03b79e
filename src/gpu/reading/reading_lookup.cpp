#include "gpu/reading/reading_lookup.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clusterbench::gpu {
namespace {

using assign::LookedUp;

constexpr double k_ulp = 0x1p-23;  // of a number, at most

void set_screen(const grid::ScreenGrid& grid, ReadingMode& mode, ReadingArguments& arguments) {
  const grid::Tiles& tiles = grid.tiles;
  const grid::SliceLookup& lookup = grid.slices.lookup;
  mode.is_by_distance = grid.by_distance;
  mode.is_orthographic = tiles.orthographic;
  mode.slice_form = static_cast<std::uint32_t>(lookup.form);
  arguments.viewport_x = static_cast<float>(tiles.viewport.x);
  arguments.viewport_y = static_cast<float>(tiles.viewport.y);
  arguments.tile_scale_x = tiles.scale_x;
  arguments.tile_scale_y = tiles.scale_y;
  arguments.slice_far = grid.slices.boundaries.back();
  arguments.slice_scale = lookup.scale;
  arguments.slice_bias = lookup.bias;
  arguments.slice_first = lookup.first_slice > 0 ? lookup.first_m : std::numeric_limits<float>::lowest();
}

void set_world(const grid::WorldGrid& grid, ReadingArguments& arguments) {
  const std::vector<float>* axes[] = {&grid.x, &grid.y, &grid.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<float>& bounds = *axes[axis];
    arguments.box_min[axis] = bounds.front();
    arguments.box_max[axis] = bounds.back();
    arguments.box_scale[axis] = static_cast<float>(bounds.size() - 1) / (bounds.back() - bounds.front());
  }
}

// A number with the largest error that a device may make.
struct Off {
  double value, error;

  // Of the cells 0, 1, ..., may it be in this one, if those beyond the ends are in the first and the last?
  bool may_be_in(int cell, int cells) const {
    return (cell == 0 || value + error >= cell) && (cell == cells - 1 || value - error < cell + 1);
  }
  bool may_be_within(int cells) const { return value + error >= 0.0 && value - error < cells; }
  bool is_within(int cells) const { return value - error >= 0.0 && value + error < cells; }
};

// --- Screens ---

bool may_be_tile(const grid::Tiles& tiles, const grid::Sample& sample, Vec2i tile, bool rounds_to_nearest) {
  const auto scaled = [rounds_to_nearest](float pixel, float scale) {
    const float value = pixel * scale;
    return Off{static_cast<double>(value), rounds_to_nearest ? 0.0 : k_ulp * static_cast<double>(value)};
  };
  return scaled(sample.pixel_x, tiles.scale_x).may_be_in(tile.x, tiles.count.x) &&
         scaled(sample.pixel_y, tiles.scale_y).may_be_in(tile.y, tiles.count.y);
}

bool may_be_slice(const grid::Slices& slices, float from, float to, int slice, bool rounds_to_nearest) {
  const grid::SliceLookup& lookup = slices.lookup;
  if (rounds_to_nearest || lookup.form == grid::SliceLookup::Form::search) {
    const float last = std::min(to, slices.boundaries.back());
    return slice >= slices.slice_of(from, grid::Log2::glsl_low) &&
           slice <= slices.slice_of(last, grid::Log2::glsl_high);
  }
  if (lookup.first_slice > 0 && from < lookup.first_m && slice == 0) return true;
  const auto slice_at = [&lookup](float along, grid::Log2 way, double direction) {
    const double depth = lookup.form == grid::SliceLookup::Form::log2 ? grid::log2_by(way, along) : along;
    const double scaled = depth * static_cast<double>(lookup.scale), value = scaled + static_cast<double>(lookup.bias);
    return value + direction * 2.0 * k_ulp * (std::abs(scaled) + std::abs(value));
  };
  const double low = slice_at(from, grid::Log2::glsl_low, -1.0), high = slice_at(to, grid::Log2::glsl_high, 1.0);
  return Off{(low + high) / 2.0, (high - low) / 2.0}.may_be_in(slice, slices.count());
}

bool may_find_on_screen(const grid::ScreenGrid& grid, const grid::Sample& sample, std::int64_t cell,
                        bool rounds_to_nearest) {
  if (!grid.tiles.shows(sample.pixel_x, sample.pixel_y)) return cell < 0;
  const float along = grid.along(sample.view);
  const double error = grid.by_distance ? k_ulp * (4.5 + (rounds_to_nearest ? 0.0 : 5.0)) : 0.0;
  const auto from = static_cast<float>(static_cast<double>(along) * (1.0 - error));
  const auto to = static_cast<float>(static_cast<double>(along) * (1.0 + error));
  if (cell < 0) return to > grid.slices.boundaries.back();
  if (from > grid.slices.boundaries.back()) return false;
  const std::int64_t columns = grid.tiles.count.x, tiles = columns * grid.tiles.count.y;
  const Vec2i tile{static_cast<int>(cell % columns), static_cast<int>(cell % tiles / columns)};
  return may_be_tile(grid.tiles, sample, tile, rounds_to_nearest) &&
         may_be_slice(grid.slices, from, to, static_cast<int>(cell / tiles), rounds_to_nearest);
}

std::int64_t tile_on_host(const grid::Tiles& tiles, const grid::Sample& sample) {
  if (!tiles.shows(sample.pixel_x, sample.pixel_y) || !(tiles.orthographic || sample.view.z < 0.0f)) return -1;
  const Vec2i tile = tiles.tile_of(sample.pixel_x, sample.pixel_y);
  return std::int64_t{tile.y} * tiles.count.x + tile.x;
}

bool may_find_tile(const grid::Tiles& tiles, const grid::Sample& sample, std::int64_t cell, bool rounds_to_nearest) {
  if (tile_on_host(tiles, sample) < 0 || cell < 0) return tile_on_host(tiles, sample) == cell;
  return may_be_tile(tiles, sample, {static_cast<int>(cell % tiles.count.x), static_cast<int>(cell / tiles.count.x)},
                     rounds_to_nearest);
}

// --- Boxes ---

bool may_find_in_level(const grid::CascadesGrid& grid, const grid::Sample& sample, int level, std::int64_t cell) {
  const Vec3d at = Vec3d(sample.view) / static_cast<double>(grid.edge_m(level));
  const Vec3d half(0.5 * grid.cells.x, 0.5 * grid.cells.y, 0.0);
  const Off found[] = {{at.x + half.x, 0}, {half.y - at.y, 0}, {-at.z, 0}};
  const double quotients[] = {std::abs(at.x), std::abs(at.y), std::abs(at.z)};
  bool may_be_within = true, is_within = true, may_be = true;
  const std::int64_t of_level = cell - std::int64_t{level} * grid.cells.x * grid.cells.y * grid.cells.z;
  const std::int64_t wanted[] = {of_level % grid.cells.x, of_level / grid.cells.x % grid.cells.y,
                                 of_level / grid.cells.x / grid.cells.y};
  for (int axis = 0; axis < 3; ++axis) {
    Off one = found[axis];
    one.error = k_ulp * (3.5 * quotients[axis] + std::abs(one.value));
    may_be_within = may_be_within && one.may_be_within(grid.cells[axis]);
    is_within = is_within && one.is_within(grid.cells[axis]);
    may_be = may_be && wanted[axis] >= 0 && wanted[axis] < grid.cells[axis] &&
             one.may_be_in(static_cast<int>(wanted[axis]), grid.cells[axis]);
  }
  if (may_be_within && may_be) return true;
  if (is_within || level + 1 == grid.levels) return !is_within && cell < 0;
  return may_find_in_level(grid, sample, level + 1, cell);
}

bool may_find_in_world(const grid::WorldGrid& grid, const grid::Sample& sample, std::int64_t cell,
                       bool rounds_to_nearest) {
  const std::int64_t on_host = grid.lookup(sample, grid::Log2::rounded);
  if (rounds_to_nearest || cell < 0 || on_host < 0) return cell == on_host;
  const Vec3i cells = grid.counts();
  const std::int64_t wanted[] = {cell % cells.x, cell / cells.x % cells.y, cell / cells.x / cells.y};
  const std::vector<float>* axes[] = {&grid.x, &grid.y, &grid.z};
  const Vec3f at(sample.from(grid.origin));
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = static_cast<double>(axes[axis]->front()), hi = static_cast<double>(axes[axis]->back());
    const double value = (static_cast<double>(at[axis]) - lo) * cells[axis] / (hi - lo);
    if (!Off{value, 8.0 * k_ulp * value}.may_be_in(static_cast<int>(wanted[axis]), cells[axis])) return false;
  }
  return true;
}

}  // namespace

std::vector<float> set_lookup(const grid::Grid& grid, LookedUp looked_up, ReadingMode& mode,
                              ReadingArguments& arguments) {
  const Vec3i cells = grid.cells();
  arguments.columns = static_cast<std::uint32_t>(cells.x);
  arguments.rows = static_cast<std::uint32_t>(cells.y);
  arguments.slices = static_cast<std::uint32_t>(cells.z);
  if (looked_up == LookedUp::position) {
    mode.lookup = ReadingLookup::position;
    return {};
  }
  if (grid.has_tiles()) {
    mode.lookup = looked_up == LookedUp::tile ? ReadingLookup::tile : ReadingLookup::screen;
    set_screen(grid.screen(), mode, arguments);
    if (grid.screen().slices.lookup.form == grid::SliceLookup::Form::search) return grid.screen().slices.boundaries;
  } else if (grid.kind() == grid::Kind::cascades) {
    mode.lookup = ReadingLookup::cascades;
    arguments.slices = static_cast<std::uint32_t>(grid.cascades().cells.z);
    arguments.levels = static_cast<std::uint32_t>(grid.cascades().levels);
    arguments.finest = grid.cascades().finest_m;
  } else {
    mode.lookup = ReadingLookup::world;
    set_world(grid.world(), arguments);
  }
  return {};
}

std::int64_t cell_on_host(const grid::Grid& grid, LookedUp looked_up, const grid::Sample& sample) {
  if (looked_up == LookedUp::position) return 0;
  return looked_up == LookedUp::tile ? tile_on_host(grid.screen().tiles, sample) : grid::lookup(grid, sample);
}

bool may_find(const grid::Grid& grid, LookedUp looked_up, const grid::Sample& sample, std::int64_t cell,
              bool rounds_to_nearest) {
  if (looked_up == LookedUp::position) return cell == 0;
  if (looked_up == LookedUp::tile) return may_find_tile(grid.screen().tiles, sample, cell, rounds_to_nearest);
  if (grid.has_tiles()) return may_find_on_screen(grid.screen(), sample, cell, rounds_to_nearest);
  if (grid.kind() == grid::Kind::cascades) return may_find_in_level(grid.cascades(), sample, 0, cell);
  return may_find_in_world(grid.world(), sample, cell, rounds_to_nearest);
}

}  // namespace clusterbench::gpu
