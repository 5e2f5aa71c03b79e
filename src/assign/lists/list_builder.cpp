#include "assign/lists/list_builder.h"

#include <algorithm>
#include <numeric>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/lists/list_builder.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/simd/compress-inl.h"
#include "core/memory.h"

#ifndef CLUSTERBENCH_SPAN_LISTS_ONCE  // what all targets share
#define CLUSTERBENCH_SPAN_LISTS_ONCE
namespace clusterbench::assign {

// Where spans are added; row r begins at r * pitch.
struct SpanRows {
  std::uint32_t *sizes, *lights, *columns;  // lights: null where they are in the spans (LightSpan)
  std::size_t pitch;
};

// What became of a batch: how many pairs its spans make; whether some rows were left alone.
struct Added {
  std::uint64_t pairs;
  bool some_are_left;
};

}  // namespace clusterbench::assign
#endif

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

using DU = hn::ScalableTag<std::uint32_t>;
using VU = hn::Vec<DU>;

// As LightSpan has it.
HWY_INLINE VU light_spans(VU span, VU light) {
  const DU du;
  const VU first = And(span, Set(du, 0xff)), last = And(hn::ShiftRight<8>(span), Set(du, 0xff00));
  return Or(Or(first, last), hn::ShiftLeft<16>(light));
}

// Adds one vector of spans per row.
template <bool are_lights_in_spans>
HWY_INLINE Added add_spans(SpanRows rows, int first_row, int last_row, const std::uint32_t* columns,
                           const std::uint32_t* lights, std::uint8_t* is_left) {
  const hn::ScalableTag<std::uint32_t> du;
  const std::size_t lanes = Lanes(du);
  const auto light = LoadU(du, lights), none = Set(du, ListBuilder::k_no_span);
  const auto half = Set(du, 0xffff);
  auto beyond = Zero(du);  // how many columns a span has behind its first one
  Added added{0, false};
  for (int row = first_row; row <= last_row; ++row) {
    const auto r = static_cast<std::size_t>(row);
    const auto span = LoadU(du, columns + r * lanes);
    const auto wanted = Ne(span, none);
    const auto uncertain = TestBit(span, Set(du, ListBuilder::k_uncertain_span));
    is_left[r] = AllFalse(du, And(wanted, uncertain)) ? 0 : 1;
    if (is_left[r] != 0) {
      added.some_are_left = true;
      continue;
    }
    const std::size_t to = r * rows.pitch + rows.sizes[r];
    const auto count = static_cast<std::uint32_t>(CountTrue(du, wanted));
    if constexpr (are_lights_in_spans) {
      StoreU(compressed(du, light_spans(span, light), wanted), du, rows.columns + to);
    } else {
      StoreU(compressed(du, light, wanted), du, rows.lights + to);
      StoreU(compressed(du, span, wanted), du, rows.columns + to);
    }
    rows.sizes[r] += count;
    added.pairs += count;
    beyond = beyond + IfThenElseZero(wanted, ShiftRight<16>(span) - And(span, half));
  }
  // A lane's sum is below 2^32, as a grid has no more cells; that of all lanes is where rows are not too many.
  constexpr auto k_few_rows = static_cast<int>(UINT32_MAX / (k_row_lanes * ColumnSpan::k_most_columns));
  if (last_row - first_row < k_few_rows) {
    added.pairs += GetLane(SumOfLanes(du, beyond));
    return added;
  }
  added.pairs += GetLane(SumOfLanes(du, And(beyond, half)));
  added.pairs += std::uint64_t{GetLane(SumOfLanes(du, ShiftRight<16>(beyond)))} << 16;
  return added;
}

Added add_rows(SpanRows rows, int first_row, int last_row, const std::uint32_t* columns, const std::uint32_t* lights,
               std::uint8_t* is_left) {
  return rows.lights == nullptr ? add_spans<true>(rows, first_row, last_row, columns, lights, is_left)
                                : add_spans<false>(rows, first_row, last_row, columns, lights, is_left);
}

// Adds to each row the next sizes[row] spans. Returns how many pairs these make.
template <bool are_lights_in_spans>
HWY_INLINE std::uint64_t add_listed_spans(SpanRows rows, int first_row, int last_row, const std::uint32_t* sizes,
                                          const std::uint32_t* columns, const std::uint32_t* lights) {
  const hn::ScalableTag<std::uint32_t> du;
  std::uint32_t from = 0;
  for (int row = first_row; row <= last_row; ++row) {
    const auto r = static_cast<std::size_t>(row);
    const std::size_t to = r * rows.pitch + rows.sizes[r];
    const VU span = LoadU(du, columns + from), light = LoadU(du, lights + from);
    if constexpr (are_lights_in_spans) {
      StoreU(light_spans(span, light), du, rows.columns + to);
    } else {
      StoreU(span, du, rows.columns + to);
      StoreU(light, du, rows.lights + to);
    }
    rows.sizes[r] += sizes[r];
    from += sizes[r];
  }
  const auto none = Set(du, ListBuilder::k_no_span), half = Set(du, 0xffff), one = Set(du, 1);
  auto sum = Zero(du);
  for (std::uint32_t i = 0; i < from; i += static_cast<std::uint32_t>(Lanes(du))) {
    const auto span = LoadU(du, columns + i);
    const auto wanted = And(FirstN(du, from - i), Ne(span, none));
    sum = sum + IfThenElseZero(wanted, ShiftRight<16>(span) - And(span, half) + one);
  }
  // As in add_rows.
  const std::uint64_t low = GetLane(SumOfLanes(du, And(sum, half)));
  return low + (std::uint64_t{GetLane(SumOfLanes(du, ShiftRight<16>(sum)))} << 16);
}

std::uint64_t add_listed(SpanRows rows, int first_row, int last_row, const std::uint32_t* sizes,
                         const std::uint32_t* columns, const std::uint32_t* lights) {
  return rows.lights == nullptr ? add_listed_spans<true>(rows, first_row, last_row, sizes, columns, lights)
                                : add_listed_spans<false>(rows, first_row, last_row, sizes, columns, lights);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(target_name);
HWY_EXPORT(add_rows);
HWY_EXPORT(add_listed);

const char* simd_target_name() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

void ListBuilder::start(std::uint32_t bands, std::uint32_t rows, std::uint32_t columns, std::uint32_t lights,
                        Lists& out) {
  const bool is_light_in_span = columns <= LightSpan::k_most_columns && lights <= LightSpan::k_most_lights;
  if (rows != rows_ || is_light_in_span != is_light_in_span_) {
    rows_ = rows;
    is_light_in_span_ = is_light_in_span;
    pitch_ = 0;
  }
  columns_ = columns;
  band_ = 0;
  pairs_ = band_pairs_ = 0;
  most_ = 0;
  out_ = &out;
  sizes_.assign(rows, 0);
  if (pitch_ == 0) grow();
  check_memory("lists of cells", std::uint64_t{bands} * rows * columns + 1, sizeof(std::uint32_t));
  out.begin.resize(std::size_t{bands} * rows * columns + 1);
}

void ListBuilder::grow() {
  // An odd number of cache lines, so that rows do not compete for the same places of a cache.
  const std::size_t wider = 2 * pitch_ + 16;
  const std::size_t lists = is_light_in_span_ ? 1 : 2;
  check_memory("spans of light lists", rows_ * wider + k_most_lanes, lists * sizeof(std::uint32_t));
  const auto widen = [&](auto& list) {
    list.resize(rows_ * wider + k_most_lanes);
    for (std::size_t row = rows_; row-- > 1;)
      std::copy_backward(list.begin() + static_cast<std::ptrdiff_t>(row * pitch_),
                         list.begin() + static_cast<std::ptrdiff_t>(row * pitch_ + sizes_[row]),
                         list.begin() + static_cast<std::ptrdiff_t>(row * wider + sizes_[row]));
  };
  if (!is_light_in_span_) widen(lights_);
  widen(columns_of_);
  pitch_ = wider;
}

// So that each row can take some more spans.
void ListBuilder::make_room(std::uint32_t spans) {
  most_ += spans;
  if (most_ <= pitch_) return;
  most_ = *std::max_element(sizes_.begin(), sizes_.end()) + spans;
  while (most_ > pitch_) grow();
}

SpanRows ListBuilder::span_rows() {
  return {sizes_.data(), is_light_in_span_ ? nullptr : lights_.data(), columns_of_.data(), pitch_};
}

bool ListBuilder::add_batch(int first_row, int last_row, const std::uint32_t* columns, const std::uint32_t* lights,
                            std::uint8_t* is_left) {
  make_room(k_row_lanes);
  const SpanRows rows = span_rows();
  const Added added = HWY_DYNAMIC_DISPATCH(add_rows)(rows, first_row, last_row, columns, lights, is_left);
  band_pairs_ += added.pairs;
  return added.some_are_left;
}

void ListBuilder::add_rows(int first_row, int last_row, const std::uint32_t* sizes, const std::uint32_t* columns,
                           const std::uint32_t* lights) {
  make_room(k_row_lanes);
  const SpanRows rows = span_rows();
  band_pairs_ += HWY_DYNAMIC_DISPATCH(add_listed)(rows, first_row, last_row, sizes, columns, lights);
}

// The row's lists, but for the hole's columns.
template <class Row>
std::uint32_t* ListBuilder::write_row(Row spans, const grid::IndexRange& hole, std::uint32_t* begin,
                                      std::uint32_t* to) {
  const std::uint32_t* lists = out_->lights.data();
  if (!hole.empty()) {
    spans.end_column = static_cast<std::uint32_t>(hole.first);
    to = write_row_lists(spans, few_, to, lists, begin);
    std::fill_n(begin + hole.first, hole.count(), static_cast<std::uint32_t>(to - lists));
    spans.column = static_cast<std::uint32_t>(hole.last) + 1;
    spans.end_column = columns_;
  }
  return write_row_lists(spans, few_, to, lists, begin);
}

std::uint32_t* ListBuilder::finish_row(std::uint32_t row, const grid::IndexRange& hole, std::uint32_t* begin,
                                       std::uint32_t* to) {
  const std::uint32_t size = sizes_[row];
  if (size == 0) {
    std::fill_n(begin, columns_, static_cast<std::uint32_t>(to - out_->lights.data()));
    return to;
  }
  const std::uint32_t* columns = columns_of_.data() + row * pitch_;
  if (is_light_in_span_) return write_row(RowLightSpans{columns, size, 0, columns_, width_}, hole, begin, to);
  const std::uint32_t* lights = lights_.data() + row * pitch_;
  return write_row(RowSpans<std::uint32_t>{lights, columns, size, 0, columns_, width_}, hole, begin, to);
}

void ListBuilder::finish_band(const BandHole& hole) {
  make_room(k_row_lanes);  // as a last batch would have, so that memory does not depend on how many lights a batch has
  std::vector<std::uint32_t>& lists = out_->lights;
  const std::size_t needed = pairs_ + band_pairs_ + k_most_lanes;
  // No further than this band: what is beyond the old size is filled with zeros before it is written.
  if (lists.size() < needed) {
    check_memory("pairs of light lists", needed, sizeof(std::uint32_t));
    check_pair_count(pairs_ + band_pairs_);
    lists.resize(needed);
  }
  std::uint32_t* begin = out_->begin.data() + std::size_t{band_} * rows_ * columns_;
  std::uint32_t* to = lists.data() + pairs_;
  const std::uint64_t spans = std::accumulate(sizes_.begin(), sizes_.end(), std::uint64_t{0});
  width_ = spans == 0 ? 0 : static_cast<std::uint32_t>(band_pairs_ / spans);
  for (std::uint32_t row = 0; row < rows_; ++row, begin += columns_)
    to = finish_row(row, hole.rows.holds(static_cast<int>(row)) ? hole.columns : grid::IndexRange{}, begin, to);
  std::fill(sizes_.begin(), sizes_.end(), 0);
  pairs_ = static_cast<std::uint64_t>(to - lists.data());
  band_pairs_ = 0;
  most_ = 0;
  ++band_;
}

void ListBuilder::finish() {
  out_->begin.back() = static_cast<std::uint32_t>(pairs_);
  out_->lights.resize(pairs_);
}

std::size_t ListBuilder::capacity_bytes() const {
  return (sizes_.capacity() + lights_.capacity() + columns_of_.capacity()) * sizeof(std::uint32_t) +
         few_.capacity_bytes();
}

}  // namespace clusterbench::assign
#endif
