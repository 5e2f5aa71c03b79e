#include "grid/screen_grid.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/text.h"
#include "geom/shapes/domain.h"

namespace clusterbench::grid {
namespace {

// The farthest corners of a perspective grid are as far to the side as their slopes say.
void check_extent(const ScreenGrid& grid) {
  const Tiles& tiles = grid.tiles;
  if (tiles.orthographic) return;
  const float steepest = std::max(
      {std::fabs(tiles.x.front()), std::fabs(tiles.x.back()), std::fabs(tiles.y.front()), std::fabs(tiles.y.back())});
  if (!geom::is_in_domain(static_cast<double>(steepest) * static_cast<double>(grid.slices.boundaries.back())))
    throw Error("", "slices.far", "is too far for so wide a view: the picture's corners there are beyond 1e15 m");
}

SliceRange slice_range(const GridInputs& inputs) {
  return {inputs.projection.near_m, inputs.projection.far_m, inputs.light_near_m, inputs.light_far_m};
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

LightReach reach_in_view(const view::Frame& frame, bool by_distance) {
  LightReach reach;
  for (const scene::WorldLight& light : frame.lights) {
    if (light.range_m == 0.0 || !std::isfinite(light.range_m)) continue;
    const Vec3d c = frame.view_space.rotation * (light.position - frame.view_space.origin);
    const double along = by_distance ? std::sqrt(c.x * c.x + c.y * c.y + c.z * c.z) : -c.z;
    if (!may_be_in_view(frame.projection, c, light.range_m)) continue;
    reach.near = std::min(reach.near, along - light.range_m);
    reach.far = std::max(reach.far, along + light.range_m);
  }
  return reach;
}

// --- Names ---

std::string pair(int a, int b, const char* unit) {
  return (a == b && *unit != '\0' ? std::to_string(a) : std::to_string(a) + "x" + std::to_string(b)) + unit;
}

std::string tiles_name(const Tiling& tiles) {
  const bool by_count = tiles.count.x != 0 || tiles.count.y != 0;
  return by_count ? pair(tiles.count.x, tiles.count.y, "") : pair(tiles.pixels.x, tiles.pixels.y, "px");
}

// "near..far", or "near..first..far"; what the camera or the lights decide is left out.
std::string reach_name(const Slicing& slices) {
  const std::string near = slices.near_m == 0.0 ? "" : number_name(slices.near_m);
  const std::string far = slices.far_m == 0.0 ? "" : number_name(slices.far_m);
  const bool has_first = slices.scheme == Scheme::exponential_first;
  if (near.empty() && far.empty()) return has_first ? " first " + number_name(slices.first_m) : "";
  return " " + near + ".." + (has_first ? number_name(slices.first_m) + ".." : "") + far;
}

// All of a short list; of a long one its ends, and a digest that tells it from others.
std::string boundaries_name(const std::vector<double>& boundaries) {
  constexpr std::size_t k_most_shown = 17;
  std::string all;
  for (const double boundary : boundaries) all += " " + number_name(boundary);
  if (boundaries.size() <= k_most_shown) return all;
  return " " + number_name(boundaries.front()) + ".." + number_name(boundaries.back()) + " #" +
         sha256_hex(all).substr(0, 8);
}

std::string slices_name(const Slicing& slices) {
  const std::string count = std::to_string(slices.scheme == Scheme::list ? slices.boundaries_m.size() - 1
                                                                         : static_cast<std::size_t>(slices.count));
  switch (slices.scheme) {
    case Scheme::linear:
      return count + " linear" + reach_name(slices);
    case Scheme::exponential:
      return count + " exponential" + reach_name(slices);
    case Scheme::exponential_first:
      return count + " exponential-first" + reach_name(slices);
    case Scheme::power:
      return count + " power " + number_name(slices.lambda) + reach_name(slices);
    case Scheme::fit:
      return count + " fit" + reach_name(slices);
    case Scheme::list:
      break;
  }
  return count + " list" + boundaries_name(slices.boundaries_m);
}

}  // namespace

std::int64_t ScreenGrid::lookup(const Sample& sample, Log2 way) const {
  if (!tiles.shows(sample.pixel_x, sample.pixel_y)) return -1;
  const int slice = slices.slice_of(along(sample.view), way);
  if (slice < 0) return -1;
  const Vec2i tile = tiles.tile_of(sample.pixel_x, sample.pixel_y);
  return cell_index({tile.x, tile.y, slice}, counts());
}

ScreenGrid make_screen_grid(const GridSpec& spec, const GridInputs& inputs) {
  if (spec.kind == Kind::distance && inputs.projection.orthographic)
    throw Error("", "kind", "distance grids have their shells around the eye; an orthographic camera has none");
  ScreenGrid grid;
  grid.by_distance = spec.kind == Kind::distance;
  grid.tiles = make_tiles(spec.tiles, inputs.projection, inputs.viewport);
  grid.slices = make_slices(spec.slices, slice_range(inputs), inputs.projection.orthographic);
  check_extent(grid);
  return grid;
}

GridInputs screen_inputs(const GridSpec& spec, const FrameReach& from) {
  GridInputs inputs;
  inputs.projection = from.frame.projection;
  inputs.viewport = from.frame.viewport;
  inputs.light_far_m = from.path_far_m;
  if (spec.slices.scheme == Scheme::fit) {
    const LightReach reach = reach_in_view(from.frame, spec.kind == Kind::distance);
    inputs.light_near_m = reach.near;
    inputs.light_far_m = reach.far;
  }
  return inputs;
}

std::string screen_grid_name(const GridSpec& spec) {
  return std::string(kind_name(spec.kind)) + " " + tiles_name(spec.tiles) + " x " + slices_name(spec.slices);
}

}  // namespace clusterbench::grid
