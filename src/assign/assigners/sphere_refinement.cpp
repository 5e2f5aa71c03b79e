// Sphere refinement of a frustum grid. For each slice in a light's cell box the ball is replaced by a smaller one
// around its part beyond the slice's nearer plane; for each row that ball is replaced again at the row's nearer plane;
// the columns that the rest reaches are the row's interval. Both planes of a column are tested, each once from either
// end: with one plane alone, as in Persson, a rest behind the eye fills rows that it lies beside (855 false positives
// in place of 691 for 512 lights of 13 m). Engines test one plane (Filament): `columns` = nearest. That is the plane
// towards the column of the ball that the slice has left, and that column itself is always accepted.
//
// Beyond a plane at distance g from its centre, a ball of radius r lies within the ball around the centre's foot on the
// plane with radius sqrt(r² - g²). The sides of the row's planes are tested with the centre after the slice's plane has
// moved it: the original centre's row would project onto the wrong plane and lose lights.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "assign/bounds/cell_bounds.h"
#include "assign/bounds/refinement.h"
#include "assign/bounds/tile_planes.h"
#include "assign/contract/light_test.h"
#include "assign/grid_cull/view_cull.h"
#include "assign/pipeline/light_by_light.h"
#include "core/arrays.h"

namespace clusterbench::assign {
namespace {

// A ball in view space with its squared radius, which shrinks with each cut.
struct Remainder {
  float x, y, depth, squared_radius;

  bool empty() const { return squared_radius < 0.0f; }
};

Remainder cut_to_slice(Remainder ball, float depth0, float depth1) {
  const float nearer = std::clamp(ball.depth, depth0, depth1);
  const float gap = nearer - ball.depth;
  return {ball.x, ball.y, nearer, ball.squared_radius - gap * gap};
}

// The part between the planes of a row; `above`, `above_bottom`: the signed distances of the ball's centre from them.
Remainder cut_to_row(const Remainder& ball, const TilePlane& top, float above, const TilePlane& bottom,
                     float above_bottom) {
  const float below = -above_bottom;
  if (above > 0.0f)
    return {ball.x, ball.y - above * top.across, ball.depth - above * top.along, ball.squared_radius - above * above};
  if (below > 0.0f)
    return {ball.x, ball.y + below * bottom.across, ball.depth + below * bottom.along,
            ball.squared_radius - below * below};
  return ball;
}

// From the distances to the column's planes.
bool reaches_column(const Remainder& ball, float from_left, float from_right) {
  const float gap = std::max(-from_left, from_right);
  return gap <= 0.0f || gap * gap <= ball.squared_radius;
}

// The parameters may be those of the fast form, which has no `columns`.
bool by_nearest_plane(const Params& params) {
  const auto found = params.values().find("columns");
  return found != params.values().end() && found->second == ParamValue(std::string("nearest"));
}

class SphereRefinement final : public LightByLight<SphereRefinement> {
 public:
  explicit SphereRefinement(const Params& params)
      : test_(params, k_refinement_roundoffs), narrowing_(narrows(params)), by_nearest_(by_nearest_plane(params)) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    start_grid(grid);
    const grid::Tiles& tiles = grid.screen().tiles;
    columns_ = tile_planes(tiles.x, tiles.orthographic);
    rows_ = tile_planes(tiles.y, tiles.orthographic);
    view_ = ViewCull(grid.screen());
    test_.start_grid(grid, kinds);
  }

  void start_frame(const view::LightArrays& lights) { test_.start_frame(lights); }
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    const geom::Ball for_box = test_.ball(lights, light, k_cell_box_roundoffs);
    if (view_.misses(for_box)) return;
    CellBox box = cell_box(*grid_, for_box);
    if (box.empty()) return;
    const TestedLight tested = test_.tested(lights, light);
    if (tested.has_cone && narrowing_)
      narrow_from_six_sides(box, tested.cone, grid_->screen().slices.boundaries, columns_, rows_);
    if (!box.empty()) add_ball(box, tested);
  }
  std::size_t own_bytes() const { return test_.capacity_bytes() + bytes_of(columns_, rows_); }

 private:
  void add_ball(const CellBox& box, const TestedLight& light) {
    const std::vector<float>& depths = grid_->screen().slices.boundaries;
    const geom::Ball& ball = light.ball;
    const Remainder whole{ball.center.x, ball.center.y, -ball.center.z, ball.radius * ball.radius};
    for (int slice = box.first.z; slice <= box.last.z; ++slice) {
      const auto z = static_cast<std::size_t>(slice);
      const Remainder in_slice = cut_to_slice(whole, depths[z], depths[z + 1]);
      ++tests_;
      if (!in_slice.empty()) add_rows(box, in_slice, slice, light);
    }
  }

  // A row's bottom plane is the next row's top plane.
  void add_rows(const CellBox& box, const Remainder& ball, int slice, const TestedLight& light) {
    const TilePlane* planes = rows_.data();
    const int center = by_nearest_ ? column_of(ball) : k_no_column;
    float above = planes[box.first.y].distance(ball.y, ball.depth);
    for (int row = box.first.y; row <= box.last.y; ++row) {
      const float above_bottom = planes[row + 1].distance(ball.y, ball.depth);
      const Remainder in_row = cut_to_row(ball, planes[row], above, planes[row + 1], above_bottom);
      ++tests_;
      if (!in_row.empty()) add_columns(box, in_row, center, {slice, row}, light);
      above = above_bottom;
    }
  }

  // The last column whose left plane is not right of the centre; may be before the first or after the last column.
  int column_of(const Remainder& ball) const {
    const auto is_right_of = [&](const TilePlane& plane) { return plane.distance(ball.x, ball.depth) >= 0.0f; };
    return static_cast<int>(std::ranges::count_if(columns_, is_right_of)) - 1;
  }

  struct RowAt {
    int slice, row;
  };

  // `center`: the centre's column, for by_nearest_; k_no_column: both planes of each column are tested.
  void add_columns(const CellBox& box, const Remainder& ball, int center, RowAt at, const TestedLight& light) {
    const auto distance = [&](int plane) {
      return columns_[static_cast<std::size_t>(plane)].distance(ball.x, ball.depth);
    };
    int first = box.first.x, last = box.last.x;
    float left = distance(first), right = distance(first + 1);
    const auto misses = [&](int column) {
      ++tests_;
      if (center == k_no_column) return !reaches_column(ball, left, right);
      const float gap = column > center ? -left : column < center ? right : 0.0f;
      return gap > 0.0f && gap * gap > ball.squared_radius;
    };
    while (misses(first)) {
      if (++first > last) return;
      left = right;
      right = distance(first + 1);
    }
    if (last > first) {
      right = distance(last + 1);
      left = distance(last);
    }
    while (last > first && misses(last)) {
      right = left;
      left = distance(--last);
    }
    test_.add_row(light, index_of({first, at.row, at.slice}), static_cast<std::uint32_t>(last - first + 1), pairs_,
                  tests_);
  }

  static constexpr int k_no_column = std::numeric_limits<int>::min();

  LightTest test_;
  bool narrowing_, by_nearest_;
  ViewCull view_;
  std::vector<TilePlane> columns_, rows_;
};

std::vector<ParamSpec> scalar_params() {
  std::vector<ParamSpec> params = refinement_params();
  params.push_back({.name = "columns",
                    .summary =
                        "by which planes a column is tested. both: its left and its right one; nearest: the one "
                        "towards the centre of what is left of the sphere, whose column is always taken (Filament)",
                    .default_value = std::string("both"),
                    .unit = "",
                    .choices = {"both", "nearest"},
                    .is_late = true});
  return params;
}

}  // namespace

extern const AssignerDescriptor sphere_refinement_descriptor;
const AssignerDescriptor sphere_refinement_descriptor{
    .name = "sphere-refinement",
    .summary = "a light's sphere cut down at the nearer plane of each slice and each row, then against the columns",
    .source =
        "Persson 2015, Practical Clustered Shading, made conservative: sides are taken again after each cut, by both "
        "planes of a row and a column, without a logarithm (Filament takes row and column again per slice, Bevy its "
        "centre row once)",
    .kinds = {grid::Kind::frustum},
    .params = scalar_params(),
    .make = make_list_assigner<SphereRefinement>,
};

}  // namespace clusterbench::assign
