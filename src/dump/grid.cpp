#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "dump/dump_frame.h"
#include "geom/shapes/domain.h"

namespace clusterbench::dump {
namespace {

constexpr const char* k_slices = "/grid/slices";

// Where f(depth * depth_scale + depth_offset) has a value.
double depth_of(const result::DumpFormula& formula, double value) {
  const double inner = formula.function == "log2" ? std::exp2(value)
                       : formula.function == "ln" ? std::exp(value)
                                                  : value;
  return (inner - formula.depth_offset.value_or(0.0)) / formula.depth_scale.value_or(1.0);
}

// Slices as a shader's formula gives them. What it gives below slice 0 belongs to slice 0, which then begins at the
// near plane.
std::vector<double> formula_boundaries(const result::DumpFormula& formula, std::int64_t count,
                                       const view::Projection& projection) {
  std::vector<double> out;
  for (std::int64_t i = 0; i <= count; ++i)
    out.push_back(depth_of(formula, (static_cast<double>(i) - formula.bias) / formula.scale));
  if (!projection.orthographic) out.front() = std::max(out.front(), 0.0);
  if (projection.near_m < out[1]) out.front() = std::min(out.front(), projection.near_m);
  if (!formula.far_m) return out;
  out.back() = *formula.far_m;
  const double begin = out[out.size() - 2];
  if (begin < out.back() && !(static_cast<float>(begin) < static_cast<float>(out.back())))
    throw Error("", std::string(k_slices) + "/formula/far_m",
                "is " + grid::number_name(out.back()) + " m, where the last slice (" + std::to_string(count - 1) +
                    ") begins, at " + grid::number_name(begin) + " m: nothing is left of it; is the bias right?");
  return out;
}

// `place`: the key that gives them; `last_place`: the last of them.
void set_boundaries(grid::Slicing& slices, std::vector<double> boundaries, const std::string& place,
                    const std::string& last_place) {
  for (std::size_t i = 1; i < boundaries.size(); ++i)
    if (!(boundaries[i - 1] < boundaries[i]))
      throw Error("", k_slices + (i + 1 < boundaries.size() ? place : last_place),
                  std::string(place == "/boundaries_m" ? "" : "gives boundaries of slices that ") +
                      "do not ascend: " + grid::number_name(boundaries[i - 1]) + " m is followed by " +
                      grid::number_name(boundaries[i]) + " m (slice " + std::to_string(i - 1) + ")");
  slices.scheme = grid::Scheme::list;
  slices.near_m = boundaries.front();
  slices.far_m = boundaries.back();
  slices.count = static_cast<int>(boundaries.size()) - 1;
  slices.boundaries_m = std::move(boundaries);
}

int needed_count(const result::DumpSlices& given) {
  if (!given.count) throw Error("", std::string(k_slices) + "/count", "is missing: scheme and formula need it");
  return static_cast<int>(*given.count);
}

void set_scheme(grid::Slicing& slices, const result::DumpSlices& given) {
  const bool has_first = *given.scheme == "exponential-first";
  if (has_first != given.first_m.has_value())
    throw Error(
        "", std::string(k_slices) + "/first_m",
        has_first ? "is missing: exponential-first needs it" : "has no meaning without scheme exponential-first");
  slices.scheme = has_first                        ? grid::Scheme::exponential_first
                  : *given.scheme == "exponential" ? grid::Scheme::exponential
                                                   : grid::Scheme::linear;
  slices.count = needed_count(given);
  slices.near_m = given.near_m.value_or(0.0);
  slices.far_m = given.far_m.value_or(0.0);
  if (has_first) slices.first_m = *given.first_m;
}

// Tiles without slices.
grid::Slicing one_slice(const view::Projection& projection) {
  if (!std::isfinite(projection.far_m))
    throw Error("", std::string(k_slices) + "/boundaries_m",
                "are missing: where the camera has no far plane, say where the one slice ends");
  grid::Slicing slices;
  set_boundaries(slices, {projection.near_m, projection.far_m}, "", "");
  return slices;
}

// Keys beside the form of slices that reads them.
void check_slice_keys(const result::DumpSlices& given) {
  const char* form = given.boundaries_m ? "boundaries_m"
                     : given.formula    ? "formula"
                     : given.scheme     ? "scheme"
                                        : "count";
  const std::pair<bool, const char*> of_schemes[] = {{given.near_m.has_value(), "/near_m"},
                                                     {given.first_m.has_value(), "/first_m"},
                                                     {given.far_m.has_value(), "/far_m"}};
  for (const auto& [is_given, key] : of_schemes)
    if (is_given && !given.scheme)
      throw Error("", std::string(k_slices) + key,
                  std::string("has no meaning beside ") + form + "; it is of scheme" +
                      (given.formula && key == std::string("/far_m") ? " (formula.far_m)" : ""));
  if (!given.boundaries_m || !given.count) return;
  const std::size_t slices = given.boundaries_m->size() - 1;
  if (*given.count != static_cast<std::int64_t>(slices))
    throw Error("", std::string(k_slices) + "/count",
                "is " + std::to_string(*given.count) + "; boundaries_m are those of " + std::to_string(slices));
}

grid::Slicing slicing_of(const std::optional<result::DumpSlices>& given, const view::Projection& projection) {
  grid::Slicing slices;
  const char* allowed = "allowed: boundaries_m, scheme or formula; count 1 alone for tiles without slices";
  if (!given) throw Error("", k_slices, std::string("are missing; ") + allowed);
  if (!given->boundaries_m && !given->scheme && !given->formula) {
    if (given->count.value_or(0) != 1) throw Error("", k_slices, std::string("do not say where they are; ") + allowed);
    check_slice_keys(*given);
    return one_slice(projection);
  }
  if (given->boundaries_m.has_value() + given->scheme.has_value() + given->formula.has_value() != 1)
    throw Error("", k_slices, "has several of boundaries_m, scheme and formula; allowed: one");
  check_slice_keys(*given);
  if (given->scheme) {
    set_scheme(slices, *given);
    if (slices.far_m == 0.0 && !std::isfinite(projection.far_m))
      throw Error("", std::string(k_slices) + "/far_m", "is missing: the camera has no far plane");
  } else if (given->formula) {
    set_boundaries(slices, formula_boundaries(*given->formula, needed_count(*given), projection), "/formula",
                   given->formula->far_m ? "/formula/far_m" : "/formula");
  } else {
    set_boundaries(slices, *given->boundaries_m, "/boundaries_m", "/boundaries_m");
  }
  return slices;
}

Vec2i pair_of(const result::Size2& size) {
  return {static_cast<int>(size[0]), static_cast<int>(size[1])};
}

grid::Tiling tiling_of(const result::DumpGrid& given) {
  grid::Tiling tiles;
  if (!given.tiles || given.tiles->count.has_value() == given.tiles->pixels.has_value())
    throw Error("", "/grid/tiles", "needs count or pixels, one of the two");
  if (given.tiles->count) tiles.count = pair_of(*given.tiles->count);
  if (given.tiles->pixels) tiles.pixels = pair_of(*given.tiles->pixels);
  return tiles;
}

// Rows of tiles in pixels that are counted from the bottom: the row that is cut off is at the top.
void count_rows_from_bottom(grid::ScreenGrid& screen, const grid::Tiling& tiling, const view::Frame& frame) {
  view::Projection turned = frame.projection;
  turned.top = -frame.projection.bottom;
  turned.bottom = -frame.projection.top;
  const std::vector<float> from_bottom = grid::make_tiles(tiling, turned, frame.viewport).y;
  std::ranges::transform(from_bottom.rbegin(), from_bottom.rend(), screen.tiles.y.begin(), [](float y) { return -y; });
}

std::vector<float> planes_along(const std::vector<double>& given, double origin_m, const char* axis) {
  const std::string pointer = std::string("/grid/planes/") + axis;
  std::vector<float> out;
  for (const double plane_m : given) {
    out.push_back(static_cast<float>(plane_m));
    if (!geom::is_in_domain(origin_m + plane_m) || !std::isfinite(out.back()))
      throw Error("", pointer, "has " + grid::number_name(plane_m) + " m, which takes it beyond 1e15 m");
    if (out.size() > 1 && !(out[out.size() - 2] < out.back()))
      throw Error("", pointer, "does not ascend in single precision at " + grid::number_name(plane_m) + " m");
  }
  return out;
}

grid::Grid grid_of_planes(const result::DumpGrid& given) {
  if (given.cells || given.bounds || given.tiles || given.slices)
    throw Error("", "/grid/planes", "stands beside cells, bounds, tiles or slices; allowed: alone");
  const result::DumpPlanes& planes = *given.planes;
  grid::WorldGrid world;
  for (int i = 0; i < 3; ++i) world.origin[i] = planes.origin_m[static_cast<std::size_t>(i)];
  world.x = planes_along(planes.x_m, world.origin.x, "x_m");
  world.y = planes_along(planes.y_m, world.origin.y, "y_m");
  world.z = planes_along(planes.z_m, world.origin.z, "z_m");
  constexpr double k_most_cells = 1e9;
  const Vec3d cells(world.counts());
  if (cells.x * cells.y * cells.z > k_most_cells) throw Error("", "/grid/planes", "give more than 10^9 cells");
  return {std::move(world)};
}

grid::GridSpec world_spec(const result::DumpGrid& given) {
  grid::GridSpec spec;
  spec.kind = grid::Kind::world;
  if (!given.cells) throw Error("", "/grid/cells", "is missing: a world grid needs it, or planes");
  if (!given.bounds) throw Error("", "/grid/bounds", "is missing: a world grid needs it");
  if (given.tiles || given.slices)
    throw Error("", given.tiles ? "/grid/tiles" : k_slices, "has no meaning in a world grid");
  const auto& cells = *given.cells;
  spec.cells = {static_cast<int>(cells[0]), static_cast<int>(cells[1]), static_cast<int>(cells[2])};
  spec.has_bounds = true;
  for (int i = 0; i < 3; ++i) {
    spec.bounds_lo_m[i] = given.bounds->lo_m[static_cast<std::size_t>(i)];
    spec.bounds_hi_m[i] = given.bounds->hi_m[static_cast<std::size_t>(i)];
  }
  return spec;
}

// Of a key of a configuration, as "slices.near".
std::string place_in_dump(const std::string& key, const result::DumpGrid& given) {
  if (key.starts_with("slices") && given.slices) {
    if (given.slices->formula) return std::string(k_slices) + "/formula";
    if (given.slices->boundaries_m) return std::string(k_slices) + "/boundaries_m";
  }
  if (key == "cells" && given.kind.value_or("frustum") != "world") return "/grid";  // tiles times slices
  std::string pointer = "/grid/" + key;
  std::ranges::replace(pointer, '.', '/');
  for (const char* length : {"/near", "/far", "/first"})
    if (pointer == k_slices + std::string(length)) pointer += "_m";
  return pointer;
}

// Keys of a configuration in a sentence, as those of a dump.
std::string words_in_dump(std::string message) {
  constexpr std::string_view k_key = "grids.*.slices.";
  for (std::size_t at = 0; (at = message.find(k_key, at)) != std::string::npos;) {
    message.replace(at, k_key.size(), "grid.slices.");
    if (message.compare(at, 17, "grid.slices.first") == 0) message.insert(at + 17, "_m");
  }
  return message;
}

}  // namespace

layout::CellOrder order_of(const result::DumpGrid& grid) {
  return {grid.axes.value_or("xyz"), grid.first_row.value_or("top") == "bottom",
          grid.first_slice.value_or("near") == "far"};
}

grid::Grid grid_of(const result::DumpGrid& given, const view::Frame& frame) {
  const std::string kind = given.kind.value_or("frustum");
  grid::GridSpec spec;
  if (kind == "world") {
    if (given.planes) return grid_of_planes(given);
    spec = world_spec(given);
  } else {
    if (given.cells || given.bounds || given.planes)
      throw Error("",
                  given.cells    ? "/grid/cells"
                  : given.bounds ? "/grid/bounds"
                                 : "/grid/planes",
                  "is of world grids only");
    spec.kind = kind == "distance" ? grid::Kind::distance : grid::Kind::frustum;
    spec.tiles = tiling_of(given);
    spec.slices = slicing_of(given.slices, frame.projection);
  }
  try {
    grid::Grid grid = grid::make_grid(spec, grid::grid_inputs(spec, frame, 0.0, Vec3d(0.0), Vec3d(0.0)));
    if (grid.has_tiles() && given.first_row.value_or("top") == "bottom" && !spec.tiles.is_by_count())
      count_rows_from_bottom(std::get<grid::ScreenGrid>(grid.shape), spec.tiles, frame);
    return grid;
  } catch (const Error& error) {  // names keys of a configuration, "slices.near"
    const bool counts_tiles = error.where() == "cells" && given.tiles;
    throw Error("", place_in_dump(error.where(), given),
                (counts_tiles ? "its cells " : "") + words_in_dump(error.message()), error.code());
  }
}

}  // namespace clusterbench::dump
