// `exact` for speed. Balls outside of the view are left out a vector at a time; slice by slice the rows of many balls
// are found at once, one ball per lane; a slice's lists are built by compression while its spans are in the cache. Rows
// that single precision leaves open, and the ends of a spot's rows, are decided as in exact.cpp.
//
// Only perspective grids; others take the scalar reference.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <span>

#include "assign/assigner.h"
#include "assign/exact_rows.h"
#include "assign/simd/slice_rows.h"
#include "assign/simd/span_lists.h"
#include "assign/simd/spot_cells.h"
#include "core/error.h"
#include "geom/predicates.h"

namespace clusterbench::assign {
namespace {

using grid::IndexRange;

// The balls that reach each slice, ascending.
class SliceBalls {
 public:
  void sort(const SeenBalls& seen, int slices) {
    begin_.assign(static_cast<std::size_t>(slices) + 2, 0);
    for (std::uint32_t i = 0; i < seen.count; ++i)
      for (std::int32_t slice = seen.first_slice[i]; slice <= seen.last_slice[i]; ++slice) ++begin_[at(slice) + 2];
    for (std::size_t slice = 2; slice < begin_.size(); ++slice) begin_[slice] += begin_[slice - 1];
    if (balls_.size() < begin_.back() + k_most_lanes) balls_.resize(begin_.back() + k_most_lanes);
    // begin_[slice + 1] walks from the slice's begin to its end, the next one's begin.
    for (std::uint32_t i = 0; i < seen.count; ++i)
      for (std::int32_t slice = seen.first_slice[i]; slice <= seen.last_slice[i]; ++slice)
        balls_[begin_[at(slice) + 1]++] = i;
    std::fill_n(balls_.begin() + static_cast<std::ptrdiff_t>(begin_.back()), k_most_lanes, 0);
  }

  // Places in the SeenBalls; a whole vector can be read from each of them.
  std::span<const std::uint32_t> of(int slice) const {
    return {balls_.data() + begin_[at(slice)], begin_[at(slice) + 1] - begin_[at(slice)]};
  }
  std::size_t capacity_bytes() const { return (begin_.capacity() + balls_.capacity()) * sizeof(std::uint32_t); }

 private:
  static std::size_t at(int slice) { return static_cast<std::size_t>(slice); }

  std::vector<std::uint32_t> begin_, balls_;
};

class ExactFast final : public Assigner {
 public:
  explicit ExactFast(const Params&) {}

  void build(const grid::Grid& grid) override {
    if (grid.cells().x > k_most_columns)
      throw Error("", "tiles",
                  "make " + std::to_string(grid.cells().x) + " columns; exact-fast takes at most " +
                      std::to_string(k_most_columns));
    grid_ = &grid;
    planes_ = RowPlanes(grid.screen());
    is_left_.resize(static_cast<std::size_t>(planes_.rows));
  }

  void assign(const view::LightArrays& lights, Lists& out) override {
    fallbacks_ = 0;
    tests_ = lights.size();
    lights_ = &lights;
    see_lights();
    slice_balls_.sort(seen_, planes_.slices);
    spans_.start(static_cast<std::uint32_t>(planes_.slices), static_cast<std::uint32_t>(planes_.rows),
                 static_cast<std::uint32_t>(planes_.columns), out);
    for (int slice = 0; slice < planes_.slices; ++slice) {
      add_slice(slice);
      spans_.finish_band();
    }
    spans_.finish();
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::uint64_t fallbacks() const override { return fallbacks_; }
  std::size_t scratch_bytes() const override {
    return spans_.capacity_bytes() + slice_balls_.capacity_bytes() + seen_.capacity_bytes() +
           rows_.columns.capacity() * sizeof(std::uint32_t) + 5 * spot_x_.capacity() * sizeof(float);
  }

 private:
  void see_lights() {
    seen_.count = 0;
    seen_.reserve(lights_->size());
    see_balls(planes_,
              {lights_->x.data(), lights_->y.data(), lights_->z.data(), lights_->radius.data(), lights_->reach.data(),
               lights_->points},
              0, seen_);
    if (lights_->spots == 0) return;
    for (std::vector<float>* list : {&spot_x_, &spot_y_, &spot_z_, &spot_radius_}) list->resize(lights_->spots);
    for (std::uint32_t i = 0; i < lights_->spots; ++i) {
      const geom::Ball around = ball_of_spot(lights_->points + i);
      spot_x_[i] = around.center.x;
      spot_y_[i] = around.center.y;
      spot_z_[i] = around.center.z;
      spot_radius_[i] = around.radius;
    }
    see_balls(planes_,
              {spot_x_.data(), spot_y_.data(), spot_z_.data(), spot_radius_.data(),
               lights_->reach.data() + lights_->points, lights_->spots},
              lights_->points, seen_);
  }

  geom::Ball ball_of_spot(std::uint32_t light) const {
    const geom::SphericalCone cone = lights_->cone(light, view::k_given_roundings);
    if (lights_->is_empty(light)) return {cone.apex, 0.0f};
    return std::isinf(cone.range) ? geom::Ball{cone.apex, cone.range} : geom::bounding_ball(cone);
  }

  void add_slice(int slice) {
    const std::span<const std::uint32_t> balls = slice_balls_.of(slice);
    const std::uint32_t most = balls_per_batch();
    for (std::uint32_t begin = 0; begin < balls.size(); begin += most) {
      const auto count = std::min(most, static_cast<std::uint32_t>(balls.size()) - begin);
      find_rows(planes_, seen_, slice, balls.data() + begin, count, lights_->points, rows_);
      tests_ += rows_.tests;
      if (rows_.tests == 0) continue;
      spans_.add_batch(rows_.first_row, rows_.last_row, rows_.columns.data(), rows_.lights, is_left_.data());
      if (rows_.lights[count - 1] >= lights_->points) look_at_spots(slice);
      for (int row = rows_.first_row; row <= rows_.last_row; ++row)
        if (is_left_[static_cast<std::size_t>(row)] != 0) decide_row(slice, row);
    }
  }

  // Calls take(light, columns, is_uncertain) for the batch's spans of a row.
  template <class Take>
  void each_span(int row, Take&& take) const {
    const std::uint32_t* columns = rows_.columns.data() + static_cast<std::size_t>(row) * rows_.lanes;
    for (std::uint32_t lane = 0; lane < rows_.lanes; ++lane)
      if (columns[lane] != BatchRows::k_none)
        take(rows_.lights[lane], IndexRange{BatchRows::first_of(columns[lane]), BatchRows::last_of(columns[lane])},
             (columns[lane] & BatchRows::k_uncertain) != 0);
  }

  void look_at_spots(int slice) {
    const std::size_t k = static_cast<std::size_t>(slice);
    const SpotsAndPlanes from{lights_, planes_.side.data(), planes_.slope.data(), planes_.depth[k],
                              planes_.depth[k + 1]};
    cells_.count = 0;
    for (int row = rows_.first_row; row <= rows_.last_row; ++row)
      if (is_left_[static_cast<std::size_t>(row)] != 0)
        each_span(row, [&](std::uint32_t light, const IndexRange& columns, bool) {
          if (!lights_->is_spot(light)) return;
          for (int column = columns.first; column <= columns.last; ++column)
            cells_.add(light - lights_->points, static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column));
        });
    tests_ += cells_.count;
    look_at_cells(from, cells_);
    look_closer(from);
    next_cell_ = 0;
  }

  // Of each row of a spot, those cells that are still open and not between two that are touched.
  void look_closer(const SpotsAndPlanes& from) {
    closer_.count = 0;
    for (std::uint32_t begin = 0, end; begin < cells_.count; begin = end) {
      end = begin + 1;
      while (end < cells_.count && cells_.spot[end] == cells_.spot[begin] && cells_.row[end] == cells_.row[begin])
        ++end;
      const auto first = cells_.touch.begin() + begin, last = cells_.touch.begin() + end;
      const auto add_open = [&](auto from_place, auto to_place) {
        for (auto at = from_place; at != to_place; ++at)
          if (*at == Touch::open) add_closer(static_cast<std::uint32_t>(at - cells_.touch.begin()));
      };
      const auto touched = std::find(first, last, Touch::yes);
      add_open(first, touched);
      if (touched == last) continue;
      add_open(std::find(std::make_reverse_iterator(last), std::make_reverse_iterator(first), Touch::yes).base(), last);
    }
    look_closely_at_cells(from, closer_);
    for (std::uint32_t i = 0; i < closer_.count; ++i) cells_.touch[closer_places_[i]] = closer_.touch[i];
  }

  void add_closer(std::uint32_t place) {
    if (closer_places_.size() <= closer_.count) closer_places_.resize(2 * closer_places_.size() + 64);
    closer_places_[closer_.count] = place;
    closer_.add(cells_.spot[place], cells_.row[place], cells_.column[place]);
  }

  void decide_row(int slice, int row) {
    const Row shape = row_of(grid_->screen(), slice, row);
    each_span(row, [&](std::uint32_t light, const IndexRange& columns, bool is_uncertain) {
      const IndexRange touched = is_uncertain ? decided(shape, columns, light) : columns;
      if (!touched.empty())
        spans_.add(static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(touched.first),
                   static_cast<std::uint32_t>(touched.last), light);
    });
  }

  IndexRange decided(const Row& row, const IndexRange& outer, std::uint32_t light) {
    CellJudge judge(*grid_, *lights_, light);
    if (lights_->is_spot(light)) return lit(row, outer, judge);
    if (std::isinf(lights_->radius[light])) return outer;
    return settled(outer, RowColumns(grid_->screen().tiles), lights_->ball(light, -k_exact_roundings), row, judge,
                   fallbacks_);
  }

  // The columns that a spot touches. Its cells have been looked at in the order in which they are asked for.
  IndexRange lit(const Row& row, const IndexRange& outer, CellJudge& judge) {
    const Touch* touches = cells_.touch.data() + next_cell_;
    next_cell_ += static_cast<std::uint32_t>(outer.count());
    return narrowed(outer, [&](int column) {
      const Touch touch = touches[column - outer.first];
      if (touch != Touch::open) return touch == Touch::no;
      ++fallbacks_;
      return !judge.touches(row.first_cell + static_cast<std::uint32_t>(column));
    });
  }

  const grid::Grid* grid_ = nullptr;
  const view::LightArrays* lights_ = nullptr;  // of the frame at hand
  RowPlanes planes_;
  std::vector<float> spot_x_, spot_y_, spot_z_, spot_radius_;
  SeenBalls seen_;
  SliceBalls slice_balls_;
  BatchRows rows_;
  std::vector<std::uint8_t> is_left_;
  SpotCells cells_, closer_;  // of a batch; those of them to look at closely
  std::vector<std::uint32_t> closer_places_;
  std::uint32_t next_cell_ = 0;
  SpanLists spans_;
  std::uint64_t tests_ = 0, fallbacks_ = 0;
};

std::unique_ptr<Assigner> make(const Params& params) {
  return std::make_unique<ExactFast>(params);
}

}  // namespace

extern const AssignerRow exact_fast_row;
const AssignerRow exact_fast_row{
    .name = "exact-fast",
    .summary = "exact, one ball per lane, lists by compression (SIMD, dispatched at run time)",
    .source = "this project",
    .kinds = {grid::Kind::frustum},
    .exact = true,
    .orthographic = false,
    .params = {},
    .make = make,
};

}  // namespace clusterbench::assign
