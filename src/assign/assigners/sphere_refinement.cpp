// Sphere refinement of a frustum grid. For each slice in a light's cell box the ball is replaced by a smaller one that
// holds its part beyond the slice's nearer plane; for each row that one is replaced again at the row's nearer plane;
// the columns that the rest reaches are the row's interval.
//
// Beyond a plane at distance g from its centre, a ball of radius r lies within the ball around the centre's foot on the
// plane with radius sqrt(r² - g²). The sides of the row's planes are taken with the centre where the slice's plane has
// moved it: with the original centre's row a projection goes to the wrong plane and loses lights.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "assign/assigner.h"
#include "assign/cell_box.h"
#include "assign/light_test.h"
#include "assign/refinement.h"
#include "assign/tile_planes.h"

namespace clusterbench::assign {
namespace {

// A ball in view space with its squared radius, which shrinks by what is cut off.
struct Remainder {
  float x, y, depth, squared_radius;

  bool empty() const { return squared_radius < 0.0f; }
};

Remainder cut_to_slice(Remainder ball, float depth0, float depth1) {
  const float nearer = std::clamp(ball.depth, depth0, depth1);
  const float gap = nearer - ball.depth;
  return {ball.x, ball.y, nearer, ball.squared_radius - gap * gap};
}

Remainder cut_to_row(Remainder ball, const TilePlane& top, const TilePlane& bottom) {
  const float above = top.distance(ball.y, ball.depth), below = -bottom.distance(ball.y, ball.depth);
  if (above > 0.0f)
    return {ball.x, ball.y - above * top.across, ball.depth - above * top.along, ball.squared_radius - above * above};
  if (below > 0.0f)
    return {ball.x, ball.y + below * bottom.across, ball.depth + below * bottom.along,
            ball.squared_radius - below * below};
  return ball;
}

bool reaches_column(const Remainder& ball, const TilePlane& left, const TilePlane& right) {
  const float gap = std::max(-left.distance(ball.x, ball.depth), right.distance(ball.x, ball.depth));
  return gap <= 0.0f || gap * gap <= ball.squared_radius;
}

class SphereRefinement final : public Assigner {
 public:
  explicit SphereRefinement(const Params& params)
      : test_(params, k_refinement_roundings), narrowing_(narrows(params)) {}

  void build(const grid::Grid& grid) override {
    grid_ = &grid;
    const grid::Tiles& tiles = grid.screen().tiles;
    columns_ = tile_planes(tiles.x, tiles.orthographic);
    rows_ = tile_planes(tiles.y, tiles.orthographic);
    test_.start_grid(grid);
  }

  void assign(const view::LightArrays& lights, Lists& out) override {
    tests_ = 0;
    test_.start_frame(lights);
    pairs_.start(grid_->cell_count());
    for (std::uint32_t light = 0; light < lights.size(); ++light) add_light(lights, light);
    pairs_.finish(out);
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override {
    return pairs_.capacity_bytes() + test_.capacity_bytes() +
           (columns_.capacity() + rows_.capacity()) * sizeof(TilePlane);
  }

 private:
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    if (lights.is_empty(light)) return;
    const TestedLight tested = test_.tested(lights, light);
    CellBox box = cell_box(*grid_, test_.ball(lights, light, k_cell_box_roundings));
    if (tested.has_cone && narrowing_ && !box.empty())
      narrow_from_six_sides(box, tested.cone, grid_->screen().slices.boundaries, columns_, rows_);
    if (!box.empty()) add_ball(box, tested);
  }

  void add_ball(const CellBox& box, const TestedLight& light) {
    const std::vector<float>& depths = grid_->screen().slices.boundaries;
    const geom::Ball& ball = light.ball;
    const Remainder whole{ball.center.x, ball.center.y, -ball.center.z, ball.radius * ball.radius};
    for (int slice = box.first.z; slice <= box.last.z; ++slice) {
      const auto z = static_cast<std::size_t>(slice);
      const Remainder in_slice = cut_to_slice(whole, depths[z], depths[z + 1]);
      ++tests_;
      if (in_slice.empty()) continue;
      for (int row = box.first.y; row <= box.last.y; ++row) {
        const auto y = static_cast<std::size_t>(row);
        const Remainder in_row = cut_to_row(in_slice, rows_[y], rows_[y + 1]);
        ++tests_;
        if (!in_row.empty()) add_columns(box, in_row, slice, row, light);
      }
    }
  }

  void add_columns(const CellBox& box, const Remainder& ball, int slice, int row, const TestedLight& light) {
    const auto reached = [&](int column) {
      ++tests_;
      const auto x = static_cast<std::size_t>(column);
      return reaches_column(ball, columns_[x], columns_[x + 1]);
    };
    int first = box.first.x, last = box.last.x;
    while (first <= last && !reached(first)) ++first;
    while (last > first && !reached(last)) --last;
    if (first > last) return;
    const Vec2i count = grid_->screen().tiles.count;
    const auto row_start = static_cast<std::uint32_t>((slice * count.y + row) * count.x);
    test_.add_row(light, row_start + static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first + 1),
                  pairs_, tests_);
  }

  LightTest test_;
  bool narrowing_;
  const grid::Grid* grid_ = nullptr;
  std::vector<TilePlane> columns_, rows_;
  PairBuffer pairs_;
  std::uint64_t tests_ = 0;
};

std::unique_ptr<Assigner> make(const Params& params) {
  return std::make_unique<SphereRefinement>(params);
}

}  // namespace

extern const AssignerRow sphere_refinement_row;
const AssignerRow sphere_refinement_row{
    .name = "sphere-refinement",
    .summary = "a light's ball cut down at the nearer plane of each slice and each row, then against the columns",
    .source = "Persson 2015, Practical Clustered Shading; Filament's froxels",
    .kinds = {grid::Kind::frustum},
    .params = refinement_params(),
    .make = make,
};

}  // namespace clusterbench::assign
