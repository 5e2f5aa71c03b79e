#pragma once
// The common part of the fast forms of the methods by cell bounds: the kernel of slice_by_slice.h for a frustum grid.
// Lights' boxes of cells are found a vector at a time (frustum_bounds.h); Rows finds the touched columns of a row.
// Every step has the same result as in the scalar method.

#include "assign/bounds/cell_bounds.h"
#include "assign/bounds/frustum_bounds.h"
#include "assign/pipeline/slice_by_slice.h"

namespace clusterbench::assign {

// Rows: Rows(const Params&), build(const grid::Grid&), void find(const BallBatch&, BatchRows&), capacity_bytes() const,
// k_roundoffs: their error, bool narrows() const: do they narrow the boxes of spots?, and void narrow(CellBox&, const
// geom::SphericalCone&) const.
template <class Rows>
class FrustumKernel {
 public:
  static constexpr float k_roundoffs = Rows::k_roundoffs;
  static constexpr const char* k_columns_key = "tiles";

  explicit FrustumKernel(const Params& params) : rows_(params) {}

  void build(const grid::Grid& grid) {
    bounds_.build(grid.screen());
    rows_.build(grid);
  }
  int levels() const { return 1; }
  Level level(int) const { return {bounds_.slices()}; }

  void bound(int, const KernelLights& lights, BoundedBalls& out) {
    bounds_.start_frame(lights.all.size());
    bounds_.find(given_points(lights.all), {lights.test.padding(k_cell_box_roundoffs), lights.test.own_padding()}, out);
    if (!lights.all.spots.empty()) bound_spots(lights, out);
  }
  void find_rows(int, const BallBatch& batch, BatchRows& out) { rows_.find(batch, out); }

  std::size_t capacity_bytes() const {
    return bounds_.capacity_bytes() + rows_.capacity_bytes() + spots_for_boxes_.capacity_bytes();
  }

 private:
  // A spot has different balls, with different centres, for its box and for its rows.
  void bound_spots(const KernelLights& lights, BoundedBalls& out) {
    const std::uint32_t begin = out.count;
    find_spot_balls(lights.all, lights.test.padding(k_cell_box_roundoffs), lights.test.balls_are_around_cones(),
                    spots_for_boxes_);
    bounds_.find(given_spots(lights.all, spots_for_boxes_), {0.0f, 0.0f}, out);
    for (std::uint32_t i = begin; i < out.count; ++i) add_spot(lights, i, out);
  }

  void add_spot(const KernelLights& lights, std::uint32_t ball, BoundedBalls& out) const {
    const std::uint32_t light = out.light[ball], spot = light - lights.all.spots.first;
    out.x[ball] = lights.spots.x[spot];
    out.y[ball] = lights.spots.y[spot];
    out.depth[ball] = -lights.spots.z[spot];
    out.radius[ball] = lights.spots.radius[spot];
    if (!lights.test.tests_cones() || !rows_.narrows()) return;
    CellBox box = out.box(ball);
    rows_.narrow(box, lights.test.cone(lights.all, light));
    out.set_box(ball, box);
  }

  Rows rows_;
  FrustumBounds bounds_;
  BallArrays spots_for_boxes_;
};

}  // namespace clusterbench::assign
