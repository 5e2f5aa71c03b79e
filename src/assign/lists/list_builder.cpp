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
  std::uint32_t *sizes, *lights, *columns;
  std::size_t pitch;
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

// Adds one vector of spans per row. Returns whether some rows were left alone.
bool add_batch_rows(const SpanRows& rows, int first_row, int last_row, const std::uint32_t* columns,
                    const std::uint32_t* lights, std::uint8_t* is_left) {
  const DU du;
  const VU light = LoadU(du, lights), none = Set(du, ListBuilder::k_no_span);
  bool some_are_left = false;
  for (int row = first_row; row <= last_row; ++row) {
    const auto r = static_cast<std::size_t>(row);
    const VU span = LoadU(du, columns + r * Lanes(du));
    const auto wanted = Ne(span, none);
    const auto uncertain = TestBit(span, Set(du, ListBuilder::k_uncertain_span));
    is_left[r] = AllFalse(du, And(wanted, uncertain)) ? 0 : 1;
    if (is_left[r] != 0) {
      some_are_left = true;
      continue;
    }
    const std::size_t to = r * rows.pitch + rows.sizes[r];
    StoreU(compressed(du, light, wanted), du, rows.lights + to);
    StoreU(compressed(du, span, wanted), du, rows.columns + to);
    rows.sizes[r] += static_cast<std::uint32_t>(CountTrue(du, wanted));
  }
  return some_are_left;
}

// Adds to each row the next sizes[row] spans.
void add_listed_rows(const SpanRows& rows, int first_row, int last_row, const std::uint32_t* sizes,
                     const std::uint32_t* columns, const std::uint32_t* lights) {
  const DU du;
  const SpanRows to = rows;  // a copy, which stays in registers: no store can change it
  std::size_t begin = static_cast<std::size_t>(first_row) * to.pitch;
  for (int row = first_row; row <= last_row; ++row, begin += to.pitch) {
    const std::uint32_t size = sizes[row], earlier = to.sizes[row];
    StoreU(LoadU(du, columns), du, to.columns + begin + earlier);
    StoreU(LoadU(du, lights), du, to.lights + begin + earlier);
    to.sizes[row] = earlier + size;
    columns += size;
    lights += size;
  }
}

// How many columns all spans have.
std::uint64_t pairs_of(const SpanRows& rows, std::uint32_t row_count) {
  const DU du;
  const VU none = Set(du, ListBuilder::k_no_span), half = Set(du, 0xffff), one = Set(du, 1);
  // A lane's sum of so many vectors is below 2^32, and so is that of all lanes' halves.
  constexpr std::uint32_t k_most_vectors = UINT32_MAX / (ColumnSpan::k_most_columns + 1);
  std::uint64_t total = 0;
  std::uint32_t vectors = 0;
  VU sum = Zero(du);
  const auto flush = [&] {
    total += GetLane(SumOfLanes(du, And(sum, half)));
    total += std::uint64_t{GetLane(SumOfLanes(du, hn::ShiftRight<16>(sum)))} << 16;
    sum = Zero(du);
    vectors = 0;
  };
  for (std::uint32_t row = 0; row < row_count; ++row) {
    const std::uint32_t* spans = rows.columns + row * rows.pitch;
    const std::uint32_t size = rows.sizes[row];
    for (std::uint32_t i = 0; i < size; i += static_cast<std::uint32_t>(Lanes(du))) {
      const VU span = LoadU(du, spans + i);
      const auto wanted = And(FirstN(du, size - i), Ne(span, none));
      sum = sum + IfThenElseZero(wanted, hn::ShiftRight<16>(span) - And(span, half) + one);
      if (++vectors == k_most_vectors) flush();
    }
  }
  flush();
  return total;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(target_name);
HWY_EXPORT(add_batch_rows);
HWY_EXPORT(add_listed_rows);
HWY_EXPORT(pairs_of);

const char* simd_target_name() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

void ListBuilder::start(std::uint32_t bands, std::uint32_t rows, std::uint32_t columns, Lists& out) {
  if (rows != rows_) {
    rows_ = rows;
    pitch_ = 0;
  }
  columns_ = columns;
  band_ = 0;
  pairs_ = 0;
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
  check_memory("spans of light lists", rows_ * wider + k_most_lanes, 2 * sizeof(std::uint32_t));
  const auto widen = [&](auto& list) {
    list.resize(rows_ * wider + k_most_lanes);
    for (std::size_t row = rows_; row-- > 1;)
      std::copy_backward(list.begin() + static_cast<std::ptrdiff_t>(row * pitch_),
                         list.begin() + static_cast<std::ptrdiff_t>(row * pitch_ + sizes_[row]),
                         list.begin() + static_cast<std::ptrdiff_t>(row * wider + sizes_[row]));
  };
  widen(lights_);
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
  return {sizes_.data(), lights_.data(), columns_of_.data(), pitch_};
}

bool ListBuilder::add_batch(int first_row, int last_row, const std::uint32_t* columns, const std::uint32_t* lights,
                            std::uint8_t* is_left) {
  make_room(k_row_lanes);
  const SpanRows rows = span_rows();
  return HWY_DYNAMIC_DISPATCH(add_batch_rows)(rows, first_row, last_row, columns, lights, is_left);
}

void ListBuilder::add_rows(int first_row, int last_row, const std::uint32_t* sizes, const std::uint32_t* columns,
                           const std::uint32_t* lights) {
  make_room(k_row_lanes);
  const SpanRows rows = span_rows();
  HWY_DYNAMIC_DISPATCH(add_listed_rows)(rows, first_row, last_row, sizes, columns, lights);
}

void ListBuilder::finish_band(const BandHole& hole) {
  make_room(k_row_lanes);  // as a last batch would have, so that memory does not depend on how many lights a batch has
  std::vector<std::uint32_t>& lists = out_->lights;
  const std::uint64_t band_pairs = HWY_DYNAMIC_DISPATCH(pairs_of)(span_rows(), rows_);
  const std::size_t needed = pairs_ + band_pairs + k_most_lanes;
  // No further than this band: what is beyond the old size is filled with zeros before it is written.
  if (lists.size() < needed) {
    check_memory("pairs of light lists", needed, sizeof(std::uint32_t));
    check_pair_count(pairs_ + band_pairs);
    lists.resize(needed);
  }
  std::uint32_t* begin = out_->begin.data() + std::size_t{band_} * rows_ * columns_;
  std::uint32_t* to = lists.data() + pairs_;
  const std::uint64_t spans = std::accumulate(sizes_.begin(), sizes_.end(), std::uint64_t{0});
  const std::uint32_t width = spans == 0 ? 0 : static_cast<std::uint32_t>(band_pairs / spans);
  const SpanRows rows = span_rows();
  to = write_band_lists({rows.sizes, rows.columns, rows.lights, pitch_, rows_, columns_, width}, hole, few_, to,
                        lists.data(), begin);
  std::fill(sizes_.begin(), sizes_.end(), 0);
  pairs_ = static_cast<std::uint64_t>(to - lists.data());
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
