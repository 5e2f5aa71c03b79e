// Sphere refinement with its usual mistakes: the row and the column of the centre are found once, from the whole ball,
// and not again after each projection; nothing is padded. A spot is tested as its bounding ball.

#include <algorithm>
#include <cmath>

#include "assign/bounds/cell_bounds.h"
#include "assign/bounds/tile_planes.h"
#include "assign/pipeline/light_by_light.h"
#include "core/arrays.h"

namespace clusterbench::assign {
namespace {

struct NaiveRemainder {
  float x, y, depth, squared_radius;
};

class NaiveRefinement final : public LightByLight<NaiveRefinement> {
 public:
  explicit NaiveRefinement(const Params&) {}

  void build(const grid::Grid& grid, const LightKinds&) override {
    start_grid(grid);
    columns_ = tile_planes(grid.screen().tiles.x, grid.screen().tiles.orthographic);
    rows_ = tile_planes(grid.screen().tiles.y, grid.screen().tiles.orthographic);
  }

  void start_frame(const view::LightArrays&) {}
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    add_ball(lights.bounding_ball(light, 0.0f), light);
  }
  std::size_t own_bytes() const { return bytes_of(columns_, rows_); }

 private:
  void add_ball(const geom::Ball& ball, std::uint32_t light) {
    const CellBox box = cell_box(*grid_, ball);
    if (box.empty()) return;
    const std::vector<float>& depths = grid_->screen().slices.boundaries;
    const NaiveRemainder whole{ball.center.x, ball.center.y, -ball.center.z, ball.radius * ball.radius};
    const Vec2i center = center_tile(whole);
    for (int slice = box.first.z; slice <= box.last.z; ++slice) {
      NaiveRemainder in_slice = whole;
      const auto z = static_cast<std::size_t>(slice);
      in_slice.depth = std::clamp(whole.depth, depths[z], depths[z + 1]);
      in_slice.squared_radius -= (in_slice.depth - whole.depth) * (in_slice.depth - whole.depth);
      if (in_slice.squared_radius < 0.0f) continue;
      for (int row = box.first.y; row <= box.last.y; ++row) add_row(box, in_slice, center, slice, row, light);
    }
  }

  // The tile of the whole ball's centre; beyond the screen's edge, the tile just outside.
  Vec2i center_tile(const NaiveRemainder& ball) const {
    Vec2i tile{-1, -1};
    while (tile.x + 1 < static_cast<int>(columns_.size()) && column(tile.x + 1).distance(ball.x, ball.depth) >= 0.0f)
      ++tile.x;
    while (tile.y + 1 < static_cast<int>(rows_.size()) && row(tile.y + 1).distance(ball.y, ball.depth) <= 0.0f)
      ++tile.y;
    return tile;
  }

  void add_row(const CellBox& box, NaiveRemainder ball, Vec2i center, int slice, int y, std::uint32_t light) {
    ++tests_;
    if (y != center.y) {
      const TilePlane& plane = y > center.y ? row(y) : row(y + 1);
      const float away = plane.distance(ball.y, ball.depth);
      ball.y -= away * plane.across;
      ball.depth -= away * plane.along;
      ball.squared_radius -= away * away;
      if (ball.squared_radius < 0.0f) return;
    }
    const auto misses = [&](int x) {
      ++tests_;
      if (x == center.x) return false;
      const float away = (x > center.x ? column(x) : column(x + 1)).distance(ball.x, ball.depth);
      return away * away > ball.squared_radius;
    };
    int first = box.first.x, last = box.last.x;
    while (first <= last && first < center.x && misses(first)) ++first;
    while (last >= first && last > center.x && misses(last)) --last;
    if (first > last) return;
    pairs_.add_row(index_of({first, y, slice}), static_cast<std::uint32_t>(last - first + 1), light);
  }

  const TilePlane& column(int i) const { return columns_[static_cast<std::size_t>(i)]; }
  const TilePlane& row(int i) const { return rows_[static_cast<std::size_t>(i)]; }

  std::vector<TilePlane> columns_, rows_;
};

}  // namespace

extern const AssignerDescriptor naive_refinement_descriptor;
const AssignerDescriptor naive_refinement_descriptor{
    .name = "naive-refinement",
    .summary = "sphere refinement that does not take the centre's row and column again after each projection",
    .source = "Persson 2015 as commonly read; Bevy's clusters, which take the centre row once",
    .kinds = {grid::Kind::frustum},
    .conservative = false,
    .naive = true,
    .params = {},
    .make = make_list_assigner<NaiveRefinement>,
};

}  // namespace clusterbench::assign
