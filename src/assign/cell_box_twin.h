#pragma once
// What the fast twins of the cell box methods share. Balls outside of the view are left out and the others' cell boxes
// found a vector at a time; slice by slice the rows of many balls are found at once, one ball per lane; a slice's lists
// are built by compression while its spans are in the cache. Spots' cells are then tested by their cones a vector of
// cells at a time. Every step gives what the scalar method gives.

#include <bit>
#include <memory>
#include <string>
#include <vector>

#include "assign/assigner.h"
#include "assign/cell_box.h"
#include "assign/light_test.h"
#include "assign/simd/boxed_rows.h"
#include "assign/simd/cell_boxes.h"
#include "assign/simd/lit_cells.h"
#include "assign/simd/slice_balls.h"
#include "assign/simd/slice_rows.h"
#include "assign/simd/span_lists.h"
#include "core/error.h"

namespace clusterbench::assign {

// Centres, radii and reaches as arrays.
struct BallArrays {
  std::vector<float> x, y, z, radius;

  void resize(std::size_t size) {
    for (std::vector<float>* list : {&x, &y, &z, &radius}) list->resize(size);
  }
  void set(std::size_t place, const geom::Ball& ball) {
    x[place] = ball.center.x;
    y[place] = ball.center.y;
    z[place] = ball.center.z;
    radius[place] = ball.radius;
  }
  std::size_t capacity_bytes() const { return 4 * x.capacity() * sizeof(float); }
};

// Rows: Rows(const Params&), build(const grid::Grid&), void find(const BallBatch&, BatchRows&), capacity_bytes() const,
// k_roundings: what they lose, and void narrow(CellBox&, const geom::SphericalCone&) const for spots with a cone.
template <class Rows>
class CellBoxTwin final : public Assigner {
 public:
  explicit CellBoxTwin(const Params& params) : test_(params, Rows::k_roundings), rows_(params) {}

  void build(const grid::Grid& grid) override {
    if (grid.cells().x > k_most_columns)
      throw Error("", "tiles",
                  "make " + std::to_string(grid.cells().x) + " columns; fast assigners take at most " +
                      std::to_string(k_most_columns));
    planes_ = RowPlanes(grid.screen());
    box_planes_ = BoxPlanes(grid.screen());
    rows_.build(grid);
    test_.start_grid(grid);
    cells_ = {};
    is_left_.resize(static_cast<std::size_t>(planes_.rows));
  }

  void assign(const view::LightArrays& lights, Lists& out) override {
    lights_ = &lights;
    tests_ = lights.size();
    test_.start_frame(lights);
    if (cells_.empty() && !test_.cell_balls().empty()) cells_ = CellBalls(test_.cell_balls());
    box_lights();
    slice_balls_.sort(boxed_, planes_.slices);
    spans_.start(static_cast<std::uint32_t>(planes_.slices), static_cast<std::uint32_t>(planes_.rows),
                 static_cast<std::uint32_t>(planes_.columns), out);
    for (int slice = 0; slice < planes_.slices; ++slice) {
      add_slice(slice);
      spans_.finish_band();
    }
    spans_.finish();
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override {
    return spans_.capacity_bytes() + slice_balls_.capacity_bytes() + seen_.capacity_bytes() + boxed_.capacity_bytes() +
           rows_.capacity_bytes() + batch_.columns.capacity() * sizeof(std::uint32_t) + test_.capacity_bytes() +
           cells_.capacity_bytes() + spots_.capacity_bytes();
  }

 private:
  void box_lights() {
    seen_.count = boxed_.count = 0;
    seen_.reserve(lights_->size());
    boxed_.reserve(lights_->size());
    const GivenBalls points{lights_->x.data(),      lights_->y.data(),     lights_->z.data(),
                            lights_->radius.data(), lights_->reach.data(), lights_->points};
    box_balls(points, 0, {test_.padding(k_cell_box_roundings), test_.own_padding()});
    if (lights_->spots > 0) box_spots();
  }

  void box_balls(const GivenBalls& balls, std::uint32_t first_light, const BallPadding& padding) {
    const std::uint32_t begin = seen_.count;
    see_balls(planes_, balls, first_light, seen_, padding.box + k_slice_rows_roundings);
    find_cell_boxes(box_planes_, seen_, begin, balls, first_light, padding, boxed_);
  }

  // A spot's ball for its box and the one for its rows differ in their centres, too.
  void box_spots() {
    const std::uint32_t begin = boxed_.count, points = lights_->points;
    spots_.resize(lights_->spots);
    for (std::uint32_t i = 0; i < lights_->spots; ++i)
      spots_.set(i, lights_->is_empty(points + i) ? geom::Ball{{}, 0.0f}
                                                  : test_.ball(*lights_, points + i, k_cell_box_roundings));
    const GivenBalls balls{
        spots_.x.data(), spots_.y.data(), spots_.z.data(), spots_.radius.data(), lights_->reach.data() + points,
        lights_->spots};
    box_balls(balls, points, {0.0f, 0.0f});
    for (std::uint32_t i = begin; i < boxed_.count; ++i) take_spot(i);
  }

  void take_spot(std::uint32_t place) {
    const TestedLight light = test_.tested(*lights_, boxed_.light[place]);
    boxed_.x[place] = light.ball.center.x;
    boxed_.y[place] = light.ball.center.y;
    boxed_.depth[place] = -light.ball.center.z;
    boxed_.radius[place] = light.ball.radius;
    if (!light.has_cone) return;
    CellBox box = boxed_.box(place);
    rows_.narrow(box, light.cone);
    boxed_.set_box(place, box);
  }

  void add_slice(int slice) {
    const std::span<const std::uint32_t> balls = slice_balls_.of(slice);
    const std::uint32_t most = balls_per_batch(), first_open = test_.tests_cones() ? lights_->points : lights_->size();
    for (std::uint32_t begin = 0; begin < balls.size(); begin += most) {
      const auto count = std::min(most, static_cast<std::uint32_t>(balls.size()) - begin);
      rows_.find({boxed_, slice, balls.data() + begin, count, first_open}, batch_);
      tests_ += batch_.tests;
      spans_.add_batch(batch_.first_row, batch_.last_row, batch_.columns.data(), batch_.lights, is_left_.data());
      for (int row = batch_.first_row; row <= batch_.last_row; ++row)
        if (is_left_[static_cast<std::size_t>(row)] != 0) add_left_row(slice, row);
    }
  }

  void add_left_row(int slice, int row) {
    const std::uint32_t* columns = batch_.columns.data() + static_cast<std::size_t>(row) * batch_.lanes;
    for (std::uint32_t lane = 0; lane < batch_.lanes; ++lane) {
      const std::uint32_t entry = columns[lane];
      if (entry == BatchRows::k_none) continue;
      const auto first = static_cast<std::uint32_t>(BatchRows::first_of(entry));
      const auto last = static_cast<std::uint32_t>(BatchRows::last_of(entry));
      if ((entry & BatchRows::k_uncertain) != 0)
        add_lit(slice, row, first, last, batch_.lights[lane]);
      else
        spans_.add(static_cast<std::uint32_t>(row), first, last, batch_.lights[lane]);
    }
  }

  // Those of a row's columns that a spot's cone may touch.
  void add_lit(int slice, int row, std::uint32_t first, std::uint32_t last, std::uint32_t light) {
    const geom::SphericalCone cone = test_.cone(*lights_, light);
    const auto row_start = static_cast<std::uint32_t>((slice * planes_.rows + row) * planes_.columns);
    tests_ += last - first + 1;
    for (std::uint32_t begin = first; begin <= last; begin += 64) {
      std::uint64_t lit = lit_cells(cone, cells_, row_start + begin, std::min(64u, last - begin + 1));
      std::uint32_t column = begin;
      while (lit != 0) {
        const int dark = std::countr_zero(lit), run = std::countr_one(lit >> dark);
        column += static_cast<std::uint32_t>(dark);
        spans_.add(static_cast<std::uint32_t>(row), column, column + static_cast<std::uint32_t>(run) - 1, light);
        column += static_cast<std::uint32_t>(run);
        lit = dark + run < 64 ? lit >> (dark + run) : 0;
      }
    }
  }

  const view::LightArrays* lights_ = nullptr;  // of the frame at hand
  LightTest test_;
  Rows rows_;
  RowPlanes planes_;
  BoxPlanes box_planes_;
  CellBalls cells_;
  BallArrays spots_;
  SeenBalls seen_;
  BoxedBalls boxed_;
  SliceBalls slice_balls_;
  BatchRows batch_;
  std::vector<std::uint8_t> is_left_;
  SpanLists spans_;
  std::uint64_t tests_ = 0;
};

template <class Rows>
std::unique_ptr<Assigner> make_cell_box_twin(const Params& params) {
  return std::make_unique<CellBoxTwin<Rows>>(params);
}

}  // namespace clusterbench::assign
