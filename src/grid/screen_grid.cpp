#include "grid/screen_grid.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "geom/shapes/domain.h"

namespace clusterbench::grid {
namespace {

// Checks the domain: the farthest corners of a perspective grid are as far to the side as their slopes say.
void check_extent(const ScreenGrid& grid) {
  const Tiles& tiles = grid.tiles;
  if (tiles.orthographic) return;
  const float steepest = std::max(
      {std::fabs(tiles.x.front()), std::fabs(tiles.x.back()), std::fabs(tiles.y.front()), std::fabs(tiles.y.back())});
  if (!geom::is_in_domain(static_cast<double>(steepest) * static_cast<double>(grid.slices.boundaries.back())))
    throw Error("", "slices.far", "is too far for so wide a view: the picture's corners there are beyond 1e15 m");
}

SliceRange slice_range(const GridInputs& inputs) {
  return {inputs.projection.near_m, inputs.projection.far_m, inputs.light_near_m, inputs.light_far_m, inputs.needed};
}

double ratio_of(const Slicing& slicing, const SliceRange& range) {
  const bool has_first = slicing.scheme == Scheme::exponential_first;
  if (!has_first && slicing.scheme != Scheme::exponential)
    throw Error("", "tiles.aspect", "takes exponential or exponential-first slices, which grow by a factor");
  const Span requested = requested_span(slicing, range);
  const double from = has_first ? slicing.first_m : requested.near_m;
  const int count = slicing.count - (has_first ? 1 : 0);
  if (!(from > 0.0) || !(from < requested.far_m) || !std::isfinite(requested.far_m) || count < 1)
    throw Error("", "tiles.aspect", "takes slices from a near above 0 to a finite far");
  return std::pow(requested.far_m / from, 1.0 / count);
}

void check_reaction(const GridSpec& spec) {
  if (!spec.reaction) return;
  if (spec.has_cell_shape())
    throw Error("", "react", "takes tiles in pixels or so many per screen, and slices that do not follow from them");
  if (spec.reaction->to == Reaction::To::mask_words && spec.tiles.is_by_count())
    throw Error("", "react.to", "is mask-words, which doubles tiles in pixels; found tiles.count");
}

// With the frame's own tiles, and with all values that depend on a projection computed from that of the path's first
// frame.
GridSpec resolved(const GridSpec& spec, const GridInputs& inputs) {
  if (!spec.has_cell_shape()) {
    GridSpec out = spec;
    if (inputs.tiles) out.tiles = *inputs.tiles;
    return out;
  }
  GridInputs of_shape = inputs;
  of_shape.projection = inputs.shape.value_or(inputs.projection);
  const view::Projection& projection = of_shape.projection;
  GridSpec out = spec;
  if (spec.tiles.aspect > 0.0) {
    if (projection.orthographic)
      throw Error("", "tiles.aspect", "takes a perspective camera; of an orthographic one take scheme cubical");
    out.tiles = resolved_aspect(spec.tiles, ratio_of(spec.slices, slice_range(of_shape)), projection, inputs.viewport);
    return out;
  }
  if (spec.slices.fit)
    throw Error("", "slices.fit", "has no meaning for cubical slices: as many as they are follows from near and far");
  make_tiles(spec.tiles, projection, inputs.viewport);  // throws for an invalid tiling
  out.slices = resolved_cubical(spec.slices, slice_range(of_shape),
                                tile_height(spec.tiles, projection, inputs.viewport), projection.orthographic);
  return out;
}

}  // namespace

std::int64_t ScreenGrid::lookup(const Sample& sample, Log2 way) const {
  if (!tiles.shows(sample.pixel_x, sample.pixel_y)) return -1;
  const int slice = slices.slice_of(along(sample.view), way);
  if (slice < 0) return -1;
  const Vec2i tile = tiles.tile_of(sample.pixel_x, sample.pixel_y);
  return cell_index({tile.x, tile.y, slice}, counts());
}

ScreenGrid make_screen_grid(const GridSpec& requested, const GridInputs& inputs) {
  if (inputs.viewport.x < 1 || inputs.viewport.y < 1) throw Error("", "viewport", "must be at least 1 x 1 pixels");
  if (requested.slices.fit && requested.slices.fit->step > 1.0 && requested.slices.fit->step < k_least_step)
    throw Error("", "slices.fit.step",
                "is " + number_name(requested.slices.fit->step) + "; allowed: 1, or at least 1.01");
  check_reaction(requested);
  const GridSpec spec = resolved(requested, inputs);
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
  const bool by_distance = spec.kind == Kind::distance;
  if (spec.has_cell_shape()) inputs.shape = inputs.projection;
  if (spec.reaction) {
    inputs.tiles = spec.tiles;
    if (spec.reaction->to == Reaction::To::mask_words)
      inputs.tiles =
          doubled_tiles(spec.tiles, inputs.viewport, lights_with_bits(*spec.reaction, from.frame), spec.reaction->most);
  }
  if (spec.slices.scheme == Scheme::fit) {
    const Span reach = span_of_balls(from.frame, by_distance);
    inputs.light_near_m = reach.near_m;
    inputs.light_far_m = reach.far_m;
  } else if (spec.slices.fit) {
    inputs.needed = needed_span(*spec.slices.fit, from.frame, from.depths, by_distance);
    if (spec.slices.fit->to != Fit::To::ranges)
      inputs.needed = inputs.needed.within(requested_span(spec.slices, slice_range(inputs)));
  }
  return inputs;
}

}  // namespace clusterbench::grid
