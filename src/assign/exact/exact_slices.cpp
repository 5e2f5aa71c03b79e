#include "assign/exact/exact_slices.h"

#include <cmath>

namespace clusterbench::assign {

using grid::IndexRange;

namespace {

// As BatchRows has it.
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
  questions_.reserve(2 * k_most_uncertain);
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
  return spots_.capacity_bytes() + spans_.capacity_bytes() + batches_.capacity_bytes() + questions_.capacity_bytes() +
         uncertain_.capacity() * sizeof(UncertainSpan);
}

void ExactSlices::add_points(int slice) {
  const auto take = [&](int of_slice, BatchSpans& batch) { ask_about_spans(of_slice, batch); };
  while (const BatchSpans* batch = batches_.next(slice, take, [&] { settle_spans(); })) {
    tests_ += batch->tests;
    if (batch->tests != 0)
      spans_.add_rows(batch->first_row, batch->last_row, batch->sizes.data(), batch->columns.data(),
                      batch->lights.data());
  }
}

void ExactSlices::ask_about_spans(int slice, BatchSpans& batch) {
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
    // What is asked later is not counted: it depends on what the machine could answer before.
    fallbacks_ += span.asks_first && span.asks_last && span.columns.count() > 1 ? 2 : 1;
    const float reach = frame_->lights.reach[light];
    if (!(frame_->planes.least_reach <= reach && reach <= k_most_row_reach)) {
      entry = span_of(touched_anywhere(span));
      continue;
    }
    if (uncertain_.size() == k_most_uncertain) settle_spans();
    uncertain_.push_back(span);
  }
}

void ExactSlices::settle_spans() {
  while (!uncertain_.empty()) {
    questions_.count = 0;
    for (UncertainSpan& span : uncertain_) ask(span);
    look_at_balls(frame_->lights, frame_->planes, questions_);
    std::size_t kept = 0;
    for (UncertainSpan& span : uncertain_) {
      if (is_settled(span))
        *span.entry = span_of(span.columns);
      else
        uncertain_[kept++] = span;
    }
    uncertain_.resize(kept);
  }
}

void ExactSlices::ask(UncertainSpan& span) {
  span.first_question = questions_.count;
  if (span.asks_first) questions_.add(span.light, span.slice, span.row, span.columns.first);
  if (span.asks_last && !(span.asks_first && span.columns.count() == 1))
    questions_.add(span.light, span.slice, span.row, span.columns.last);
}

bool ExactSlices::is_settled(UncertainSpan& span) const {
  std::uint32_t next = span.first_question;
  const auto touches = [&](int column) {
    const Touch touch = questions_.touch[next++];
    if (touch != Touch::uncertain) return touch == Touch::yes;
    BallJudge judge(frame_->grid, frame_->lights, span.light);
    return judge.touches(row_of(frame_->grid.screen(), span.slice, span.row), column);
  };
  IndexRange& columns = span.columns;
  const bool is_one = columns.count() == 1, asked_first = span.asks_first;
  if (span.asks_first) {
    span.asks_first = !touches(columns.first);
    if (span.asks_first) ++columns.first;
  }
  if (span.asks_last) {
    if (is_one && asked_first) {
      span.asks_last = false;
    } else {
      span.asks_last = !touches(columns.last);
      if (span.asks_last) --columns.last;
    }
  }
  // One column that one of the ends has been found to be is touched.
  if (columns.count() == 1 && !(span.asks_first && span.asks_last)) return true;
  return columns.empty() || !(span.asks_first || span.asks_last);
}

IndexRange ExactSlices::touched_anywhere(const UncertainSpan& span) const {
  const Row row = row_of(frame_->grid.screen(), span.slice, span.row);
  BallJudge judge(frame_->grid, frame_->lights, span.light);
  if (frame_->lights.reach[span.light] > k_most_exact_reach)
    return narrowed(span.columns, [&](int column) { return !judge.touches(row, column); });
  const RowColumns row_columns(frame_->grid.screen().tiles);
  const IndexRange outer =
      row_columns.touched(frame_->lights.ball(span.light, k_exact_roundoffs), row, geom::Errs::outward);
  if (outer.empty()) return {};
  std::uint64_t questions = 0;
  return settled(outer, row_columns, frame_->lights.ball(span.light, -k_exact_roundoffs), row, judge, questions);
}

}  // namespace clusterbench::assign
