#include "assign/exact_slices.h"

#include <algorithm>
#include <cmath>

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
  return spans_.capacity_bytes() + cells_.capacity_bytes() + closer_.capacity_bytes() + rows_.capacity_bytes() +
         closer_places_.capacity() * sizeof(std::uint32_t) + lit_.capacity() * sizeof(Lit) +
         ends_.capacity() * sizeof(Ends);
}

// Calls take(light, columns, is_uncertain) for a batch's spans of a row.
template <class Take>
void each_span(const BatchRows& batch, int row, Take&& take) {
  const std::uint32_t* columns = batch.columns.data() + static_cast<std::size_t>(row) * batch.lanes;
  for (std::uint32_t lane = 0; lane < batch.lanes; ++lane)
    if (columns[lane] != BatchRows::k_none)
      take(batch.lights[lane], IndexRange{BatchRows::first_of(columns[lane]), BatchRows::last_of(columns[lane])},
           (columns[lane] & BatchRows::k_uncertain) != 0);
}

void ExactSlices::add_slice(int slice) {
  const std::span<const std::uint32_t> balls = frame_->balls.of(slice);
  const std::uint32_t most = k_batches_at_once * balls_per_batch();
  for (std::uint32_t begin = 0; begin < balls.size(); begin += most) {
    const auto count = std::min(most, static_cast<std::uint32_t>(balls.size()) - begin);
    find_rows(frame_->planes, frame_->seen, {slice, balls.data() + begin, count, frame_->lights.points}, rows_);
    const bool has_spots = frame_->seen.light[balls[begin + count - 1]] >= frame_->lights.points;
    for (std::uint32_t i = 0; i < rows_.count; ++i) add_batch(slice, rows_.batches[i], has_spots);
  }
}

void ExactSlices::add_batch(int slice, const BatchRows& batch, bool has_spots) {
  tests_ += batch.tests;
  if (batch.tests == 0) return;
  spans_.add_batch(batch.first_row, batch.last_row, batch.columns.data(), batch.lights, is_left_.data());
  if (has_spots) light_rows(slice, batch);
  for (int row = batch.first_row; row <= batch.last_row; ++row)
    if (is_left_[static_cast<std::size_t>(row)] != 0) decide_row(slice, batch, row);
}

// The columns that spots touch, of all of the batch's rows that are left: the ends of each span are looked at a few
// cells at a time, until both are touched.
void ExactSlices::light_rows(int slice, const BatchRows& batch) {
  const std::size_t k = static_cast<std::size_t>(slice);
  const SpotsAndPlanes from{&frame_->lights, frame_->planes.side.data(), frame_->planes.slope.data(),
                            frame_->planes.depth[k], frame_->planes.depth[k + 1]};
  lit_.clear();
  next_lit_ = 0;
  for (int row = batch.first_row; row <= batch.last_row; ++row)
    if (is_left_[static_cast<std::size_t>(row)] != 0)
      each_span(batch, row, [&](std::uint32_t light, const IndexRange& columns, bool) {
        if (frame_->lights.is_spot(light)) lit_.push_back({light, row, columns, true, true});
      });
  while (ask_for_ends()) {
    tests_ += cells_.count;
    look_at_cells(from, Look::quick, cells_);
    for (const Look how : {Look::closer, Look::thorough}) {
      ask_more_closely();
      look_at_cells(from, how, closer_);
      for (std::uint32_t i = 0; i < closer_.count; ++i) cells_.touch[closer_places_[i]] = closer_.touch[i];
    }
    for (const Ends& ends : ends_) settle(slice, ends);
  }
}

// Puts the cells at the open ends of all spans into cells_. False if there are none.
bool ExactSlices::ask_for_ends() {
  constexpr int k_at_once = 4;
  cells_.count = 0;
  ends_.clear();
  for (std::uint32_t i = 0; i < lit_.size(); ++i) {
    const Lit& lit = lit_[i];
    const int count = lit.columns.count();
    if (count == 0 || !(lit.left_is_open || lit.right_is_open)) continue;
    if (count <= 2 * k_at_once) {
      ask(i, lit.columns, lit.left_is_open, lit.right_is_open);
      continue;
    }
    if (lit.left_is_open) ask(i, {lit.columns.first, lit.columns.first + k_at_once - 1}, true, false);
    if (lit.right_is_open) ask(i, {lit.columns.last - k_at_once + 1, lit.columns.last}, false, true);
  }
  return !ends_.empty();
}

void ExactSlices::ask(std::uint32_t i, const IndexRange& columns, bool from_left, bool from_right) {
  ends_.push_back({i, cells_.count, columns, from_left, from_right});
  for (int column = columns.first; column <= columns.last; ++column)
    cells_.add(lit_[i].light - frame_->lights.points, static_cast<std::uint32_t>(lit_[i].row),
               static_cast<std::uint32_t>(column));
}

// Cells without an answer that lie before the first one that is touched.
void ExactSlices::ask_more_closely() {
  closer_.count = 0;
  const auto is = [&](std::uint32_t place, Touch touch) { return cells_.touch[place] == touch; };
  for (const Ends& ends : ends_) {
    const std::uint32_t begin = ends.place, end = begin + static_cast<std::uint32_t>(ends.columns.count());
    std::uint32_t left = begin, right = end;
    for (; ends.from_left && left < end && !is(left, Touch::yes); ++left)
      if (is(left, Touch::open)) add_closer(left);
    for (; ends.from_right && right > left && !is(right - 1, Touch::yes); --right)
      if (is(right - 1, Touch::open)) add_closer(right - 1);
  }
}

void ExactSlices::add_closer(std::uint32_t place) {
  if (closer_places_.size() <= closer_.count) closer_places_.resize(2 * closer_places_.size() + 64);
  closer_places_[closer_.count] = place;
  closer_.add(cells_.spot[place], cells_.row[place], cells_.column[place]);
}

// Shortens the span by its cells that are not touched. An end is settled where one is.
void ExactSlices::settle(int slice, const Ends& ends) {
  Lit& lit = lit_[ends.lit];
  const Row row = row_of(frame_->grid.screen(), slice, lit.row);
  CellJudge judge(frame_->grid, frame_->lights, lit.light);
  const auto touches = [&](int column) {
    Touch& touch = cells_.touch[ends.place + static_cast<std::uint32_t>(column - ends.columns.first)];
    if (touch == Touch::open) {
      ++fallbacks_;
      touch = judge.touches(row.first_cell + static_cast<std::uint32_t>(column)) ? Touch::yes : Touch::no;
    }
    return touch == Touch::yes;
  };
  IndexRange& span = lit.columns;
  if (ends.from_left) {
    while (span.first <= ends.columns.last && !touches(span.first)) ++span.first;
    lit.left_is_open = span.first > ends.columns.last;
  }
  if (ends.from_right) {
    const int end = std::max(ends.columns.first, span.first);
    while (span.last >= end && !touches(span.last)) --span.last;
    lit.right_is_open = span.last < end;
  }
}

void ExactSlices::decide_row(int slice, const BatchRows& batch, int row) {
  const Row shape = row_of(frame_->grid.screen(), slice, row);
  each_span(batch, row, [&](std::uint32_t light, const IndexRange& columns, bool is_uncertain) {
    const IndexRange touched = is_uncertain ? decided(shape, columns, light) : columns;
    if (!touched.empty())
      spans_.add(static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(touched.first),
                 static_cast<std::uint32_t>(touched.last), light);
  });
}

IndexRange ExactSlices::decided(const Row& row, const IndexRange& outer, std::uint32_t light) {
  if (frame_->lights.is_spot(light)) return lit_[next_lit_++].columns;
  if (std::isinf(frame_->lights.radius[light])) return outer;
  CellJudge judge(frame_->grid, frame_->lights, light);
  if (frame_->lights.reach[light] > k_most_row_reach)
    return narrowed(outer, [&](int column) {
      ++fallbacks_;
      return !judge.touches(row.first_cell + static_cast<std::uint32_t>(column));
    });
  return settled(outer, RowColumns(frame_->grid.screen().tiles), frame_->lights.ball(light, -k_exact_roundings), row,
                 judge, fallbacks_);
}

}  // namespace clusterbench::assign
