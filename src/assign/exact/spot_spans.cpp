#include "assign/exact/spot_spans.h"

#include <algorithm>
#include <cmath>

#include "geom/single_precision/bounding_volumes.h"
#include "geom/single_precision/touch_tests.h"

namespace clusterbench::assign {

using grid::IndexRange;

void SpotSpans::find(const ExactFrame& frame, int first, int last) {
  frame_ = &frame;
  tests_ = fallbacks_ = 0;
  rows_.count = next_row_ = 0;
  cell_test_.reset();
  balls_.reset();
  if (frame.first_spot == frame.visible.count) return;
  slices_.count = 0;
  for (int slice = first; slice < last; ++slice)
    for (const std::uint32_t ball : frame.spots_of(slice))
      slices_.add(frame.visible.light[ball] - frame.lights.spots.first, static_cast<std::uint32_t>(slice));
  find_spot_rows(frame.lights, frame.planes, slices_, rows_);
  tests_ += rows_.count;
  decide_uncertain_rows();
}

void SpotSpans::decide_uncertain_rows() {
  collect_uncertain_spans();
  if (spans_.empty()) return;
  filter_contacts();
  filter_halves();
  refine_long_spans();
  constexpr int k_at_once = 4;
  while (collect_end_cells(k_at_once, [](const Span&) { return true; })) test_end_cells(true);
  for (const Span& span : spans_) {
    rows_.first[span.row] = span.columns.first;
    rows_.last[span.row] = span.columns.last;
  }
}

void SpotSpans::add_to(int slice, ListBuilder& spans) {
  for (; next_row_ < rows_.count && rows_.slice[next_row_] == static_cast<std::uint32_t>(slice); ++next_row_) {
    const std::int32_t first = rows_.first[next_row_], last = rows_.last[next_row_];
    if (first <= last)
      spans.add(rows_.row[next_row_], static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last),
                rows_.spot[next_row_] + frame_->lights.spots.first);
  }
}

std::size_t SpotSpans::capacity_bytes() const {
  return slices_.capacity_bytes() + rows_.capacity_bytes() + cells_.capacity_bytes() + contacts_.capacity_bytes() +
         bytes_of(uncertain_, spans_, end_cells_, halved_ends_, contact_runs_);
}

void SpotSpans::collect_uncertain_spans() {
  spans_.clear();
  const int last_column = frame_->planes.columns - 1;
  for (std::uint32_t i = 0; i < rows_.count; ++i) {
    const std::uint8_t proven = rows_.proven[i];
    if (proven == SpotRows::k_all) continue;
    const auto is = [&](std::uint8_t bit) { return (proven & bit) != 0; };
    spans_.push_back(
        {i,
         {is(SpotRows::k_none_before) ? rows_.first[i] : 0, is(SpotRows::k_none_after) ? rows_.last[i] : last_column},
         !is(SpotRows::k_none_before) || !is(SpotRows::k_first_is_touched),
         !is(SpotRows::k_none_after) || !is(SpotRows::k_last_is_touched),
         false});
  }
}

void SpotSpans::filter_contacts() {
  contact_runs_.clear();
  contacts_.runs.count = 0;
  for (std::uint32_t i = 0; i < spans_.size(); ++i) add_contact_tests(i);
  contacts_.test(frame_->lights, frame_->planes);
  tests_ += contact_runs_.size();
  for (std::uint32_t i = 0; i < contact_runs_.size(); ++i) apply_contact(contact_runs_[i], i);
}

void SpotSpans::add_contact_tests(std::uint32_t i) {
  const Span& span = spans_[i];
  const std::uint8_t proven = rows_.proven[span.row];
  const auto add_run = [&](Part part, const IndexRange& columns) {
    if (columns.empty()) return;
    contact_runs_.push_back({i, part});
    contacts_.runs.add(cells_of(span, columns));
  };
  const auto is = [&](std::uint8_t bit) { return (proven & bit) != 0; };
  const int first = rows_.first[span.row], last = rows_.last[span.row];
  if (span.left_is_uncertain && span.right_is_uncertain) return add_run(Part::whole, span.columns);
  if (span.left_is_uncertain && span.columns.holds(first)) {
    if (!is(SpotRows::k_none_before)) add_run(Part::before, {span.columns.first, first - 1});
    if (!is(SpotRows::k_first_is_touched)) add_run(Part::first, {first, first});
  }
  if (span.right_is_uncertain && span.columns.holds(last)) {
    if (!is(SpotRows::k_none_after)) add_run(Part::after, {last + 1, span.columns.last});
    if (!is(SpotRows::k_last_is_touched)) add_run(Part::last, {last, last});
  }
}

// The columns before (after) the first (last) guessed column are tested first: that column is an end only if none of
// them is touched.
void SpotSpans::apply_contact(const ContactRun& run, std::uint32_t index) {
  const Touch touch = contacts_.runs.touch[index];
  if (touch == Touch::uncertain) return;
  Span& span = spans_[run.span];
  IndexRange& columns = span.columns;
  const std::uint8_t proven = rows_.proven[span.row];
  const int first = rows_.first[span.row], last = rows_.last[span.row];
  const bool is_missed = touch == Touch::no;
  const IndexRange only = is_missed ? IndexRange{} : contacts_.only_touched_columns(index, frame_->planes);
  const bool is_known = is_missed || !only.empty();
  switch (run.part) {
    case Part::whole:
      if (!is_known) break;
      columns = only;
      span.left_is_uncertain = span.right_is_uncertain = false;
      break;
    case Part::before:
      if (!is_known) break;
      columns.first = is_missed ? first : only.first;
      span.left_is_uncertain = is_missed && (proven & SpotRows::k_first_is_touched) == 0;
      break;
    case Part::first:
      if (columns.first != first) break;
      columns.first += is_missed ? 1 : 0;
      span.left_is_uncertain = is_missed;
      break;
    case Part::after:
      if (!is_known) break;
      columns.last = is_missed ? last : only.last;
      span.right_is_uncertain = is_missed && (proven & SpotRows::k_last_is_touched) == 0;
      break;
    case Part::last:
      if (columns.last != last) break;
      columns.last -= is_missed ? 1 : 0;
      span.right_is_uncertain = is_missed;
      break;
  }
}

// Stage 2, filter. Removes columns that are untouched as a group: half of each span at each uncertain end; if that half
// is touched or uncertain, a quarter, and so on.
void SpotSpans::filter_halves() {
  uncertain_.clear();
  for (std::uint32_t i = 0; i < spans_.size(); ++i)
    if (spans_[i].is_uncertain()) uncertain_.push_back(i);
  halved_ends_.clear();
  for (const std::uint32_t i : uncertain_) {
    const int half = spans_[i].columns.count() / 2;
    if (half < k_least_columns) continue;
    if (spans_[i].left_is_uncertain) halved_ends_.push_back({i, half, true});
    if (spans_[i].right_is_uncertain) halved_ends_.push_back({i, half, false});
  }
  while (!halved_ends_.empty()) {
    cells_.count = 0;
    for (const HalvedEnd& run : halved_ends_) {
      const IndexRange& columns = spans_[run.span].columns;
      cells_.add(cells_of(spans_[run.span], run.from_left ? IndexRange{columns.first, columns.first + run.columns - 1}
                                                          : IndexRange{columns.last - run.columns + 1, columns.last}));
    }
    tests_ += cells_.count;
    filter_spot_cells(frame_->lights, frame_->planes, cells_);
    std::size_t kept = 0;
    for (std::size_t at = 0; at < halved_ends_.size(); ++at) {
      HalvedEnd run = halved_ends_[at];
      IndexRange& columns = spans_[run.span].columns;
      if (cells_.touch[at] != Touch::no)
        run.columns /= 2;
      else if (run.from_left)
        columns.first += run.columns;
      else
        columns.last -= run.columns;
      run.columns = std::min(run.columns, columns.count() / 2);
      if (run.columns >= k_least_columns) halved_ends_[kept++] = run;
    }
    halved_ends_.resize(kept);
  }
}

// Stage 3, refine, in scalar code: limits long spans to the columns of the spot's balls, then removes columns whose
// bounding ball the cone misses: the whole span if possible, otherwise halves, quarters and so on at the ends that the
// filter leaves uncertain.
void SpotSpans::refine_long_spans() {
  const RowColumns row_columns(frame_->grid.screen().tiles);
  for (const std::uint32_t i : uncertain_) {
    Span& span = spans_[i];
    IndexRange& columns = span.columns;
    span.is_refined = needs_refinement(span);
    if (!span.is_refined) continue;
    const IndexRange some = balls_of(light_of(span)).touched(row_columns, row_at(span.row));
    if (span.left_is_uncertain) columns.first = std::max(columns.first, some.first);
    if (span.right_is_uncertain) columns.last = std::min(columns.last, some.last);
    if (span.left_is_uncertain && span.right_is_uncertain && !columns.empty() && cone_misses(span, columns))
      columns = {};
  }
  if (collect_end_cells(1, [](const Span& span) { return span.is_refined; })) test_end_cells(false);
  for (const EndCells& ends : end_cells_) {
    Span& span = spans_[ends.span];
    IndexRange& columns = span.columns;
    const bool from_left = ends.from_left && span.left_is_uncertain;
    const bool from_right = ends.from_right && span.right_is_uncertain;
    for (int count = columns.count() / 2; from_left && count > 0; count = std::min(count, columns.count()))
      cone_misses(span, {columns.first, columns.first + count - 1}) ? columns.first += count : count /= 2;
    for (int count = columns.count() / 2; from_right && count > 0; count = std::min(count, columns.count()))
      cone_misses(span, {columns.last - count + 1, columns.last}) ? columns.last -= count : count /= 2;
  }
}

// Does the cone miss the bounding ball of these cells?
bool SpotSpans::cone_misses(const Span& span, const IndexRange& columns) {
  const grid::Tiles& tiles = frame_->grid.screen().tiles;
  geom::FrustumCell piece = piece_of(tiles, row_at(span.row), columns.first);
  piece.x1 = tiles.x[static_cast<std::size_t>(columns.last) + 1];
  return !geom::cone_touches_ball(balls_of(light_of(span)).cone(), geom::ball_around(piece));
}

// For spots outside the filter's range of sizes, and for cells smaller than its tolerance, the filter can at most prove
// contact.
bool SpotSpans::needs_refinement(const Span& span) const {
  constexpr int k_few_columns = 4;
  if (!span.is_uncertain() || span.columns.count() <= k_few_columns) return false;
  const std::uint32_t light = light_of(span);
  const geom::FrustumCell cell = piece_of(frame_->grid.screen().tiles, row_at(span.row), span.columns.first);
  return !std::isinf(frame_->lights.radius[light]) && !simd_filter_can_reject(light, cell);
}

// Collects up to `at_once` cells at each uncertain end of the selected spans into cells_. False if there are none.
template <class IsSelected>
bool SpotSpans::collect_end_cells(int at_once, IsSelected&& is_selected) {
  cells_.count = 0;
  end_cells_.clear();
  std::erase_if(uncertain_, [&](std::uint32_t i) { return !spans_[i].is_uncertain(); });
  for (const std::uint32_t i : uncertain_) {
    const Span& span = spans_[i];
    if (!is_selected(span)) continue;
    const int count = span.columns.count();
    if (span.left_is_uncertain && span.right_is_uncertain && count <= 2 * at_once) {
      add_end_cells(i, span.columns, true, true);
      continue;
    }
    const int some = std::min(count, at_once);
    if (span.left_is_uncertain) add_end_cells(i, {span.columns.first, span.columns.first + some - 1}, true, false);
    if (span.right_is_uncertain) add_end_cells(i, {span.columns.last - some + 1, span.columns.last}, false, true);
  }
  return !end_cells_.empty();
}

void SpotSpans::add_end_cells(std::uint32_t i, const IndexRange& columns, bool from_left, bool from_right) {
  end_cells_.push_back({i, cells_.count, columns, from_left, from_right});
  for (int column = columns.first; column <= columns.last; ++column) cells_.add(cells_of(spans_[i], {column, column}));
}

SpotCell SpotSpans::cells_of(const Span& span, const IndexRange& columns) const {
  return {rows_.spot[span.row], rows_.slice[span.row], rows_.row[span.row], static_cast<std::uint32_t>(columns.first),
          static_cast<std::uint32_t>(columns.last) + 1};
}

// Filters the collected cells; with `is_exact`, uncertain cells are then decided exactly.
void SpotSpans::test_end_cells(bool is_exact) {
  tests_ += cells_.count;
  filter_spot_cells(frame_->lights, frame_->planes, cells_);
  for (const EndCells& ends : end_cells_) shorten(ends, is_exact);
}

// Removes untouched cells from the span's ends. An end becomes certain at its first touched cell.
void SpotSpans::shorten(const EndCells& ends, bool is_exact) {
  Span& span = spans_[ends.span];
  const auto touch_of = [&](int column) {
    Touch& touch = cells_.touch[ends.first_cell + static_cast<std::uint32_t>(column - ends.columns.first)];
    if (touch == Touch::uncertain && is_exact) touch = decide_exactly(span.row, column) ? Touch::yes : Touch::no;
    return touch;
  };
  IndexRange& columns = span.columns;
  if (ends.from_left) {
    while (columns.first <= ends.columns.last && touch_of(columns.first) == Touch::no) ++columns.first;
    span.left_is_uncertain = columns.first > ends.columns.last || touch_of(columns.first) != Touch::yes;
  }
  if (ends.from_right) {
    const int end = std::max(ends.columns.first, columns.first);
    while (columns.last >= end && touch_of(columns.last) == Touch::no) --columns.last;
    span.right_is_uncertain = columns.last < end || touch_of(columns.last) != Touch::yes;
  }
}

bool SpotSpans::decide_exactly(std::uint32_t row, int column) {
  ++fallbacks_;
  const std::uint32_t light = rows_.spot[row] + frame_->lights.spots.first;
  if (!cell_test_ || cell_test_->light() != light) cell_test_.emplace(frame_->grid, frame_->lights, light);
  return cell_test_->touches(row_at(row).first_cell + static_cast<std::uint32_t>(column), is_in_filter_range(light));
}

bool SpotSpans::is_in_filter_range(std::uint32_t light) const {
  const float reach = frame_->lights.reach[light];
  return frame_->planes.least_reach <= reach && reach <= k_most_row_reach;
}

// Are cells like this one much wider than the filter's tolerance, so that it can reject the cells that are not touched?
bool SpotSpans::simd_filter_can_reject(std::uint32_t light, const geom::FrustumCell& cell) const {
  constexpr float k_much = 4.0f * 0x1p-19f;
  const float w = cell.orthographic ? 1.0f : cell.depth1;
  const float size =
      2.0f * frame_->lights.reach[light] + std::abs(cell.depth1) + w * (std::abs(cell.x0) + std::abs(cell.y0));
  return is_in_filter_range(light) && w * (cell.x1 - cell.x0) > k_much * size;
}

std::uint32_t SpotSpans::light_of(const Span& span) const {
  return rows_.spot[span.row] + frame_->lights.spots.first;
}

const SpotBalls& SpotSpans::balls_of(std::uint32_t light) {
  if (!balls_ || balls_->light() != light) balls_.emplace(frame_->lights, light);
  return *balls_;
}

Row SpotSpans::row_at(std::uint32_t row) const {
  return row_of(frame_->grid.screen(), static_cast<int>(rows_.slice[row]), static_cast<int>(rows_.row[row]));
}

}  // namespace clusterbench::assign
