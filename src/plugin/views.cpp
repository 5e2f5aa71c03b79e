#include "plugin/views.h"

#include <cmath>

namespace clusterbench::plugin {
namespace {

template <class Struct>
Struct made() {
  Struct out{};
  out.struct_size = sizeof(Struct);
  return out;
}

// The members that hold for tiles.
void add_tiles(const grid::ScreenGrid& screen, clusterbench_grid& out) {
  const grid::Tiles& tiles = screen.tiles;
  const grid::SliceLookup& lookup = screen.slices.lookup;
  out.orthographic = tiles.orthographic ? 1 : 0;
  out.x = tiles.x.data();
  out.y = tiles.y.data();
  out.z = screen.slices.boundaries.data();
  for (int axis = 0; axis < 2; ++axis) {
    out.viewport[axis] = static_cast<std::uint32_t>(tiles.viewport[axis]);
    out.tile_pixels[axis] = static_cast<std::uint32_t>(tiles.pixels[axis]);
  }
  out.tile_scale[0] = tiles.scale_x;
  out.tile_scale[1] = tiles.scale_y;
  using Form = grid::SliceLookup::Form;
  out.slice_form = lookup.form == Form::linear ? 1 : lookup.form == Form::log2 ? 2 : 0;
  out.first_slice = static_cast<std::uint32_t>(lookup.first_slice);
  out.slice_scale = lookup.scale;
  out.slice_bias = lookup.bias;
  out.first = lookup.first_m;
}

void add_boxes(const grid::WorldGrid& world, clusterbench_grid& out) {
  out.x = world.x.data();
  out.y = world.y.data();
  out.z = world.z.data();
  for (int axis = 0; axis < 3; ++axis) out.origin[axis] = world.origin[axis];
}

void add_rotation(const Mat3d& rotation, double* out) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) out[3 * row + column] = rotation[column][row];
}

// In columns.
void add_view_from_world(const view::Space& space, double* out) {
  const Vec3d shift = -(space.rotation * space.origin);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out[4 * column + row] = space.rotation[column][row];
    out[12 + row] = shift[row];
  }
  out[15] = 1.0;
}

// In columns: x and y from -1 to 1, depth from 0 to 1.
void add_clip_from_view(const view::Projection& p, double* out) {
  const double width = p.right - p.left, height = p.top - p.bottom;
  const bool is_endless = std::isinf(p.far_m);
  const double per_depth = is_endless ? 0.0 : 1.0 / (p.far_m - p.near_m);
  out[0] = 2.0 / width;
  out[5] = 2.0 / height;
  const double x = (p.right + p.left) / width, y = (p.top + p.bottom) / height;
  if (p.orthographic) {
    out[10] = -per_depth;
    out[12] = -x;
    out[13] = -y;
    out[14] = -p.near_m * per_depth;
    out[15] = 1.0;
    return;
  }
  out[8] = x;
  out[9] = y;
  out[10] = is_endless ? -1.0 : -p.far_m * per_depth;
  out[11] = -1.0;
  out[14] = is_endless ? -p.near_m : -p.far_m * p.near_m * per_depth;
}

// The numbers before rounding, where they lie.
void add_source(const view::LightArrays& lights, clusterbench_lights& out) {
  if (lights.source.size() != lights.size() || lights.source.empty()) return;
  const scene::WorldLight& first = lights.source.front();
  out.world_stride = sizeof first;
  out.world_position = &first.position.x;
  out.world_radius = &first.range_m;
  out.world_axis = &first.direction.x;
  out.world_angle = &first.outer_cone_rad;
  out.world_half_axes = &first.half_axes_m.front().x;
}

}  // namespace

std::uint32_t bit_of(grid::Kind kind) {
  switch (kind) {
    case grid::Kind::frustum:
      return CLUSTERBENCH_FRUSTUM;
    case grid::Kind::distance:
      return CLUSTERBENCH_DISTANCE;
    case grid::Kind::cascades:
      return CLUSTERBENCH_CASCADES;
    case grid::Kind::world:
      return CLUSTERBENCH_WORLD;
  }
  return 0;
}

clusterbench_grid view_of(const grid::Grid& grid) {
  auto out = made<clusterbench_grid>();
  out.kind = bit_of(grid.kind());
  const Vec3i cells = grid.cells();
  for (int axis = 0; axis < 3; ++axis) out.cells[axis] = static_cast<std::uint32_t>(cells[axis]);
  out.cell_count = grid.cell_count();
  if (grid.has_tiles()) add_tiles(grid.screen(), out);
  if (grid.kind() == grid::Kind::world) add_boxes(grid.world(), out);
  if (grid.kind() == grid::Kind::cascades) {
    out.levels = static_cast<std::uint32_t>(grid.cascades().levels);
    out.finest = grid.cascades().finest_m;
  }
  return out;
}

std::uint32_t light_types_of(const assign::LightKinds& kinds) {
  return std::uint32_t{CLUSTERBENCH_POINTS} | (kinds.spots ? std::uint32_t{CLUSTERBENCH_SPOTS} : 0u) |
         (kinds.boxes ? std::uint32_t{CLUSTERBENCH_BOXES} : 0u);
}

clusterbench_frame view_of(const view::Frame& frame, const depth::DepthImage* depth) {
  auto out = made<clusterbench_frame>();
  for (int axis = 0; axis < 2; ++axis) out.viewport[axis] = static_cast<std::uint32_t>(frame.viewport[axis]);
  const view::Projection& projection = frame.projection;
  out.orthographic = projection.orthographic ? 1 : 0;
  out.index = frame.index;
  out.time = frame.time_s;
  out.left = projection.left;
  out.right = projection.right;
  out.bottom = projection.bottom;
  out.top = projection.top;
  out.near_plane = projection.near_m;
  out.far_plane = projection.far_m;
  for (int axis = 0; axis < 3; ++axis) out.eye[axis] = frame.view_space.origin[axis];
  add_view_from_world(frame.view_space, out.view_from_world);
  add_clip_from_view(projection, out.clip_from_view);
  if (depth != nullptr) out.depth = depth->nearest.data();
  return out;
}

clusterbench_lights view_of(const view::LightArrays& lights) {
  auto out = made<clusterbench_lights>();
  out.point_count = lights.points.count;
  out.spot_count = lights.spots.count;
  out.box_count = lights.boxes.count;
  out.x = lights.x.data();
  out.y = lights.y.data();
  out.z = lights.z.data();
  out.radius = lights.radius.data();
  out.reach = lights.reach.data();
  out.axis_x = lights.axis_x.data();
  out.axis_y = lights.axis_y.data();
  out.axis_z = lights.axis_z.data();
  out.cos_angle = lights.cos_angle.data();
  out.sin_angle = lights.sin_angle.data();
  if (!lights.half_axes.empty()) out.half_axes = &lights.half_axes.front()[0].x;
  add_source(lights, out);
  for (int axis = 0; axis < 3; ++axis) out.space_origin[axis] = lights.space.origin[axis];
  add_rotation(lights.space.rotation, out.space_rotation);
  return out;
}

}  // namespace clusterbench::plugin
