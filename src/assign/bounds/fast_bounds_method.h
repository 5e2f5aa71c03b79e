#pragma once
// What the fast forms of the methods by cell bounds share. Balls outside of the view are left out and the others' cell
// boxes found a vector at a time; their lists are made slice by slice (bounds_lists.h). Every step gives what the
// scalar method gives.

#include <memory>
#include <vector>

#include "assign/bounds/bounds_lists.h"
#include "assign/bounds/cell_bounds.h"
#include "assign/bounds/screen_bounds.h"
#include "assign/cone/spot_spheres.h"
#include "assign/contract/assigner.h"
#include "assign/contract/light_test.h"
#include "assign/rows/slice_rows.h"

namespace clusterbench::assign {

// Rows: Rows(const Params&), build(const grid::Grid&), void find(const BallBatch&, BatchRows&), capacity_bytes() const,
// k_roundings: what they lose, bool narrows() const: whether they narrow the boxes of spots, and void narrow(CellBox&,
// const geom::SphericalCone&) const.
template <class Rows>
class FastBoundsMethod final : public ListAssigner {
 public:
  explicit FastBoundsMethod(const Params& params) : test_(params, Rows::k_roundings), rows_(params), lists_(test_) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    test_.start_grid(grid, kinds);
    lists_.start_grid(grid.cells(), "tiles");
    planes_ = RowPlanes(grid.screen());
    box_planes_ = BoxPlanes(grid.screen());
    rows_.build(grid);
  }

  void assign(const FrameInput& input, Lists& out) override {
    const view::LightArrays& lights = input.lights;
    lights_ = &lights;
    test_.start_frame(lights);
    box_lights();
    lists_.start_frame(lights, out);
    lists_.add_slices(boxed_, box_planes_.slices(),
                      [&](const BallBatch& batch, BatchRows& rows) { rows_.find(batch, rows); });
    lists_.finish();
  }

  std::uint64_t tests_done() const override { return lists_.tests_done(); }
  std::size_t scratch_bytes() const override {
    return lists_.capacity_bytes() + visible_.capacity_bytes() + boxed_.capacity_bytes() + rows_.capacity_bytes() +
           test_.capacity_bytes() + spots_for_boxes_.capacity_bytes() + spots_.capacity_bytes();
  }

 private:
  void box_lights() {
    visible_.count = boxed_.count = 0;
    visible_.reserve(lights_->size());
    boxed_.reserve(lights_->size());
    box_balls(given_points(*lights_), 0, {test_.padding(k_cell_box_roundings), test_.own_padding()});
    if (lights_->spots > 0) box_spots();
  }

  void box_balls(const GivenBalls& balls, std::uint32_t first_light, const BallPadding& padding) {
    const std::uint32_t begin = visible_.count;
    see_balls(planes_, balls, first_light, visible_, padding.box + k_slice_rows_roundings);
    find_screen_bounds(box_planes_, visible_, begin, balls, first_light, padding, boxed_);
  }

  // A spot's ball for its box and the one for its rows differ in their centres, too.
  void box_spots() {
    const std::uint32_t begin = boxed_.count, points = lights_->points;
    const bool around_cones = test_.balls_are_around_cones();
    find_spot_balls(*lights_, test_.padding(k_cell_box_roundings), around_cones, spots_for_boxes_);
    find_spot_balls(*lights_, test_.own_padding(), around_cones, spots_);
    box_balls(given_spots(*lights_, spots_for_boxes_), points, {0.0f, 0.0f});
    for (std::uint32_t i = begin; i < boxed_.count; ++i) take_spot(i);
  }

  void take_spot(std::uint32_t place) {
    const std::uint32_t light = boxed_.light[place], spot = light - lights_->points;
    boxed_.x[place] = spots_.x[spot];
    boxed_.y[place] = spots_.y[spot];
    boxed_.depth[place] = -spots_.z[spot];
    boxed_.radius[place] = spots_.radius[spot];
    if (!test_.tests_cones() || !rows_.narrows()) return;
    CellBox box = boxed_.box(place);
    rows_.narrow(box, test_.cone(*lights_, light));
    boxed_.set_box(place, box);
  }

  const view::LightArrays* lights_ = nullptr;  // of the frame at hand
  LightTest test_;
  Rows rows_;
  RowPlanes planes_;
  BoxPlanes box_planes_;
  BallArrays spots_for_boxes_, spots_;
  VisibleBalls visible_;
  BoxedBalls boxed_;
  BoxedLists lists_;
};

template <class Rows>
std::unique_ptr<ListAssigner> make_fast_bounds_method(const Params& params) {
  return std::make_unique<FastBoundsMethod<Rows>>(params);
}

}  // namespace clusterbench::assign
