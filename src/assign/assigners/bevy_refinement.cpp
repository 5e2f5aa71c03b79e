// Sphere refinement as in Bevy's CPU clustering. The row of the ball's centre is found once, on the screen, and not
// again after the projection onto the slice, which loses lights. A row that is reached has at least one column. Spots
// are tested as the ball of their range; then the sphere around each cell's bounding box is tested against the cone.

#include <cmath>
#include <limits>
#include <utility>

#include "assign/bounds/tile_planes.h"
#include "assign/contract/light_test.h"
#include "assign/grid_cull/view_cull.h"
#include "assign/pipeline/bounded_balls.h"
#include "assign/pipeline/light_by_light.h"
#include "core/arrays.h"
#include "geom/single_precision/bounding_volumes.h"
#include "grid/index_range.h"

namespace clusterbench::assign {
namespace {

struct Refined {
  Vec3f center;
  float radius;
};

// The circle in which a ball meets a plane at this distance from its centre, as a ball; false if they do not meet.
bool project(Refined& ball, float distance, const Vec3f& normal) {
  if (std::abs(distance) > ball.radius) return false;
  ball.center -= distance * normal;
  ball.radius = std::sqrt(ball.radius * ball.radius - distance * distance);
  return true;
}

class BevyRefinement final : public LightByLight<BevyRefinement> {
 public:
  explicit BevyRefinement(const Params&) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    start_grid(grid);
    const grid::ScreenGrid& screen = grid.screen();
    columns_ = tile_planes(screen.tiles.x, screen.tiles.orthographic);
    rows_ = tile_planes(screen.tiles.y, screen.tiles.orthographic);
    view_ = ViewCull(screen);
    cell_balls_.clear();
    if (!kinds.spots) return;
    for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
      const geom::Box box = geom::box_around(grid.cell(cell));
      cell_balls_.push_back({0.5f * (box.lo + box.hi), 0.5f * glm::length(box.hi - box.lo)});
    }
  }

  void start_frame(const view::LightArrays& lights) { check_prepared(lights, cell_balls_); }
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    const geom::Ball ball = lights.ball(light, 0.0f);
    if (view_.misses(ball)) return;
    const CellBox box = extents(ball);
    const int center_slice = slice_of(-ball.center.z), center_row = row_of(ball.center);
    for (int z = box.first.z; z <= box.last.z; ++z) {
      Refined in_slice{ball.center, ball.radius};
      ++tests_;
      if (z != center_slice) {
        const float plane = -depths()[static_cast<std::size_t>(z < center_slice ? z + 1 : z)];
        if (!project(in_slice, in_slice.center.z - plane, {0, 0, 1})) continue;
      }
      for (int y = box.first.y; y <= box.last.y; ++y) {
        Refined in_row = in_slice;
        ++tests_;
        if (y != center_row) {
          const TilePlane& plane = rows_[static_cast<std::size_t>(y < center_row ? y + 1 : y)];
          const Vec3f normal{0, plane.across, -plane.along};
          if (!project(in_row, plane.distance(in_row.center.y, -in_row.center.z), normal)) continue;
        }
        add_columns(lights, light, box, in_row, y, z);
      }
    }
  }
  std::size_t own_bytes() const { return bytes_of(columns_, rows_, cell_balls_); }

 private:
  // The cells of the box around the ball; its sides are projected to the screen at its near and its far end. Clamped to
  // the grid.
  CellBox extents(const geom::Ball& ball) const {
    const float depth = -ball.center.z, r = ball.radius, least = std::numeric_limits<float>::min();
    const float near = std::max(least, depth - r), far = std::max(least, depth + r);
    const bool orthographic = grid_->screen().tiles.orthographic;
    const auto on_screen = [&](float middle) {
      if (orthographic) return std::pair(middle - r, middle + r);
      return std::pair(std::min((middle - r) / near, (middle - r) / far),
                       std::max((middle + r) / near, (middle + r) / far));
    };
    const auto clamped = [](float value, const std::vector<float>& boundaries) {
      const auto [least_of, most_of] = std::minmax(boundaries.front(), boundaries.back());
      return std::clamp(value, least_of, most_of);
    };
    const grid::Tiles& tiles = grid_->screen().tiles;
    const auto [left, right] = on_screen(ball.center.x);
    const auto [bottom, top] = on_screen(ball.center.y);
    const grid::IndexRange x = grid::intervals_touched(tiles.x, clamped(left, tiles.x), clamped(right, tiles.x));
    const grid::IndexRange y =
        grid::descending_intervals_touched(tiles.y, clamped(bottom, tiles.y), clamped(top, tiles.y));
    const grid::IndexRange z =
        grid::intervals_touched(depths(), clamped(depth - r, depths()), clamped(depth + r, depths()));
    return {{x.first, y.first, z.first}, {x.last, y.last, z.last}};
  }

  const std::vector<float>& depths() const { return grid_->screen().slices.boundaries; }

  // None (-1) between the eye and the near end; the first slice behind the eye, the last slice beyond the far end.
  int slice_of(float depth) const {
    if (depth < 0.0f && !grid_->screen().tiles.orthographic) return 0;
    int after = 0;
    while (after < cells_.z && depth >= depths()[static_cast<std::size_t>(after)]) ++after;
    return after - 1;
  }

  // The row of the centre on the screen, which is upside down for a centre behind the eye. None (-1) above the screen,
  // one too many below it.
  int row_of(const Vec3f& center) const {
    const bool orthographic = grid_->screen().tiles.orthographic;
    const float at = orthographic ? center.y : center.y / -center.z;
    const std::vector<float>& rows = grid_->screen().tiles.y;  // descending
    int after = 0;
    while (after <= cells_.y && at <= rows[static_cast<std::size_t>(after)]) ++after;
    return after - 1;
  }

  // From both ends inward, until a column is reached or one column is left.
  void add_columns(const view::LightArrays& lights, std::uint32_t light, const CellBox& box, const Refined& ball, int y,
                   int z) {
    const auto beyond = [&](int plane) {
      ++tests_;
      return columns_[static_cast<std::size_t>(plane)].distance(ball.center.x, -ball.center.z);
    };
    int first = box.first.x, last = box.last.x;
    while (first < last && !(ball.radius - beyond(first + 1) > 0.0f)) ++first;
    while (last > first && !(ball.radius + beyond(last) > 0.0f)) --last;
    const std::uint32_t begin = index_of({first, y, z}), count = static_cast<std::uint32_t>(last - first + 1);
    if (!lights.is_spot(light)) return pairs_.add_row(begin, count, light);
    const geom::SphericalCone cone = lights.cone(light, 0.0f);
    for (std::uint32_t cell = begin; cell < begin + count; ++cell)
      if (touches(cone, cell_balls_[cell])) pairs_.add(cell, light);
  }

  bool touches(const geom::SphericalCone& cone, const geom::Ball& ball) {
    ++tests_;
    const Vec3f v = ball.center - cone.apex;
    const float along = glm::dot(v, cone.axis), squared = glm::dot(v, v);
    const float away = cone.cos_angle * std::sqrt(std::max(0.0f, squared - along * along)) - along * cone.sin_angle;
    return away <= ball.radius && along <= ball.radius + cone.range && along >= -ball.radius;
  }

  std::vector<TilePlane> columns_, rows_;
  std::vector<geom::Ball> cell_balls_;
  ViewCull view_;
};

}  // namespace

extern const AssignerDescriptor bevy_refinement_descriptor;
const AssignerDescriptor bevy_refinement_descriptor{
    .name = "bevy-refinement",
    .summary = "sphere refinement with the centre's row taken once; spots by cells' spheres against the cone",
    .source = "Bevy's clusters on the CPU (early 2026), which lose lights as naive-refinement does",
    .kinds = {grid::Kind::frustum},
    .conservative = false,
    .naive = true,
    .by_name = true,
    .params = {},
    .make = make_list_assigner<BevyRefinement>,
};

}  // namespace clusterbench::assign
