// Sphere refinement as in Filament's Froxelizer, with its mistakes. In each slice, the row and the column of the centre
// come from its position on the screen, which is mirrored for a centre behind the eye: this loses lights in the first
// slice. In an orthographic view all planes between tiles go through the view axis. Nothing is padded. Spots are tested
// as the ball of their range; then the sphere around each froxel's corners is tested against the endless cone.

#include <algorithm>
#include <cmath>

#include "assign/bounds/tile_planes.h"
#include "assign/contract/light_test.h"
#include "assign/grid_cull/view_cull.h"
#include "assign/pipeline/bounded_balls.h"
#include "assign/pipeline/light_by_light.h"
#include "core/arrays.h"

namespace clusterbench::assign {
namespace {

// A ball in view space that planes cut: its squared radius shrinks.
struct CutBall {
  Vec3f center;
  float squared_radius;

  bool empty() const { return !(squared_radius > 0.0f); }
};

// A position on the screen, from -1 to 1 to the right and upward within the picture.
struct Seen {
  float x, y;
};

CutBall cut(const CutBall& ball, float distance, const Vec3f& normal) {
  return {ball.center - distance * normal, ball.squared_radius - distance * distance};
}

class FilamentRefinement final : public LightByLight<FilamentRefinement> {
 public:
  explicit FilamentRefinement(const Params&) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    start_grid(grid);
    const grid::Tiles& tiles = grid.screen().tiles;
    // The planes have no offset: in an orthographic view all of them are the one through the view axis.
    columns_ = tile_planes(tiles.orthographic ? axis_only(tiles.x) : tiles.x, tiles.orthographic);
    rows_ = tile_planes(tiles.orthographic ? axis_only(tiles.y) : tiles.y, tiles.orthographic);
    view_ = ViewCull(grid.screen());
    froxel_balls_.clear();
    for (std::uint32_t cell = 0; kinds.spots && cell < grid.cell_count(); ++cell)
      froxel_balls_.push_back(ball_around_corners(grid.cell_at(cell)));
  }

  void start_frame(const view::LightArrays& lights) { check_prepared(lights, froxel_balls_); }
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    const geom::Ball ball = lights.ball(light, 0.0f);
    if (view_.misses(ball)) return;
    const CellBox box = extents(ball);
    const CutBall whole{ball.center, ball.radius * ball.radius};
    const int center_slice = slice_of(-ball.center.z);
    for (int z = box.first.z; z <= box.last.z; ++z) {
      CutBall in_slice = whole;
      ++tests_;
      if (z != center_slice) {
        const float plane = -depths()[static_cast<std::size_t>(z < center_slice ? z + 1 : z)];
        in_slice = cut(whole, whole.center.z - plane, {0, 0, 1});
      }
      if (!in_slice.empty()) add_rows(lights, light, box, in_slice, z);
    }
  }
  std::size_t own_bytes() const { return bytes_of(columns_, rows_, froxel_balls_); }

 private:
  static std::vector<float> axis_only(const std::vector<float>& boundaries) {
    return std::vector<float>(boundaries.size(), 0.0f);
  }

  const std::vector<float>& depths() const { return grid_->screen().slices.boundaries; }
  const grid::Tiles& tiles() const { return grid_->screen().tiles; }

  // The position of a point on the screen; mirrored for a point behind the eye.
  Seen on_screen(const Vec3f& p) const {
    const float w = tiles().orthographic ? 1.0f : -p.z;
    const auto across = [](float at, const std::vector<float>& sides) {
      const float from = std::min(sides.front(), sides.back()), to = std::max(sides.front(), sides.back());
      return 2.0f * (at - from) / (to - from) - 1.0f;
    };
    return {across(p.x / w, tiles().x), across(p.y / w, tiles().y)};
  }
  // Clamped to the grid.
  Vec2i tile_at(const Seen& seen) const {
    const float right = 0.5f * (seen.x + 1.0f), down = 0.5f * (1.0f - seen.y);
    const auto tile = [](float share, int pixels, float scale, int count) {
      const float at = share * static_cast<float>(pixels) * scale;
      if (!(at > 0.0f)) return 0;  // also for NaN: a point of the eye's plane on the axis
      return static_cast<int>(std::min(at, static_cast<float>(count - 1)));
    };
    return {tile(right, tiles().viewport.x, tiles().scale_x, tiles().count.x),
            tile(down, tiles().viewport.y, tiles().scale_y, tiles().count.y)};
  }
  // Clamped to the grid; the first slice for points behind the eye.
  int slice_of(float depth) const {
    int slice = 0;
    while (slice + 1 < cells_.z && depth >= depths()[static_cast<std::size_t>(slice) + 1]) ++slice;
    return slice;
  }

  // The extents of the box around the ball, from the near plane on. Its right and upper ends are never left of or below
  // the picture's middle.
  CellBox extents(const geom::Ball& ball) const {
    const float near = std::min(-depths().front(), ball.center.z + ball.radius), far = ball.center.z - ball.radius;
    constexpr float k_most = std::numeric_limits<float>::max();
    Seen least{k_most, k_most}, most{0.0f, 0.0f};
    for (const float z : {near, far})
      for (const float x : {ball.center.x - ball.radius, ball.center.x + ball.radius})
        for (const float y : {ball.center.y - ball.radius, ball.center.y + ball.radius}) {
          const Seen corner = on_screen({x, y, z});
          least = {std::min(least.x, corner.x), std::min(least.y, corner.y)};
          most = {std::max(most.x, corner.x), std::max(most.y, corner.y)};
        }
    const Vec2i bottom_left = tile_at(least), top_right = tile_at(most);
    return {{bottom_left.x, top_right.y, slice_of(-near)}, {top_right.x, bottom_left.y, slice_of(-far)}};
  }

  void add_rows(const view::LightArrays& lights, std::uint32_t light, const CellBox& box, const CutBall& ball, int z) {
    const Vec2i center = tile_at(on_screen(ball.center));
    for (int y = box.first.y; y <= box.last.y; ++y) {
      CutBall in_row = ball;
      ++tests_;
      if (y != center.y) {
        const TilePlane& plane = rows_[static_cast<std::size_t>(y < center.y ? y + 1 : y)];
        in_row = cut(ball, plane.distance(ball.center.y, -ball.center.z), {0, plane.across, -plane.along});
      }
      if (!in_row.empty()) add_columns(lights, light, box, in_row, {center.x, y, z});
    }
  }

  // From the first to the last column that the rest of the ball reaches. `at`: the centre's column, row and slice.
  void add_columns(const view::LightArrays& lights, std::uint32_t light, const CellBox& box, const CutBall& ball,
                   const Vec3i& at) {
    int first = cells_.x, last = -1;
    for (int x = box.first.x; x <= box.last.x; ++x) {
      ++tests_;
      if (x != at.x) {
        const TilePlane& plane = columns_[static_cast<std::size_t>(x < at.x ? x + 1 : x)];
        const float distance = plane.distance(ball.center.x, -ball.center.z);
        if (!(ball.squared_radius - distance * distance > 0.0f)) continue;
      }
      first = std::min(first, x);
      last = std::max(last, x);
    }
    if (first > last) return;
    const std::uint32_t begin = index_of({first, at.y, at.z}), count = static_cast<std::uint32_t>(last - first + 1);
    if (!lights.is_spot(light)) return pairs_.add_row(begin, count, light);
    const geom::SphericalCone cone = lights.cone(light, 0.0f);
    for (std::uint32_t cell = begin; cell < begin + count; ++cell)
      if (touches(cone, froxel_balls_[cell])) pairs_.add(cell, light);
  }

  // Against the endless cone: its apex is moved back until the ball touches the cone if its centre lies within. Half
  // angles are at least half a degree.
  bool touches(const geom::SphericalCone& cone, const geom::Ball& ball) {
    constexpr float k_least_sine = 0.00872653f, k_most_squared_cosine = 0.99992385f;
    ++tests_;
    const Vec3f moved = cone.apex - ball.radius / std::max(cone.sin_angle, k_least_sine) * cone.axis;
    const Vec3f way = ball.center - moved;
    const float along = glm::dot(cone.axis, way);
    const float squared_cosine = std::min(cone.cos_angle * cone.cos_angle, k_most_squared_cosine);
    return along > 0.0f && along * along >= glm::dot(way, way) * squared_cosine;
  }

  // Around the mean of the corners, up to the farthest one. The first slice begins at the eye; the corners of an
  // orthographic view are where its planes meet, on the view axis.
  geom::Ball ball_around_corners(const Vec3i& at) const {
    const auto x = static_cast<std::size_t>(at.x), z = static_cast<std::size_t>(at.z);
    const float near = at.z == 0 ? 0.0f : depths()[z], far = depths()[z + 1];
    Vec3f corners[8], sum(0.0f);
    int count = 0;
    for (const float depth : {near, far})
      for (const float across : {tiles().x[x], tiles().x[x + 1]})
        for (const float up : {tiles().y_min(at.y), tiles().y_max(at.y)}) {
          const float size = tiles().orthographic ? 0.0f : depth;
          corners[count] = {across * size, up * size, -depth};
          sum += corners[count++];
        }
    geom::Ball ball{sum / 8.0f, 0.0f};
    for (const Vec3f& corner : corners) ball.radius = std::max(ball.radius, glm::length(corner - ball.center));
    return ball;
  }

  std::vector<TilePlane> columns_, rows_;
  std::vector<geom::Ball> froxel_balls_;
  ViewCull view_;
};

}  // namespace

extern const AssignerDescriptor filament_refinement_descriptor;
const AssignerDescriptor filament_refinement_descriptor{
    .name = "filament-refinement",
    .summary =
        "sphere refinement that mirrors centres behind the eye; spots by froxels' spheres against the endless cone",
    .source = "Filament's Froxelizer (2026), which loses lights",
    .kinds = {grid::Kind::frustum},
    .conservative = false,
    .naive = true,
    .by_name = true,
    .params = {},
    .make = make_list_assigner<FilamentRefinement>,
};

}  // namespace clusterbench::assign
