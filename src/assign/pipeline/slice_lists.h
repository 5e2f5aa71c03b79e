#pragma once
// Lists of balls that have boxes of cells: slice by slice the rows of many balls are found at once, one ball per lane;
// a slice's lists are built by compression while its spans are in the cache. Then spots' cells are tested by their
// cones, a vector of cells at a time.

#include <bit>
#include <string>
#include <vector>

#include "assign/cone/bounding_spheres.h"
#include "assign/contract/light_test.h"
#include "assign/grid_cull/slice_bins.h"
#include "assign/lists/list_builder.h"
#include "assign/pipeline/bounded_balls.h"
#include "assign/rows/slice_rows.h"
#include "core/arrays.h"
#include "core/error.h"

namespace clusterbench::assign {

// Slices that are processed together: all of a grid, or a cascade's level.
struct Level {
  int slices = 0;
  // Cells without lights, in the first `hole_slices` slices.
  BandHole hole{};
  int hole_slices = 0;
};

// Keeps its memory between frames.
class SliceLists {
 public:
  explicit SliceLists(const LightTest& test) : test_(test) {}

  // To be called after the test's start_grid(). Throws Error if there are too many columns. `key`: their configuration
  // key.
  void start_grid(const Vec3i& cells, const char* key) {
    if (cells.x > k_most_columns)
      throw Error("", key,
                  "make " + std::to_string(cells.x) + " columns; fast assigners take at most " +
                      std::to_string(k_most_columns));
    grid_cells_ = cells;
    is_left_.resize(static_cast<std::size_t>(cells.y));
    cells_ = test_.cell_balls().empty() ? CellBalls() : CellBalls(test_.cell_balls());
  }

  // Both must outlive finish().
  void start_frame(const view::LightArrays& lights, Lists& out) {
    lights_ = &lights;
    tests_ = lights.size();
    next_slice_ = 0;
    spans_.start(static_cast<std::uint32_t>(grid_cells_.z), static_cast<std::uint32_t>(grid_cells_.y),
                 static_cast<std::uint32_t>(grid_cells_.x), out);
  }

  // Adds the grid's next slices, which the balls' boxes count from 0. find(batch, rows) finds a batch's rows.
  template <class Find>
  void add_slices(const BoundedBalls& bounded, const Level& level, Find&& find) {
    slice_bins_.sort(bounded, level.slices);
    for (int slice = 0; slice < level.slices; ++slice) {
      add_slice(bounded, slice, find);
      spans_.finish_band(slice < level.hole_slices ? level.hole : BandHole{});
      ++next_slice_;
    }
  }

  void finish() { spans_.finish(); }

  std::uint64_t tests_done() const { return tests_; }
  std::size_t capacity_bytes() const {
    return spans_.capacity_bytes() + slice_bins_.capacity_bytes() + cells_.capacity_bytes() +
           bytes_of(batch_.columns, runs_, touched_);
  }

 private:
  template <class Find>
  void add_slice(const BoundedBalls& bounded, int slice, Find&& find) {
    const std::span<const std::uint32_t> balls = slice_bins_.of(slice);
    const std::uint32_t most = balls_per_batch(),
                        first_uncertain = test_.tests_cones() ? lights_->spots.first : lights_->size();
    for (std::uint32_t begin = 0; begin < balls.size(); begin += most) {
      const auto count = std::min(most, static_cast<std::uint32_t>(balls.size()) - begin);
      find(BallBatch{bounded, slice, balls.data() + begin, count, first_uncertain}, batch_);
      tests_ += batch_.tests;
      if (spans_.add_batch(batch_.first_row, batch_.last_row, batch_.columns.data(), batch_.lights, is_left_.data()))
        add_left_rows(bounded, balls.data() + begin, count);
    }
  }

  // Ball by ball, which gives ascending lights in each row.
  void add_left_rows(const BoundedBalls& bounded, const std::uint32_t* balls, std::uint32_t count) {
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      runs_.clear();
      const std::uint32_t light = batch_.lights[lane];
      for (int row = bounded.first_row[balls[lane]]; row <= bounded.last_row[balls[lane]]; ++row) {
        const auto index = static_cast<std::size_t>(row);
        if (row < batch_.first_row || row > batch_.last_row || is_left_[index] == 0) continue;
        const std::uint32_t entry = batch_.columns[index * batch_.lanes + lane];
        if (entry == BatchRows::k_none) continue;
        const auto first = static_cast<std::uint32_t>(BatchRows::first_of(entry));
        const auto last = static_cast<std::uint32_t>(BatchRows::last_of(entry));
        if ((entry & BatchRows::k_uncertain) != 0)
          add_runs(static_cast<std::uint32_t>(row), first, last);
        else
          spans_.add(static_cast<std::uint32_t>(row), first, last, light);
      }
      if (!runs_.empty()) add_touched(light);
    }
  }

  void add_runs(std::uint32_t row, std::uint32_t first, std::uint32_t last) {
    const std::uint32_t row_start = grid::cell_index({0, static_cast<int>(row), next_slice_}, grid_cells_);
    tests_ += last - first + 1;
    for (std::uint32_t column = first; column <= last; column += 64)
      runs_.push_back({row, column, row_start + column, std::min(64u, last - column + 1)});
  }

  // Adds the cells of the runs that a spot's cone may touch.
  void add_touched(std::uint32_t light) {
    find_touched_cells(test_.cone(*lights_, light), cells_, runs_, touched_);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      std::uint64_t touched = touched_[i];
      std::uint32_t column = runs_[i].column;
      while (touched != 0) {
        const int skipped = std::countr_zero(touched), taken = std::countr_one(touched >> skipped);
        column += static_cast<std::uint32_t>(skipped);
        spans_.add(runs_[i].row, column, column + static_cast<std::uint32_t>(taken) - 1, light);
        column += static_cast<std::uint32_t>(taken);
        touched = skipped + taken < 64 ? touched >> (skipped + taken) : 0;
      }
    }
  }

  const LightTest& test_;
  const view::LightArrays* lights_ = nullptr;  // of the current frame
  Vec3i grid_cells_{0};
  int next_slice_ = 0;  // of the grid
  CellBalls cells_;
  SliceBins slice_bins_;
  BatchRows batch_;
  std::vector<CellRun> runs_;           // of a spot in a slice
  std::vector<std::uint64_t> touched_;  // of the runs
  std::vector<std::uint8_t> is_left_;
  ListBuilder spans_;
  std::uint64_t tests_ = 0;
};

}  // namespace clusterbench::assign
