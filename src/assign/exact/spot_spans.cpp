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
  judge_.reset();
  balls_.reset();
  if (frame.first_spot == frame.visible.count) return;
  slices_.count = 0;
  for (int slice = first; slice < last; ++slice)
    for (const std::uint32_t ball : frame.spots_of(slice))
      slices_.add(frame.visible.light[ball] - frame.lights.spots.first, static_cast<std::uint32_t>(slice));
  find_spot_rows(frame.lights, frame.planes, slices_, rows_);
  tests_ += rows_.count;
  settle_uncertain_rows();
}

void SpotSpans::settle_uncertain_rows() {
  take_uncertain_rows();
  if (spans_.empty()) return;
  settle_touches();
  shorten();
  narrow();
  constexpr int k_at_once = 4;
  while (ask_for_ends(k_at_once, [](const Span&) { return true; })) settle_ends(true);
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
  return slices_.capacity_bytes() + rows_.capacity_bytes() + cells_.capacity_bytes() + touches_.capacity_bytes() +
         bytes_of(uncertain_, spans_, ends_, long_, runs_);
}

void SpotSpans::take_uncertain_rows() {
  spans_.clear();
  const int last_column = frame_->planes.columns - 1;
  for (std::uint32_t i = 0; i < rows_.count; ++i) {
    const std::uint8_t known = rows_.known[i];
    if (known == SpotRows::k_all) continue;
    const auto is = [&](std::uint8_t bit) { return (known & bit) != 0; };
    spans_.push_back(
        {i,
         {is(SpotRows::k_none_before) ? rows_.first[i] : 0, is(SpotRows::k_none_behind) ? rows_.last[i] : last_column},
         !is(SpotRows::k_none_before) || !is(SpotRows::k_first_is_touched),
         !is(SpotRows::k_none_behind) || !is(SpotRows::k_last_is_touched),
         false});
  }
}

void SpotSpans::settle_touches() {
  runs_.clear();
  touches_.runs.count = 0;
  for (std::uint32_t i = 0; i < spans_.size(); ++i) ask_for_touches(i);
  touches_.look(frame_->lights, frame_->planes);
  tests_ += runs_.size();
  for (std::uint32_t i = 0; i < runs_.size(); ++i) take_touch(runs_[i], i);
}

void SpotSpans::ask_for_touches(std::uint32_t i) {
  const Span& span = spans_[i];
  const std::uint8_t known = rows_.known[span.row];
  const auto ask = [&](Part part, const IndexRange& columns) {
    if (columns.empty()) return;
    runs_.push_back({i, part});
    touches_.runs.add(cells_of(span, columns));
  };
  const auto is = [&](std::uint8_t bit) { return (known & bit) != 0; };
  const int first = rows_.first[span.row], last = rows_.last[span.row];
  if (span.left_is_uncertain && span.right_is_uncertain) return ask(Part::whole, span.columns);
  if (span.left_is_uncertain && span.columns.holds(first)) {
    if (!is(SpotRows::k_none_before)) ask(Part::before, {span.columns.first, first - 1});
    if (!is(SpotRows::k_first_is_touched)) ask(Part::first, {first, first});
  }
  if (span.right_is_uncertain && span.columns.holds(last)) {
    if (!is(SpotRows::k_none_behind)) ask(Part::behind, {last + 1, span.columns.last});
    if (!is(SpotRows::k_last_is_touched)) ask(Part::last, {last, last});
  }
}

// What is before (behind) the first (last) column was asked before that column, which is an end only where nothing
// there is touched.
void SpotSpans::take_touch(const Run& run, std::uint32_t index) {
  const Touch touch = touches_.runs.touch[index];
  if (touch == Touch::uncertain) return;
  Span& span = spans_[run.span];
  IndexRange& columns = span.columns;
  const std::uint8_t known = rows_.known[span.row];
  const int first = rows_.first[span.row], last = rows_.last[span.row];
  const bool is_missed = touch == Touch::no;
  const IndexRange only = is_missed ? IndexRange{} : touches_.only_columns(index, frame_->planes);
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
      span.left_is_uncertain = is_missed && (known & SpotRows::k_first_is_touched) == 0;
      break;
    case Part::first:
      if (columns.first != first) break;
      columns.first += is_missed ? 1 : 0;
      span.left_is_uncertain = is_missed;
      break;
    case Part::behind:
      if (!is_known) break;
      columns.last = is_missed ? last : only.last;
      span.right_is_uncertain = is_missed && (known & SpotRows::k_last_is_touched) == 0;
      break;
    case Part::last:
      if (columns.last != last) break;
      columns.last -= is_missed ? 1 : 0;
      span.right_is_uncertain = is_missed;
      break;
  }
}

// Takes away what a quick look at several columns at once can tell is not touched: half of each span at its uncertain
// ends, where they are touched or in doubt a quarter, and so on.
void SpotSpans::shorten() {
  uncertain_.clear();
  for (std::uint32_t i = 0; i < spans_.size(); ++i)
    if (spans_[i].is_uncertain()) uncertain_.push_back(i);
  long_.clear();
  for (const std::uint32_t i : uncertain_) {
    const int half = spans_[i].columns.count() / 2;
    if (half < k_least_columns) continue;
    if (spans_[i].left_is_uncertain) long_.push_back({i, half, true});
    if (spans_[i].right_is_uncertain) long_.push_back({i, half, false});
  }
  while (!long_.empty()) {
    cells_.count = 0;
    for (const Long& run : long_) {
      const IndexRange& columns = spans_[run.span].columns;
      cells_.add(cells_of(spans_[run.span], run.from_left ? IndexRange{columns.first, columns.first + run.columns - 1}
                                                          : IndexRange{columns.last - run.columns + 1, columns.last}));
    }
    tests_ += cells_.count;
    look_at_cells(frame_->lights, frame_->planes, cells_);
    std::size_t kept = 0;
    for (std::size_t at = 0; at < long_.size(); ++at) {
      Long run = long_[at];
      IndexRange& columns = spans_[run.span].columns;
      if (cells_.touch[at] != Touch::no)
        run.columns /= 2;
      else if (run.from_left)
        columns.first += run.columns;
      else
        columns.last -= run.columns;
      run.columns = std::min(run.columns, columns.count() / 2);
      if (run.columns >= k_least_columns) long_[kept++] = run;
    }
    long_.resize(kept);
  }
}

// Cuts long spans down to the columns of the spot's balls, and takes away what the cone misses with a ball around it,
// in scalar code: all at once if it can; what vectors do not tell to be touched then by halves, quarters and so on.
void SpotSpans::narrow() {
  const RowColumns row_columns(frame_->grid.screen().tiles);
  for (const std::uint32_t i : uncertain_) {
    Span& span = spans_[i];
    IndexRange& columns = span.columns;
    span.is_narrowed = is_to_be_narrowed(span);
    if (!span.is_narrowed) continue;
    const IndexRange some = balls_of(light_of(span)).touched(row_columns, row_at(span.row));
    if (span.left_is_uncertain) columns.first = std::max(columns.first, some.first);
    if (span.right_is_uncertain) columns.last = std::min(columns.last, some.last);
    if (span.left_is_uncertain && span.right_is_uncertain && !columns.empty() && is_missed(span, columns)) columns = {};
  }
  if (ask_for_ends(1, [](const Span& span) { return span.is_narrowed; })) settle_ends(false);
  for (const Ends& ends : ends_) {
    Span& span = spans_[ends.span];
    IndexRange& columns = span.columns;
    const bool from_left = ends.from_left && span.left_is_uncertain;
    const bool from_right = ends.from_right && span.right_is_uncertain;
    for (int count = columns.count() / 2; from_left && count > 0; count = std::min(count, columns.count()))
      is_missed(span, {columns.first, columns.first + count - 1}) ? columns.first += count : count /= 2;
    for (int count = columns.count() / 2; from_right && count > 0; count = std::min(count, columns.count()))
      is_missed(span, {columns.last - count + 1, columns.last}) ? columns.last -= count : count /= 2;
  }
}

// By the cone with a ball around these cells?
bool SpotSpans::is_missed(const Span& span, const IndexRange& columns) {
  const grid::Tiles& tiles = frame_->grid.screen().tiles;
  geom::FrustumCell piece = piece_of(tiles, row_at(span.row), columns.first);
  piece.x1 = tiles.x[static_cast<std::size_t>(columns.last) + 1];
  return !geom::cone_touches_ball(balls_of(light_of(span)).cone(), geom::ball_around(piece));
}

// Of spots far larger or smaller than what vectors are for, and of cells smaller than their tolerance, these prove at
// most that they are touched.
bool SpotSpans::is_to_be_narrowed(const Span& span) const {
  constexpr int k_few_columns = 4;
  if (!span.is_uncertain() || span.columns.count() <= k_few_columns) return false;
  const std::uint32_t light = light_of(span);
  const geom::FrustumCell cell = piece_of(frame_->grid.screen().tiles, row_at(span.row), span.columns.first);
  return !std::isinf(frame_->lights.radius[light]) && !vectors_tell(light, cell);
}

// Puts so many cells at each of the uncertain ends of the wanted spans into cells_. False if there are none.
template <class IsWanted>
bool SpotSpans::ask_for_ends(int at_once, IsWanted&& is_wanted) {
  cells_.count = 0;
  ends_.clear();
  std::erase_if(uncertain_, [&](std::uint32_t i) { return !spans_[i].is_uncertain(); });
  for (const std::uint32_t i : uncertain_) {
    const Span& span = spans_[i];
    if (!is_wanted(span)) continue;
    const int count = span.columns.count();
    if (span.left_is_uncertain && span.right_is_uncertain && count <= 2 * at_once) {
      ask(i, span.columns, true, true);
      continue;
    }
    const int some = std::min(count, at_once);
    if (span.left_is_uncertain) ask(i, {span.columns.first, span.columns.first + some - 1}, true, false);
    if (span.right_is_uncertain) ask(i, {span.columns.last - some + 1, span.columns.last}, false, true);
  }
  return !ends_.empty();
}

void SpotSpans::ask(std::uint32_t i, const IndexRange& columns, bool from_left, bool from_right) {
  ends_.push_back({i, cells_.count, columns, from_left, from_right});
  for (int column = columns.first; column <= columns.last; ++column) cells_.add(cells_of(spans_[i], {column, column}));
}

SpotCell SpotSpans::cells_of(const Span& span, const IndexRange& columns) const {
  return {rows_.spot[span.row], rows_.slice[span.row], rows_.row[span.row], static_cast<std::uint32_t>(columns.first),
          static_cast<std::uint32_t>(columns.last) + 1};
}

// Looks at the cells that were asked for; what that leaves uncertain is decided, if it is to be.
void SpotSpans::settle_ends(bool to_be_decided) {
  tests_ += cells_.count;
  look_at_cells(frame_->lights, frame_->planes, cells_);
  for (const Ends& ends : ends_) settle(ends, to_be_decided);
}

// Shortens the span by its cells that are not touched. An end is settled where one is.
void SpotSpans::settle(const Ends& ends, bool to_be_decided) {
  Span& span = spans_[ends.span];
  const auto touch_of = [&](int column) {
    Touch& touch = cells_.touch[ends.first_cell + static_cast<std::uint32_t>(column - ends.columns.first)];
    if (touch == Touch::uncertain && to_be_decided) touch = decide(span.row, column) ? Touch::yes : Touch::no;
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

bool SpotSpans::decide(std::uint32_t row, int column) {
  ++fallbacks_;
  const std::uint32_t light = rows_.spot[row] + frame_->lights.spots.first;
  if (!judge_ || judge_->light() != light) judge_.emplace(frame_->grid, frame_->lights, light);
  return judge_->touches(row_at(row).first_cell + static_cast<std::uint32_t>(column), is_plain(light));
}

bool SpotSpans::is_plain(std::uint32_t light) const {
  const float reach = frame_->lights.reach[light];
  return frame_->planes.least_reach <= reach && reach <= k_most_row_reach;
}

// Are cells like this one so much wider than what evidence must be larger than that looks tell the missed ones?
bool SpotSpans::vectors_tell(std::uint32_t light, const geom::FrustumCell& cell) const {
  constexpr float k_much = 4.0f * 0x1p-19f;
  const float w = cell.orthographic ? 1.0f : cell.depth1;
  const float size =
      2.0f * frame_->lights.reach[light] + std::abs(cell.depth1) + w * (std::abs(cell.x0) + std::abs(cell.y0));
  return is_plain(light) && w * (cell.x1 - cell.x0) > k_much * size;
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
