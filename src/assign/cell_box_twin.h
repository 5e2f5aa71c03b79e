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
#include "assign/simd/spot_balls.h"
#include "core/error.h"

namespace clusterbench::assign {

// Rows: Rows(const Params&), build(const grid::Grid&), void find(const BallBatch&, BatchRows&), capacity_bytes() const,
// k_roundings: what they lose, bool narrows() const: whether they narrow the boxes of spots, and void narrow(CellBox&,
// const geom::SphericalCone&) const.
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
           cells_.capacity_bytes() + spots_for_boxes_.capacity_bytes() + spots_.capacity_bytes() +
           runs_.capacity() * sizeof(CellRun) + lit_.capacity() * sizeof(std::uint64_t);
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
    const bool around_cones = test_.balls_are_around_cones();
    find_spot_balls(*lights_, test_.padding(k_cell_box_roundings), around_cones, spots_for_boxes_);
    find_spot_balls(*lights_, test_.own_padding(), around_cones, spots_);
    const BallArrays& given = spots_for_boxes_;
    const GivenBalls balls{
        given.x.data(), given.y.data(), given.z.data(), given.radius.data(), lights_->reach.data() + points,
        lights_->spots};
    box_balls(balls, points, {0.0f, 0.0f});
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

  void add_slice(int slice) {
    const std::span<const std::uint32_t> balls = slice_balls_.of(slice);
    const std::uint32_t most = balls_per_batch(), first_open = test_.tests_cones() ? lights_->points : lights_->size();
    for (std::uint32_t begin = 0; begin < balls.size(); begin += most) {
      const auto count = std::min(most, static_cast<std::uint32_t>(balls.size()) - begin);
      rows_.find({boxed_, slice, balls.data() + begin, count, first_open}, batch_);
      tests_ += batch_.tests;
      spans_.add_batch(batch_.first_row, batch_.last_row, batch_.columns.data(), batch_.lights, is_left_.data());
      if (batch_.last_row >= batch_.first_row) add_left_rows(slice, balls.data() + begin, count);
    }
  }

  // Ball by ball, which for each row is the order of the lights.
  void add_left_rows(int slice, const std::uint32_t* balls, std::uint32_t count) {
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      runs_.clear();
      const std::uint32_t light = batch_.lights[lane];
      for (int row = boxed_.first_row[balls[lane]]; row <= boxed_.last_row[balls[lane]]; ++row) {
        const auto place = static_cast<std::size_t>(row);
        if (row < batch_.first_row || row > batch_.last_row || is_left_[place] == 0) continue;
        const std::uint32_t entry = batch_.columns[place * batch_.lanes + lane];
        if (entry == BatchRows::k_none) continue;
        const auto first = static_cast<std::uint32_t>(BatchRows::first_of(entry));
        const auto last = static_cast<std::uint32_t>(BatchRows::last_of(entry));
        if ((entry & BatchRows::k_uncertain) != 0)
          add_runs(slice, static_cast<std::uint32_t>(row), first, last);
        else
          spans_.add(static_cast<std::uint32_t>(row), first, last, light);
      }
      if (!runs_.empty()) add_lit(light);
    }
  }

  void add_runs(int slice, std::uint32_t row, std::uint32_t first, std::uint32_t last) {
    const auto in_slice = static_cast<std::uint32_t>(slice * planes_.rows * planes_.columns);
    const std::uint32_t row_start = in_slice + row * static_cast<std::uint32_t>(planes_.columns);
    tests_ += last - first + 1;
    for (std::uint32_t column = first; column <= last; column += 64)
      runs_.push_back({row, column, row_start + column, std::min(64u, last - column + 1)});
  }

  // Those of the runs' cells that a spot's cone may touch.
  void add_lit(std::uint32_t light) {
    find_lit_cells(test_.cone(*lights_, light), cells_, runs_, lit_);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      std::uint64_t lit = lit_[i];
      std::uint32_t column = runs_[i].column;
      while (lit != 0) {
        const int dark = std::countr_zero(lit), bright = std::countr_one(lit >> dark);
        column += static_cast<std::uint32_t>(dark);
        spans_.add(runs_[i].row, column, column + static_cast<std::uint32_t>(bright) - 1, light);
        column += static_cast<std::uint32_t>(bright);
        lit = dark + bright < 64 ? lit >> (dark + bright) : 0;
      }
    }
  }

  const view::LightArrays* lights_ = nullptr;  // of the frame at hand
  LightTest test_;
  Rows rows_;
  RowPlanes planes_;
  BoxPlanes box_planes_;
  CellBalls cells_;
  BallArrays spots_for_boxes_, spots_;
  SeenBalls seen_;
  BoxedBalls boxed_;
  SliceBalls slice_balls_;
  BatchRows batch_;
  std::vector<CellRun> runs_;       // of a spot in a slice
  std::vector<std::uint64_t> lit_;  // of the runs
  std::vector<std::uint8_t> is_left_;
  SpanLists spans_;
  std::uint64_t tests_ = 0;
};

template <class Rows>
std::unique_ptr<Assigner> make_cell_box_twin(const Params& params) {
  return std::make_unique<CellBoxTwin<Rows>>(params);
}

}  // namespace clusterbench::assign
