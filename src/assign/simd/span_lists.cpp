#include "assign/simd/span_lists.h"

#include <limits>

#include "core/error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/simd/span_lists.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#ifndef CLUSTERBENCH_SPAN_LISTS_ONCE  // what all targets share
#define CLUSTERBENCH_SPAN_LISTS_ONCE
namespace clusterbench::assign {

// Sorted spans: row r has row_begin[r] .. row_begin[r + 1] - 1. Up to a vector more can be read.
struct SortedSpans {
  const std::uint32_t* row_begin;
  const std::uint32_t* lights;
  const std::int32_t* before;  // first column - 1
  const std::int32_t* after;   // last column + 1
  std::uint32_t rows, columns;
};

}  // namespace clusterbench::assign
#endif

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

// Writes the lights whose span holds each cell of a row to `to`, and where each cell's list begins. Up to a vector more
// than the lights is written. Returns the end.
std::uint32_t* write_row(const SortedSpans& spans, std::uint32_t row, std::uint32_t* to, const std::uint32_t* lists,
                         std::uint32_t* begin) {
  const hn::ScalableTag<std::int32_t> di;
  const hn::ScalableTag<std::uint32_t> du;
  const std::size_t lanes = hn::Lanes(du), first = spans.row_begin[row], count = spans.row_begin[row + 1] - first;
  for (std::uint32_t column = 0; column < spans.columns; ++column) {
    begin[column] = static_cast<std::uint32_t>(to - lists);
    const auto place = hn::Set(di, static_cast<std::int32_t>(column));
    for (std::size_t i = 0; i < count; i += lanes) {
      const auto before = hn::LoadU(di, spans.before + first + i), after = hn::LoadU(di, spans.after + first + i);
      const auto holds = hn::And(hn::Gt(place, before), hn::Gt(after, place));
      const auto wanted = hn::And(hn::RebindMask(du, holds), hn::FirstN(du, count - i));
      // Compressing in a register and storing it whole is faster than a compressing store.
      hn::StoreU(hn::Compress(hn::LoadU(du, spans.lights + first + i), wanted), du, to);
      to += hn::CountTrue(du, wanted);
    }
  }
  return to;
}

void write_lists(const SortedSpans& spans, std::uint32_t* lists, std::uint32_t* begin) {
  std::uint32_t* to = lists;
  for (std::uint32_t row = 0; row < spans.rows; ++row)
    to = write_row(spans, row, to, lists, begin + std::size_t{row} * spans.columns);
}

}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(target_name);
HWY_EXPORT(write_lists);

namespace {

constexpr std::size_t k_most_lanes = 64;  // of any target

}  // namespace

const char* simd_target_name() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

void SpanLists::start(std::uint32_t rows, std::uint32_t columns) {
  rows_ = rows;
  columns_ = columns;
  pairs_ = 0;
  spans_.clear();
}

// A counting sort; within a row lights stay in the order in which they came.
void SpanLists::sort_by_row() {
  row_begin_.assign(rows_ + std::size_t{1}, 0);
  for (const Span& span : spans_) ++row_begin_[span.row];
  std::uint32_t start = 0;
  for (std::uint32_t& entry : row_begin_) {
    const std::uint32_t count = entry;
    entry = start;
    start += count;
  }
  const std::size_t padded = spans_.size() + k_most_lanes;
  if (lights_.size() < padded) {
    lights_.resize(padded);
    before_.resize(padded);
    after_.resize(padded);
  }
  for (const Span& span : spans_) {
    const std::uint32_t place = row_begin_[span.row]++;
    lights_[place] = span.light;
    before_[place] = static_cast<std::int32_t>(span.columns & 0xffff) - 1;
    after_[place] = static_cast<std::int32_t>(span.columns >> 16) + 1;
  }
  for (std::size_t row = rows_; row > 0; --row) row_begin_[row] = row_begin_[row - 1];
  row_begin_[0] = 0;
}

void SpanLists::finish(Lists& out) {
  if (pairs_ > std::numeric_limits<std::uint32_t>::max())
    throw Error("", "lists", "hold " + std::to_string(pairs_) + " pairs; at most 2^32 - 1 fit", ExitCode::internal);
  sort_by_row();
  out.begin.resize(std::size_t{rows_} * columns_ + 1);
  out.lights.resize(pairs_ + k_most_lanes);
  const SortedSpans sorted{row_begin_.data(), lights_.data(), before_.data(), after_.data(), rows_, columns_};
  HWY_DYNAMIC_DISPATCH(write_lists)(sorted, out.lights.data(), out.begin.data());
  out.begin.back() = static_cast<std::uint32_t>(pairs_);
  out.lights.resize(pairs_);
}

std::size_t SpanLists::capacity_bytes() const {
  return spans_.capacity() * sizeof(Span) +
         (row_begin_.capacity() + lights_.capacity() + before_.capacity() + after_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace clusterbench::assign
#endif
