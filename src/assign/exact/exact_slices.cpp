#include "assign/exact/exact_slices.h"

#include <cmath>

namespace clusterbench::assign {

using grid::IndexRange;

namespace {

// In the format of BatchRows.
std::uint32_t span_of(const IndexRange& columns) {
  if (columns.empty()) return BatchRows::k_none;
  return ColumnSpan::of(static_cast<std::uint32_t>(columns.first), static_cast<std::uint32_t>(columns.last));
}

}  // namespace

void ExactSlices::find(const ExactFrame& frame, int first, int last, Lists& out) {
  frame_ = &frame;
  tests_ = fallbacks_ = 0;
  const auto rows = static_cast<std::uint32_t>(frame.planes.rows);
  uncertain_.reserve(k_most_uncertain);
  end_cells_.reserve(2 * k_most_uncertain);
  spots_.find(frame, first, last);
  batches_.start(frame, first, last);
  spans_.start(static_cast<std::uint32_t>(last - first), rows, static_cast<std::uint32_t>(frame.planes.columns), out);
  for (int slice = first; slice < last; ++slice) {
    add_points(slice);
    spots_.add_to(slice, spans_);
    spans_.finish_band();
  }
  spans_.finish();
}

std::size_t ExactSlices::scratch_bytes() const {
  return spots_.capacity_bytes() + spans_.capacity_bytes() + batches_.capacity_bytes() + end_cells_.capacity_bytes() +
         uncertain_.capacity() * sizeof(UncertainSpan);
}

void ExactSlices::add_points(int slice) {
  const auto collect = [&](int of_slice, BatchSpans& batch) { collect_uncertain_spans(of_slice, batch); };
  while (const BatchSpans* batch = batches_.next(slice, collect, [&] { decide_spans(); })) {
    tests_ += batch->tests;
    if (batch->tests != 0)
      spans_.add_rows(batch->first_row, batch->last_row, batch->sizes.data(), batch->columns.data(),
                      batch->lights.data());
  }
}

void ExactSlices::collect_uncertain_spans(int slice, BatchSpans& batch) {
  int row = batch.first_row;
  std::uint32_t row_end = batch.uncertain_count == 0 ? 0 : batch.sizes[static_cast<std::size_t>(row)];
  for (std::uint32_t i = 0; i < batch.uncertain_count; ++i) {
    const std::uint32_t index = batch.uncertain[i], light = batch.lights[index];
    std::uint32_t& entry = batch.columns[index];
    while (index >= row_end) row_end += batch.sizes[static_cast<std::size_t>(++row)];
    UncertainSpan span{&entry,
                       light,
                       slice,
                       row,
                       {BatchRows::first_of(entry), BatchRows::last_of(entry)},
                       (entry & BatchSpans::k_first_is_uncertain) != 0,
                       (entry & BatchSpans::k_last_is_uncertain) != 0,
                       0};
    if (std::isinf(frame_->lights.radius[light])) {
      entry = span_of(span.columns);
      continue;
    }
    // Later tests are not counted: their number depends on the machine's vectors.
    fallbacks_ += span.tests_first && span.tests_last && span.columns.count() > 1 ? 2 : 1;
    const float reach = frame_->lights.reach[light];
    if (!(frame_->planes.least_reach <= reach && reach <= k_most_row_reach)) {
      entry = span_of(decided_without_filter(span));
      continue;
    }
    if (uncertain_.size() == k_most_uncertain) decide_spans();
    uncertain_.push_back(span);
  }
}

void ExactSlices::decide_spans() {
  while (!uncertain_.empty()) {
    end_cells_.count = 0;
    for (UncertainSpan& span : uncertain_) add_end_cells(span);
    filter_ball_cells(frame_->lights, frame_->planes, end_cells_);
    std::size_t kept = 0;
    for (UncertainSpan& span : uncertain_) {
      if (is_decided(span))
        *span.entry = span_of(span.columns);
      else
        uncertain_[kept++] = span;
    }
    uncertain_.resize(kept);
  }
}

void ExactSlices::add_end_cells(UncertainSpan& span) {
  span.first_test = end_cells_.count;
  if (span.tests_first) end_cells_.add(span.light, span.slice, span.row, span.columns.first);
  if (span.tests_last && !(span.tests_first && span.columns.count() == 1))
    end_cells_.add(span.light, span.slice, span.row, span.columns.last);
}

bool ExactSlices::is_decided(UncertainSpan& span) const {
  std::uint32_t next = span.first_test;
  const auto touches = [&](int column) {
    const Touch touch = end_cells_.touch[next++];
    if (touch != Touch::uncertain) return touch == Touch::yes;
    PointLightCellTest cell_test(frame_->grid, frame_->lights, span.light);
    return cell_test.touches(row_of(frame_->grid.screen(), span.slice, span.row), column);
  };
  IndexRange& columns = span.columns;
  const bool is_one = columns.count() == 1, tested_first = span.tests_first;
  if (span.tests_first) {
    span.tests_first = !touches(columns.first);
    if (span.tests_first) ++columns.first;
  }
  if (span.tests_last) {
    if (is_one && tested_first) {
      span.tests_last = false;
    } else {
      span.tests_last = !touches(columns.last);
      if (span.tests_last) --columns.last;
    }
  }
  // If only one column is left and one end has found it touched, the span is final.
  if (columns.count() == 1 && !(span.tests_first && span.tests_last)) return true;
  return columns.empty() || !(span.tests_first || span.tests_last);
}

IndexRange ExactSlices::decided_without_filter(const UncertainSpan& span) const {
  const Row row = row_of(frame_->grid.screen(), span.slice, span.row);
  PointLightCellTest cell_test(frame_->grid, frame_->lights, span.light);
  if (frame_->lights.reach[span.light] > k_most_exact_reach)
    return trimmed(span.columns, [&](int column) { return !cell_test.touches(row, column); });
  const RowColumns row_columns(frame_->grid.screen().tiles);
  const IndexRange outer =
      row_columns.touched(frame_->lights.ball(span.light, k_exact_roundoffs), row, geom::Errs::outward);
  if (outer.empty()) return {};
  std::uint64_t decisions = 0;
  return decided_columns(outer, row_columns, frame_->lights.ball(span.light, -k_exact_roundoffs), row, cell_test,
                         decisions);
}

}  // namespace clusterbench::assign
