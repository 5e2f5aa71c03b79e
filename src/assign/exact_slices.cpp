#include "assign/exact_slices.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace clusterbench::assign {

using grid::IndexRange;

void ExactSlices::find(const ExactFrame& frame, int first, int last, Lists& out) {
  frame_ = &frame;
  tests_ = fallbacks_ = 0;
  const auto rows = static_cast<std::uint32_t>(frame.planes.rows);
  is_left_.resize(rows);
  spans_.start(static_cast<std::uint32_t>(last - first), rows, static_cast<std::uint32_t>(frame.planes.columns), out);
  for (int slice = first; slice < last; ++slice) {
    add_slice(slice);
    spans_.finish_band();
  }
  spans_.finish();
}

std::size_t ExactSlices::scratch_bytes() const {
  return spans_.capacity_bytes() + cells_.capacity_bytes() + closer_.capacity_bytes() +
         (rows_.columns.capacity() + closer_places_.capacity()) * sizeof(std::uint32_t);
}

// Calls take(light, columns, is_uncertain) for the batch's spans of a row.
template <class Take>
void ExactSlices::each_span(int row, Take&& take) const {
  const std::uint32_t* columns = rows_.columns.data() + static_cast<std::size_t>(row) * rows_.lanes;
  for (std::uint32_t lane = 0; lane < rows_.lanes; ++lane)
    if (columns[lane] != BatchRows::k_none)
      take(rows_.lights[lane], IndexRange{BatchRows::first_of(columns[lane]), BatchRows::last_of(columns[lane])},
           (columns[lane] & BatchRows::k_uncertain) != 0);
}

void ExactSlices::add_slice(int slice) {
  const std::span<const std::uint32_t> balls = frame_->balls.of(slice);
  const std::uint32_t most = balls_per_batch();
  for (std::uint32_t begin = 0; begin < balls.size(); begin += most) {
    const auto count = std::min(most, static_cast<std::uint32_t>(balls.size()) - begin);
    find_rows(frame_->planes, frame_->seen, slice, balls.data() + begin, count, frame_->lights.points, rows_);
    tests_ += rows_.tests;
    if (rows_.tests == 0) continue;
    spans_.add_batch(rows_.first_row, rows_.last_row, rows_.columns.data(), rows_.lights, is_left_.data());
    if (rows_.lights[count - 1] >= frame_->lights.points) look_at_spots(slice);
    for (int row = rows_.first_row; row <= rows_.last_row; ++row)
      if (is_left_[static_cast<std::size_t>(row)] != 0) decide_row(slice, row);
  }
}

void ExactSlices::look_at_spots(int slice) {
  const std::size_t k = static_cast<std::size_t>(slice);
  const SpotsAndPlanes from{&frame_->lights, frame_->planes.side.data(), frame_->planes.slope.data(),
                            frame_->planes.depth[k], frame_->planes.depth[k + 1]};
  cells_.count = 0;
  for (int row = rows_.first_row; row <= rows_.last_row; ++row)
    if (is_left_[static_cast<std::size_t>(row)] != 0)
      each_span(row, [&](std::uint32_t light, const IndexRange& columns, bool) {
        if (!frame_->lights.is_spot(light)) return;
        for (int column = columns.first; column <= columns.last; ++column)
          cells_.add(light - frame_->lights.points, static_cast<std::uint32_t>(row),
                     static_cast<std::uint32_t>(column));
      });
  tests_ += cells_.count;
  look_at_cells(from, cells_);
  look_closer(from);
  next_cell_ = 0;
}

// Of each row of a spot, those cells that are still open and not between two that are touched.
void ExactSlices::look_closer(const SpotsAndPlanes& from) {
  closer_.count = 0;
  for (std::uint32_t begin = 0, end; begin < cells_.count; begin = end) {
    end = begin + 1;
    while (end < cells_.count && cells_.spot[end] == cells_.spot[begin] && cells_.row[end] == cells_.row[begin]) ++end;
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

void ExactSlices::add_closer(std::uint32_t place) {
  if (closer_places_.size() <= closer_.count) closer_places_.resize(2 * closer_places_.size() + 64);
  closer_places_[closer_.count] = place;
  closer_.add(cells_.spot[place], cells_.row[place], cells_.column[place]);
}

void ExactSlices::decide_row(int slice, int row) {
  const Row shape = row_of(frame_->grid.screen(), slice, row);
  each_span(row, [&](std::uint32_t light, const IndexRange& columns, bool is_uncertain) {
    const IndexRange touched = is_uncertain ? decided(shape, columns, light) : columns;
    if (!touched.empty())
      spans_.add(static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(touched.first),
                 static_cast<std::uint32_t>(touched.last), light);
  });
}

IndexRange ExactSlices::decided(const Row& row, const IndexRange& outer, std::uint32_t light) {
  CellJudge judge(frame_->grid, frame_->lights, light);
  if (frame_->lights.is_spot(light)) return lit(row, outer, judge);
  if (std::isinf(frame_->lights.radius[light])) return outer;
  return settled(outer, RowColumns(frame_->grid.screen().tiles), frame_->lights.ball(light, -k_exact_roundings), row,
                 judge, fallbacks_);
}

// The columns that a spot touches. Its cells have been looked at in the order in which they are asked for.
IndexRange ExactSlices::lit(const Row& row, const IndexRange& outer, CellJudge& judge) {
  const Touch* touches = cells_.touch.data() + next_cell_;
  next_cell_ += static_cast<std::uint32_t>(outer.count());
  return narrowed(outer, [&](int column) {
    const Touch touch = touches[column - outer.first];
    if (touch != Touch::open) return touch == Touch::no;
    ++fallbacks_;
    return !judge.touches(row.first_cell + static_cast<std::uint32_t>(column));
  });
}

}  // namespace clusterbench::assign
