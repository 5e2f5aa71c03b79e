// An engine's grid as a request, checked: what fails with every camera, and what fails with this one.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "geom/shapes/domain.h"
#include "library/engine_words.h"
#include "library/given.h"

namespace clusterbench::library {
namespace {

constexpr int k_most_cells = 65536, k_most_slices = 4096, k_most_tiles = 1 << 20;  // no viewport is wider
constexpr double k_most_in_all = 1e9;

void check_count(const std::string& where, std::int64_t count, std::int64_t least, std::int64_t most) {
  if (count >= least && count <= most) return;
  refuse(where, "is " + std::to_string(count) + "; allowed: " + std::to_string(least) + " to " + std::to_string(most));
}

grid::Scheme scheme_of(Grid::Slicing slicing) {
  switch (slicing) {
    case Grid::Slicing::linear:
      return grid::Scheme::linear;
    case Grid::Slicing::exponential:
      return grid::Scheme::exponential;
    case Grid::Slicing::exponential_first:
      return grid::Scheme::exponential_first;
    case Grid::Slicing::power:
      return grid::Scheme::power;
    case Grid::Slicing::list:
      return grid::Scheme::list;
  }
  refuse("grid.slicing", "is none; allowed: linear, exponential, exponential_first, power, list");
}

// --- Tiles ---

void check_in_all(const char* where, double columns, double rows, double slices) {
  if (columns * rows * slices <= k_most_in_all) return;
  refuse(where, "make " + short_number(columns) + " x " + short_number(rows) + " x " + short_number(slices) +
                    " cells; allowed: 10^9 in all");
}

grid::Tiling tiling_of(const Grid& given) {
  if ((given.columns == 0) != (given.rows == 0))
    refuse("grid.columns, grid.rows", "are " + std::to_string(given.columns) + " and " + std::to_string(given.rows) +
                                          "; allowed: both 0, or both above 0");
  const bool is_by_count = given.columns != 0;
  const auto check_size = [](const char* where, int pixels) {
    if (pixels < 1) refuse(where, "is " + std::to_string(pixels) + "; allowed: 1 or more");
  };
  if (is_by_count) {
    check_count("grid.columns", given.columns, 1, k_most_tiles);
    check_count("grid.rows", given.rows, 1, k_most_tiles);
  } else {
    check_size("grid.tile_width", given.tile_width);
    check_size("grid.tile_height", given.tile_height);
  }
  grid::Tiling tiling;
  tiling.pixels = is_by_count ? Vec2i(0, 0) : Vec2i(given.tile_width, given.tile_height);
  tiling.count = Vec2i(given.columns, given.rows);
  return tiling;
}

void check_tiles_in_view(const grid::GridSpec& spec, const View& view) {
  const auto check_along = [](const char* where, int tiles, const char* side, int pixels) {
    if (tiles > pixels)
      refuse(where, "is " + std::to_string(tiles) + ", and " + side + " is " + std::to_string(pixels) +
                        "; allowed: at most one tile per pixel");
  };
  check_along("grid.columns", spec.tiles.count.x, "view.width", view.width);
  check_along("grid.rows", spec.tiles.count.y, "view.height", view.height);
  const Vec2i tiles = grid::tile_counts(spec.tiles, Vec2i(view.width, view.height));
  check_in_all(spec.tiles.is_by_count() ? "grid.columns, grid.rows, grid.slices"
                                        : "grid.tile_width, grid.tile_height, grid.slices",
               tiles.x, tiles.y, spec.slices.count);
}

// --- Slices ---

void check_slice_count(const Grid& given) {
  if (given.slicing == Grid::Slicing::list) {
    const std::size_t count = given.boundaries_m.size();
    if (count < 2 || count > k_most_slices + 1)
      refuse("grid.boundaries_m", "are " + std::to_string(count) + "; allowed: 2 to 4097 numbers");
    return;
  }
  check_count("grid.slices", given.slices, 1, k_most_slices);
  if (given.slicing == Grid::Slicing::exponential_first && given.slices < 2)
    refuse("grid.slices", "is 1; allowed: 2 to 4096, since exponential_first has one before first_m and others behind");
}

// 0: not given.
void check_end(const char* where, double metres, bool takes_negative) {
  if (geom::is_in_domain(metres) && (takes_negative || metres >= 0.0)) return;
  refuse(where, "is " + short_number(metres) + "; allowed: 0 (the camera's), or " +
                    (takes_negative ? "up to 1e15 m from the eye" : "above 0 m, up to 1e15 m"));
}

void check_ends(const Grid& given, bool takes_negative) {
  check_end("grid.near_m", given.near_m, takes_negative);
  check_end("grid.far_m", given.far_m, takes_negative);
  if (given.near_m != 0.0 && given.far_m != 0.0 && !(given.near_m < given.far_m))
    refuse("grid.near_m, grid.far_m",
           "are " + short_number(given.near_m) + " and " + short_number(given.far_m) + "; allowed: near_m below far_m");
}

void check_first(const Grid& given) {
  const auto refuse_first = [&](const std::string& allowed) {
    refuse("grid.first_m", "is " + short_number(given.first_m) + "; allowed: " + allowed);
  };
  if (!(given.first_m > 0.0) || !geom::is_in_domain(given.first_m)) refuse_first("above 0 m, up to 1e15 m");
  if (given.near_m != 0.0 && given.first_m <= given.near_m)
    refuse_first("above grid.near_m, " + short_number(given.near_m));
  if (given.far_m != 0.0 && given.first_m >= given.far_m)
    refuse_first("below grid.far_m, " + short_number(given.far_m));
}

void check_list(const Grid& given, bool takes_negative) {
  const auto check_not_given = [](const char* where, double metres) {
    if (metres != 0.0)
      refuse(where, "is " + short_number(metres) + ", and grid.slicing is list, which has its own ends; allowed: 0");
  };
  check_not_given("grid.near_m", given.near_m);
  check_not_given("grid.far_m", given.far_m);
  for (std::size_t i = 0; i < given.boundaries_m.size(); ++i) {
    const double boundary = given.boundaries_m[i];
    const std::string where = "grid.boundaries_m[" + std::to_string(i) + "]";
    if (!geom::is_in_domain(boundary) || (!takes_negative && boundary < 0.0))
      refuse(where, "is " + short_number(boundary) +
                        "; allowed: " + (takes_negative ? "up to 1e15 m from the eye" : "0 to 1e15 m"));
    if (i > 0 && !(given.boundaries_m[i - 1] < boundary))
      refuse(where, "is " + short_number(boundary) + " after " + short_number(given.boundaries_m[i - 1]) +
                        "; allowed: ascending numbers");
  }
}

void check_slicing(const Grid& given, bool takes_negative) {
  check_slice_count(given);
  if (given.slicing == Grid::Slicing::list) return check_list(given, takes_negative);
  if (!given.boundaries_m.empty())
    refuse("grid.boundaries_m", "are given, and grid.slicing is not list; allowed: none");
  check_ends(given, takes_negative);
  if (given.slicing == Grid::Slicing::exponential_first) check_first(given);
  if (given.slicing == Grid::Slicing::power && !(given.lambda >= 0.0 && given.lambda <= 1.0))
    refuse("grid.lambda", "is " + short_number(given.lambda) + "; allowed: 0 to 1");
}

grid::Slicing slicing_of(const Grid& given) {
  grid::Slicing slices;
  slices.scheme = scheme_of(given.slicing);
  const bool is_list = slices.scheme == grid::Scheme::list;
  slices.count = is_list ? static_cast<int>(given.boundaries_m.size()) - 1 : given.slices;
  slices.near_m = given.near_m;
  slices.far_m = given.far_m;
  slices.first_m = given.first_m;
  slices.lambda = given.lambda;
  slices.boundaries_m.assign(given.boundaries_m.begin(), given.boundaries_m.end());
  return slices;
}

// Slices whose ends are known can be too thin for every camera. One that takes most sees from far behind the eye, or
// from the eye on.
void try_slices(const grid::Slicing& slices, bool takes_negative) {
  const bool has_ends = slices.scheme == grid::Scheme::list || (slices.near_m != 0.0 && slices.far_m != 0.0);
  if (!has_ends) return;
  const double nearest = takes_negative ? -geom::k_farthest_m : std::numeric_limits<double>::min();
  grid::make_slices(slices, {nearest, geom::k_farthest_m, 0.0, 0.0}, takes_negative);
}

void check_slices_in_view(const grid::Slicing& slices, const View& view) {
  const bool is_cameras_far = slices.scheme != grid::Scheme::list && slices.far_m == 0.0;
  if (!is_cameras_far || geom::is_in_domain(view.far_m)) return;
  if (std::isinf(view.far_m))
    refuse("grid.far_m", "is not given, and the camera has no far plane; give one of the two");
  refuse("view.far_m", "is " + short_number(view.far_m) +
                           ", and the slices end there; allowed: up to 1e15 m, or any with grid.far_m");
}

// Runs `work`; its errors name arguments in place of keys.
template <class Work>
auto in_words_of_engines(Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    refuse(grid_argument_of(error.where()), error.message());
  }
}

}  // namespace

grid::Kind kind_of(const Grid& given) {
  switch (given.kind) {
    case Grid::Kind::frustum:
    case Grid::Kind::distance:
    case Grid::Kind::cascades:
    case Grid::Kind::world:
      return static_cast<grid::Kind>(given.kind);
  }
  refuse("grid.kind", "is none; allowed: frustum, distance, cascades, world");
}

grid::GridSpec grid_spec_of(const Grid& given, bool takes_orthographic) {
  grid::GridSpec spec;
  spec.kind = kind_of(given);
  if (spec.has_tiles()) {
    const bool takes_negative = takes_orthographic && spec.kind == grid::Kind::frustum;
    spec.tiles = tiling_of(given);
    spec.slices = slicing_of(given);
    check_slicing(given, takes_negative);
    check_in_all("grid.columns, grid.rows, grid.slices", given.columns, given.rows, spec.slices.count);
    in_words_of_engines([&] { try_slices(spec.slices, takes_negative); });
    return spec;
  }
  for (int i = 0; i < 3; ++i) check_count("grid.cells[" + std::to_string(i) + "]", given.cells[i], 1, k_most_cells);
  spec.cells = Vec3i(given.cells[0], given.cells[1], given.cells[2]);
  spec.levels = given.levels;
  spec.finest_m = given.finest_m;
  spec.has_bounds = true;
  spec.bounds_lo_m = Vec3d(given.lo_m[0], given.lo_m[1], given.lo_m[2]);
  spec.bounds_hi_m = Vec3d(given.hi_m[0], given.hi_m[1], given.hi_m[2]);
  made_grid(spec, {});  // no camera changes these
  return spec;
}

void check_grid_in_view(const grid::GridSpec& spec, const View& view) {
  if (!spec.has_tiles()) return;
  if (spec.kind == grid::Kind::distance && view.is_orthographic)
    refuse("view.is_orthographic",
           "is true, and shells of a distance grid lie around an eye; allowed: false, or another grid.kind");
  check_tiles_in_view(spec, view);
  check_slices_in_view(spec.slices, view);
}

grid::Grid made_grid(const grid::GridSpec& spec, const grid::GridInputs& inputs) {
  return in_words_of_engines([&] { return grid::make_grid(spec, inputs); });
}

}  // namespace clusterbench::library
