#include "assign/exact_slices.h"

#include <cmath>

namespace clusterbench::assign {

using grid::IndexRange;

namespace {

std::uint32_t span_of(const IndexRange& columns) {
  return ColumnSpan::of(static_cast<std::uint32_t>(columns.first), static_cast<std::uint32_t>(columns.last));
}

}  // namespace

void ExactSlices::find(const ExactFrame& frame, int first, int last, Lists& out) {
  frame_ = &frame;
  tests_ = fallbacks_ = 0;
  const auto rows = static_cast<std::uint32_t>(frame.planes.rows);
  is_left_.resize(rows);
  // Of one batch at most, on any machine.
  open_.reserve(rows * k_row_lanes);
  questions_.reserve(2 * rows * k_row_lanes);
  spots_.find(frame, first, last);
  batches_.start(frame, &ExactFrame::points_of, first, last);
  spans_.start(static_cast<std::uint32_t>(last - first), rows, static_cast<std::uint32_t>(frame.planes.columns), out);
  for (int slice = first; slice < last; ++slice) {
    add_points(slice);
    spots_.add_to(slice, spans_);
    spans_.finish_band();
  }
  spans_.finish();
}

std::size_t ExactSlices::scratch_bytes() const {
  return spots_.capacity_bytes() + spans_.capacity_bytes() + batches_.capacity_bytes() + questions_.capacity_bytes() +
         open_.capacity() * sizeof(OpenSpan);
}

void ExactSlices::add_points(int slice) {
  while (BatchRows* batch = batches_.next(slice)) {
    tests_ += batch->tests;
    if (batch->tests != 0) add_batch(slice, *batch);
  }
}

// Rows with open spans are added once these are decided.
void ExactSlices::add_batch(int slice, BatchRows& batch) {
  if (!spans_.add_batch(batch.first_row, batch.last_row, batch.columns.data(), batch.lights, is_left_.data())) return;
  open_.clear();
  questions_.count = 0;
  for (int row = batch.first_row; row <= batch.last_row; ++row)
    if (is_left_[static_cast<std::size_t>(row)] != 0) ask(slice, batch, row);
  look_at_balls(frame_->lights.space, frame_->planes.orthographic, questions_);
  for (const OpenSpan& span : open_) batch.columns_of(span.row)[span.lane] = decided(slice, batch, span);
  int row = -1;
  for (const OpenSpan& span : open_) {
    if (span.row == row) continue;
    row = span.row;
    spans_.add_batch(row, row, batch.columns.data(), batch.lights, is_left_.data());
  }
}

void ExactSlices::ask(int slice, const BatchRows& batch, int row) {
  const Row shape = row_of(frame_->grid.screen(), slice, row);
  const std::uint32_t* columns = batch.columns_of(row);
  for (std::uint32_t lane = 0; lane < batch.lanes; ++lane) {
    if (columns[lane] == BatchRows::k_none || (columns[lane] & BatchRows::k_uncertain) == 0) continue;
    open_.push_back({row, lane, questions_.count});
    const scene::WorldLight& light = frame_->lights.source[batch.lights[lane]];
    const int first = BatchRows::first_of(columns[lane]), last = BatchRows::last_of(columns[lane]);
    const bool asks_first = (columns[lane] & BatchRows::k_first_is_certain) == 0;
    if (asks_first) questions_.add(light, piece_of(frame_->grid.screen().tiles, shape, first));
    if ((columns[lane] & BatchRows::k_last_is_certain) == 0 && !(asks_first && last == first))
      questions_.add(light, piece_of(frame_->grid.screen().tiles, shape, last));
  }
}

std::uint32_t ExactSlices::decided(int slice, const BatchRows& batch, const OpenSpan& span) {
  const std::uint32_t light = batch.lights[span.lane], columns = batch.columns_of(span.row)[span.lane];
  const IndexRange all{BatchRows::first_of(columns), BatchRows::last_of(columns)};
  if (std::isinf(frame_->lights.radius[light])) return span_of(all);
  const bool asks_first = (columns & BatchRows::k_first_is_certain) == 0,
             asks_last = (columns & BatchRows::k_last_is_certain) == 0;
  const Touch first = asks_first ? questions_.touch[span.first_question] : Touch::yes;
  const bool has_own_answer = asks_last && !(asks_first && all.first == all.last);
  const Touch last =
      has_own_answer ? questions_.touch[span.first_question + (asks_first ? 1 : 0)] : (asks_last ? first : Touch::yes);
  fallbacks_ += (asks_first ? 1 : 0) + (has_own_answer ? 1 : 0);
  if (first == Touch::yes && last == Touch::yes) return span_of(all);
  const IndexRange touched = narrowed_to_touched(all, row_of(frame_->grid.screen(), slice, span.row), light);
  return touched.empty() ? BatchRows::k_none : span_of(touched);
}

// One by one. What is asked here is not counted: it depends on what the machine could answer before.
IndexRange ExactSlices::narrowed_to_touched(const IndexRange& columns, const Row& row, std::uint32_t light) const {
  BallJudge judge(frame_->grid, frame_->lights, light);
  const float reach = frame_->lights.reach[light];
  if (reach > k_most_exact_reach) return narrowed(columns, [&](int column) { return !judge.touches(row, column); });
  const RowColumns row_columns(frame_->grid.screen().tiles);
  const bool is_anywhere = !(frame_->planes.least_reach <= reach && reach <= k_most_row_reach);
  const IndexRange outer =
      is_anywhere ? row_columns.touched(frame_->lights.ball(light, k_exact_roundings), row, geom::Errs::outward)
                  : columns;
  if (outer.empty()) return {};
  std::uint64_t questions = 0;
  return settled(outer, row_columns, frame_->lights.ball(light, -k_exact_roundings), row, judge, questions);
}

}  // namespace clusterbench::assign
