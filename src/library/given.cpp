#include "library/given.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/memory.h"
#include "geom/shapes/domain.h"

namespace clusterbench::library {
namespace {

std::string short_number(double value) {
  if (std::isnan(value)) return "nan";
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

[[noreturn]] void refuse(const std::string& where, const std::string& problem) {
  throw Error("", where, problem);
}

// --- Grid and parameters ---

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

grid::Tiling tiling_of(const Grid& given) {
  if ((given.columns == 0) != (given.rows == 0))
    refuse("grid.columns, grid.rows", "are " + std::to_string(given.columns) + " and " + std::to_string(given.rows) +
                                          "; allowed: both 0, or both above 0");
  grid::Tiling tiling;
  tiling.pixels = given.columns == 0 ? Vec2i(given.tile_width, given.tile_height) : Vec2i(0, 0);
  tiling.count = Vec2i(given.columns, given.rows);
  const auto check_least = [](const char* where, int number) {
    if (number < 1) refuse(where, "is " + std::to_string(number) + "; allowed: 1 or more");
  };
  const bool is_by_count = given.columns != 0;
  check_least(is_by_count ? "grid.columns" : "grid.tile_width", is_by_count ? given.columns : given.tile_width);
  check_least(is_by_count ? "grid.rows" : "grid.tile_height", is_by_count ? given.rows : given.tile_height);
  return tiling;
}

// What make_grid does not check.
void check_slicing(const Grid& given) {
  if (given.slicing != Grid::Slicing::list && !given.boundaries_m.empty())
    refuse("grid.boundaries_m", "are given, and grid.slicing is not list; allowed: none");
  if (given.slicing == Grid::Slicing::power && !(given.lambda >= 0.0 && given.lambda <= 1.0))
    refuse("grid.lambda", "is " + short_number(given.lambda) + "; allowed: 0 to 1");
  for (std::size_t i = 1; i < given.boundaries_m.size(); ++i)
    if (!(given.boundaries_m[i - 1] < given.boundaries_m[i]))
      refuse("grid.boundaries_m", "have " + short_number(given.boundaries_m[i]) + " after " +
                                      short_number(given.boundaries_m[i - 1]) + "; allowed: ascending numbers");
}

grid::Slicing slicing_of(const Grid& given) {
  check_slicing(given);
  grid::Slicing slices;
  slices.scheme = scheme_of(given.slicing);
  slices.count = given.slices;
  slices.near_m = given.near_m;
  slices.far_m = given.far_m;
  slices.first_m = given.first_m;
  slices.lambda = given.lambda;
  slices.boundaries_m.assign(given.boundaries_m.begin(), given.boundaries_m.end());
  return slices;
}

void check_count(const char* where, std::size_t count, std::size_t most) {
  if (count < 1 || count > most)
    refuse(where, "is " + std::to_string(count) + "; allowed: 1 to " + std::to_string(most));
}

// As in a configuration; the product of cells is limited where the grid is made.
void check_counts(const Grid& given) {
  constexpr int k_most_cells = 65536, k_most_slices = 4096;
  const auto count_of = [](int count) { return count < 0 ? 0 : static_cast<std::size_t>(count); };
  switch (given.kind) {
    case Grid::Kind::frustum:
    case Grid::Kind::distance:
      if (given.slicing != Grid::Slicing::list)
        return check_count("grid.slices", count_of(given.slices), k_most_slices);
      if (given.boundaries_m.size() < 2) refuse("grid.boundaries_m", "are fewer than 2; allowed: 2 to 4097");
      return check_count("grid.boundaries_m", given.boundaries_m.size(), k_most_slices + 1);
    case Grid::Kind::cascades:
    case Grid::Kind::world:
      for (const int cells : given.cells) check_count("grid.cells", count_of(cells), k_most_cells);
      return;
  }
  refuse("grid.kind", "is none; allowed: frustum, distance, cascades, world");
}

assign::ParamValue value_of(const char* where, const Parameter& parameter) {
  switch (parameter.type) {
    case Parameter::Type::flag:
      return parameter.flag;
    case Parameter::Type::text:
      return std::string(parameter.text);
    case Parameter::Type::number:
      return parameter.number;
  }
  refuse(where, "have '" + std::string(parameter.name) + "' of no type; allowed: number, text, flag");
}

// --- Camera ---

// As View::set_matrices() does.
void check_axes(const Mat3d& rotation) {
  constexpr double k_most_off = 1e-3;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      double sum = 0.0;
      for (int i = 0; i < 3; ++i) sum += rotation[i][a] * rotation[i][b];
      if (!(std::abs(sum - (a == b ? 1.0 : 0.0)) <= k_most_off))
        refuse("view.to_right, view.to_top, view.forward",
               "are not unit and orthogonal; allowed: products within 1e-3 of 1 and 0");
    }
}

void check_sides(const view::Projection& projection) {
  try {
    view::check_projection(projection);
  } catch (const Error& error) {
    refuse("view", error.message());
  }
}

void check_range_of_depths(const View& view) {
  const bool has_near = view.is_orthographic ? std::isfinite(view.near_m) : view.near_m > 0.0;
  const bool has_far = view.near_m < view.far_m && (!view.is_orthographic || std::isfinite(view.far_m));
  if (has_near && has_far) return;
  refuse("view.near_m, view.far_m",
         "are " + short_number(view.near_m) + " and " + short_number(view.far_m) +
             "; allowed: 0 < near < far, far may be infinite; of an orthographic camera near < far, both "
             "finite");
}

void check_depth(float depth, bool is_orthographic) {
  const float least = is_orthographic ? std::numeric_limits<float>::lowest() : 0.0f;
  if (depth >= least) return;
  refuse("view.depths", "have " + short_number(static_cast<double>(depth)) + "; allowed: " +
                            (is_orthographic ? "metres" : "0 m or more") + ", and +inf without a surface");
}

// --- Lights ---

std::string name_of(const char* kind, std::size_t index, const char* member) {
  return std::string("lights.") + kind + "[" + std::to_string(index) + "]." + member;
}

std::string text_of(const float (&numbers)[3]) {
  return "(" + short_number(static_cast<double>(numbers[0])) + ", " + short_number(static_cast<double>(numbers[1])) +
         ", " + short_number(static_cast<double>(numbers[2])) + ")";
}

Vec3d vector_of(const float (&numbers)[3]) {
  return {static_cast<double>(numbers[0]), static_cast<double>(numbers[1]), static_cast<double>(numbers[2])};
}

bool is_position(const Vec3d& p) {
  return geom::is_in_domain(p.x) && geom::is_in_domain(p.y) && geom::is_in_domain(p.z);
}

void set_ball(const char* kind, std::size_t index, const float (&position)[3], float range, scene::WorldLight& out) {
  out.position = vector_of(position);
  out.range_m = geom::range_in_domain(static_cast<double>(range));
  if (!is_position(out.position))
    refuse(name_of(kind, index, "position"), "is " + text_of(position) +
                                                 "; allowed: up to 1e15 m from the origin along "
                                                 "each axis");
  if (!(range >= 0.0f))
    refuse(name_of(kind, index, "range"), "is " + short_number(static_cast<double>(range)) + "; allowed: 0 or more");
}

void set_spot(std::size_t index, const SpotLight& spot, scene::WorldLight& out) {
  set_ball("spots", index, spot.position, spot.range, out);
  const Vec3d direction = vector_of(spot.direction);
  const double length = std::sqrt(direction.x * direction.x + direction.y * direction.y + direction.z * direction.z);
  if (!(length > 0.0) || !std::isfinite(length))
    refuse(name_of("spots", index, "direction"), "is " + text_of(spot.direction) + "; allowed: any direction but 0");
  out.direction = direction / length;
  // pi/2 in single precision is above pi/2.
  out.outer_cone_rad = std::min(static_cast<double>(spot.outer_angle), std::numbers::pi / 2.0);
  if (!(spot.outer_angle >= 0.0f && spot.outer_angle <= static_cast<float>(std::numbers::pi / 2.0)))
    refuse(name_of("spots", index, "outer_angle"),
           "is " + short_number(static_cast<double>(spot.outer_angle)) + "; allowed: 0 to pi/2");
}

void set_box(std::size_t index, const Box& box, scene::WorldLight& out) {
  set_ball("boxes", index, box.center, 0.0f, out);
  for (std::size_t i = 0; i < out.half_axes_m.size(); ++i) {
    out.half_axes_m[i] = vector_of(box.half_axes[i]);
    if (!is_position(out.half_axes_m[i]))
      refuse(name_of("boxes", index, "half_axes"), "have " + text_of(box.half_axes[i]) + "; allowed: up to 1e15 m");
  }
  out.range_m = geom::range_in_domain(scene::corner_distance_m(out.half_axes_m));
  if (!std::isfinite(out.range_m))
    refuse(name_of("boxes", index, "half_axes"), "reach farther than 1e15 m from the center");
}

void check_light_count(std::size_t count) {
  if (count > std::numeric_limits<std::uint32_t>::max() / 2)
    refuse("lights", "are " + std::to_string(count) + "; allowed: 2^31 - 1");
  check_memory("lights", count, sizeof(scene::WorldLight));
}

// Types of the lights that are there, without their numbers.
void set_types(const Lights& lights, view::Frame& frame) {
  const std::size_t points = lights.points.size(), spots = lights.spots.size(), boxes = lights.boxes.size();
  const view::LightRanges before = frame.ranges();
  if (before.points.count == points && before.spots.count == spots && before.boxes.count == boxes) return;
  check_light_count(points + spots + boxes);
  frame.lights.resize(points + spots + boxes);
  for (std::size_t i = 0; i < frame.lights.size(); ++i)
    frame.lights[i].type = i < points           ? scene::LightType::point
                           : i < points + spots ? scene::LightType::spot
                                                : scene::LightType::box;
  frame.points = static_cast<std::uint32_t>(points);
  frame.boxes = static_cast<std::uint32_t>(boxes);
}

}  // namespace

grid::GridSpec grid_spec_of(const Grid& given) {
  check_counts(given);
  grid::GridSpec spec;
  spec.kind = static_cast<grid::Kind>(given.kind);
  if (spec.has_tiles()) {
    spec.tiles = tiling_of(given);
    spec.slices = slicing_of(given);
  }
  spec.cells = Vec3i(given.cells[0], given.cells[1], given.cells[2]);
  spec.levels = given.levels;
  spec.finest_m = given.finest_m;
  spec.has_bounds = true;
  spec.bounds_lo_m = Vec3d(given.lo_m[0], given.lo_m[1], given.lo_m[2]);
  spec.bounds_hi_m = Vec3d(given.hi_m[0], given.hi_m[1], given.hi_m[2]);
  return spec;
}

assign::Params params_of(const char* where, std::span<const assign::ParamSpec> specs,
                         std::span<const Parameter> given) {
  std::map<std::string, assign::ParamValue> values;
  for (const Parameter& parameter : given)
    if (!values.emplace(parameter.name, value_of(where, parameter)).second)
      refuse(where, "have '" + std::string(parameter.name) + "' twice; allowed: each once");
  try {
    return {specs, values};
  } catch (const Error& error) {
    refuse(where + std::string(": ") + error.where(), error.message());
  }
}

void set_camera(const View& view, view::Frame& frame) {
  constexpr int k_widest = 1 << 20;
  if (view.width < 1 || view.height < 1 || view.width > k_widest || view.height > k_widest)
    refuse("view.width, view.height", "are " + std::to_string(view.width) + " and " + std::to_string(view.height) +
                                          "; allowed: 1 to 1048576 pixels");
  if (!(view.left < view.right) || !(view.bottom < view.top))
    refuse("view.left, view.right, view.bottom, view.top", "are no picture; allowed: left < right, bottom < top");
  check_range_of_depths(view);
  frame.viewport = {view.width, view.height};
  frame.projection = {view.is_orthographic, view.left, view.right, view.bottom, view.top, view.near_m, view.far_m};
  check_sides(frame.projection);
  view::Space& space = frame.view_space;
  space.origin = Vec3d(view.eye[0], view.eye[1], view.eye[2]);
  if (!is_position(space.origin)) refuse("view.eye", "is farther than 1e15 m from the origin along an axis");
  for (int i = 0; i < 3; ++i) space.rotation[i] = Vec3d(view.to_right[i], view.to_top[i], -view.forward[i]);
  check_axes(space.rotation);
}

void set_lights(const Lights& lights, view::Frame& frame) {
  set_types(lights, frame);
  scene::WorldLight* out = frame.lights.data();
  for (std::size_t i = 0; i < lights.points.size(); ++i)
    set_ball("points", i, lights.points[i].position, lights.points[i].range, *out++);
  for (std::size_t i = 0; i < lights.spots.size(); ++i) set_spot(i, lights.spots[i], *out++);
  for (std::size_t i = 0; i < lights.boxes.size(); ++i) set_box(i, lights.boxes[i], *out++);
}

void set_depths(const View& view, depth::DepthImage& image) {
  if (image.pixels.viewport != Vec2i(view.width, view.height))
    image.pixels = depth::PixelGrid(Vec2i(view.width, view.height), 1);
  if (view.depths.size() != image.pixels.count())
    refuse("view.depths", "are " + std::to_string(view.depths.size()) + ", and this method needs one for each of " +
                              std::to_string(image.pixels.count()) + " pixels");
  image.nearest.assign(view.depths.begin(), view.depths.end());
  for (const float depth : image.nearest) check_depth(depth, view.is_orthographic);
}

}  // namespace clusterbench::library
