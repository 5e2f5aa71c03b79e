// Roundoffs: of the tests the one against a box has the largest error (CellAabbs); extents and depth - r, depth + r
// lose one.

#include "assign/occupied/occupied_method.h"

#include <cmath>
#include <limits>

#include "core/memory.h"
#include "geom/single_precision/bounding_volumes.h"
#include "geom/single_precision/touch_tests.h"

namespace clusterbench::assign {

grid::Grid tiles_of(const grid::Grid& grid) {
  grid::ScreenGrid tiles = grid.screen();
  tiles.slices.boundaries = {tiles.slices.boundaries.front(), std::numeric_limits<float>::max()};
  return {tiles};
}

ParamSpec tile_test_param() {
  return {.name = "test",
          .summary =
              "the sides of the tile's frustum (as the light's extents on the screen), the box around the part "
              "between its depths, or both; depth in any case",
          .default_value = std::string("both"),
          .unit = "",
          .choices = {"planes", "aabb", "both"}};
}

std::vector<ParamSpec> tiled_params() {
  std::vector<ParamSpec> params{tile_test_param()};
  for (ParamSpec& param : light_params()) params.push_back(std::move(param));
  return params;
}

OccupiedMethod::OccupiedMethod(const Params& params, CellBounds bounds, EndOfParts end)
    : test_(params, CellAabbs::k_roundoffs), bounds_(bounds), end_(end) {
  if (has_slices(bounds)) return;
  by_planes_ = params.text("test") != "aabb";
  by_boxes_ = params.text("test") != "planes";
}

void OccupiedMethod::build(const grid::Grid& grid, const LightKinds&) {
  grid_ = &grid;
  extents_ = has_slices(bounds_) ? grid : tiles_of(grid);
  cells_ = extents_.cells();
  view_ = ViewCull(extents_.screen());
  pixels_.build(grid.screen());
  check_memory("boxes and spheres around cells", extents_.cell_count(), sizeof(geom::Box) + sizeof(geom::Ball));
  boxes_.resize(extents_.cell_count());
  balls_.resize(extents_.cell_count());
  if (bounds_ != CellBounds::cell) return;
  for (std::uint32_t cell = 0; cell < extents_.cell_count(); ++cell)
    boxes_[cell] = geom::box_around(std::get<geom::FrustumCell>(grid.cell(cell)));
  balls_ = grid.balls_around_cells();
}

std::size_t OccupiedMethod::scratch_bytes() const {
  return pixels_.capacity_bytes() + frame_cells_.capacity_bytes() +
         bytes_of(boxes_, balls_, parts_, late_parts_, late_masks_) + pairs_.capacity_bytes() +
         bytes_of(lists_.begin, lists_.lights);
}

void OccupiedMethod::fill(const FrameInput& input, OccupiedLists& out) {
  const view::LightArrays& lights = input.lights;
  tests_ = 0;
  find_cells(checked(input.depth, grid_->screen().tiles));
  if (bounds_ != CellBounds::cell) bound_cells(!lights.spots.empty() && test_.tests_cones());
  pairs_.start(extents_.cell_count());
  for (std::uint32_t light = 0; light < lights.size(); ++light)
    if (!lights.is_empty(light)) add_light(lights, light);
  pairs_.finish(lists_);
  out.store(*grid_, bounds_, frame_cells_, lists_, lights);
}

void OccupiedMethod::find_cells(const depth::DepthImage& image) {
  if (has_slices(bounds_))
    pixels_.find_in_cells(image, frame_cells_.depths);
  else
    pixels_.find_in_tiles(image, frame_cells_.depths);
  if (bounds_ == CellBounds::masked_tile) find_masks(image);
}

namespace {

// The bits of all pixels, tile by tile.
template <class Parts>
void mark_pixels(const PixelDepths& pixels, const depth::DepthImage& image, const std::vector<Parts>& parts,
                 std::vector<std::uint32_t>& masks) {
  masks.assign(parts.size(), 0);
  pixels.each_row(image, [&](std::size_t tile, const float* depth, const float* end) {
    const Parts of_tile = parts[tile];
    std::uint32_t mask = 0;
    for (; depth < end; ++depth) mask |= *depth < std::numeric_limits<float>::infinity() ? of_tile.bit_of(*depth) : 0;
    masks[tile] |= mask;
  });
}

}  // namespace

void OccupiedMethod::find_masks(const depth::DepthImage& image) {
  const DepthRanges& depths = frame_cells_.depths;
  parts_.clear();
  for (std::size_t tile = 0; tile < depths.size(); ++tile) parts_.emplace_back(depths.lo[tile], depths.hi[tile]);
  mark_pixels(pixels_, image, parts_, frame_cells_.masks);
  if (end_ == EndOfParts::part_31) return;
  late_parts_.clear();
  for (std::size_t tile = 0; tile < depths.size(); ++tile)  // up to the farthest pixel itself
    late_parts_.emplace_back(depths.lo[tile], std::nextafter(depths.hi[tile], -std::numeric_limits<float>::infinity()));
  mark_pixels(pixels_, image, late_parts_, late_masks_);
}

bool OccupiedMethod::meets_mask(std::uint32_t tile, float near, float far) const {
  return ((end_ == EndOfParts::part_31 ? parts_[tile].bits_between(near, far) & frame_cells_.masks[tile]
                                       : late_parts_[tile].bits_between(near, far) & late_masks_[tile]) != 0);
}

void OccupiedMethod::bound_cells(bool with_balls) {
  const DepthRanges& depths = frame_cells_.depths;
  for (std::uint32_t cell = 0; cell < extents_.cell_count(); ++cell) {
    if (depths.empty(cell)) continue;
    geom::FrustumCell part = std::get<geom::FrustumCell>(extents_.cell(cell));
    part.depth0 = depths.lo[cell];
    part.depth1 = depths.hi[cell];
    if (by_boxes_) boxes_[cell] = geom::box_around(part);
    if (with_balls) balls_[cell] = geom::ball_around(part);
  }
}

CellBox OccupiedMethod::candidate_cells(const view::LightArrays& lights, std::uint32_t light) const {
  const geom::Ball ball = test_.ball(lights, light, k_cell_box_roundoffs);
  if (view_.misses(ball)) return {};
  return by_planes_ ? cell_box(extents_, ball) : CellBox{Vec3i(0), cells_ - 1};
}

void OccupiedMethod::add_light(const view::LightArrays& lights, std::uint32_t light) {
  const CellBox box = candidate_cells(lights, light);
  if (box.empty()) return;
  const TestedLight tested = test_.tested(lights, light);
  for (int z = box.first.z; z <= box.last.z; ++z)
    for (int y = box.first.y; y <= box.last.y; ++y)
      for (int x = box.first.x; x <= box.last.x; ++x) {
        const std::uint32_t cell = grid::cell_index({x, y, z}, cells_);
        if (frame_cells_.depths.empty(cell)) continue;
        ++tests_;
        if (touches(tested, cell)) pairs_.add(cell, light);
      }
}

bool OccupiedMethod::touches(const TestedLight& light, std::uint32_t cell) const {
  const DepthRanges& depths = frame_cells_.depths;
  const float depth = -light.ball.center.z, near = depth - light.ball.radius, far = depth + light.ball.radius;
  if (bounds_ != CellBounds::cell) {
    if (!(near <= depths.hi[cell] && far >= depths.lo[cell])) return false;
    if (bounds_ == CellBounds::masked_tile && !meets_mask(cell, near, far)) return false;
  }
  if (by_boxes_ && !geom::ball_touches_box(light.ball, boxes_[cell])) return false;
  return !light.has_cone || geom::cone_touches_ball(light.cone, balls_[cell]);
}

}  // namespace clusterbench::assign
