#include "assign/exact_slices.h"

#include <cmath>

namespace clusterbench::assign {

using grid::IndexRange;

void ExactSlices::find(const ExactFrame& frame, int first, int last, Lists& out) {
  frame_ = &frame;
  tests_ = fallbacks_ = 0;
  const auto rows = static_cast<std::uint32_t>(frame.planes.rows);
  is_left_.resize(rows);
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
  return spots_.capacity_bytes() + spans_.capacity_bytes() + batches_.capacity_bytes();
}

void ExactSlices::add_points(int slice) {
  while (const BatchRows* batch = batches_.next(slice)) {
    tests_ += batch->tests;
    if (batch->tests != 0) add_batch(slice, *batch);
  }
}

void ExactSlices::add_batch(int slice, const BatchRows& batch) {
  if (!spans_.add_batch(batch.first_row, batch.last_row, batch.columns.data(), batch.lights, is_left_.data())) return;
  for (int row = batch.first_row; row <= batch.last_row; ++row)
    if (is_left_[static_cast<std::size_t>(row)] != 0) decide_row(slice, batch, row);
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
