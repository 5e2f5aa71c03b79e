#include "assign/simd/row_lists.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/simd/row_lists.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

// A vector of spans.
template <class Index>
struct Spans {
  using DI = hn::ScalableTag<typename RowSpans<Index>::Column>;
  using DU = hn::ScalableTag<Index>;

  const Index* from;
  hn::Vec<DU> lights;
  hn::Vec<DI> before, after;
  hn::Mask<DU> exist;

  HWY_INLINE Spans(const RowSpans<Index>& row, std::size_t first) : from(row.lights + first) {
    lights = hn::LoadU(DU(), from);
    before = hn::LoadU(DI(), row.before + first);
    after = hn::LoadU(DI(), row.after + first);
    exist = hn::FirstN(DU(), row.count - first);
  }

  // Appends the lights whose span holds a column. Up to a vector more than these is written.
  HWY_INLINE Index* write(std::uint32_t column, Index* to) const {
    const auto place = hn::Set(DI(), static_cast<typename RowSpans<Index>::Column>(column));
    const auto holds = hn::RebindMask(DU(), hn::And(hn::Gt(place, before), hn::Gt(after, place)));
    return append(DU(), from, lights, hn::And(holds, exist), to);
  }
};

template <class Index>
HWY_INLINE Index* lists_of(const RowSpans<Index>& row, Index* to, const Index* lists, std::uint32_t* begin) {
  const std::size_t lanes = hn::Lanes(hn::ScalableTag<Index>());
  const auto each_column = [&](auto&& write) {
    for (std::uint32_t column = row.column; column < row.end_column; ++column) {
      begin[column] = static_cast<std::uint32_t>(to - lists);
      write(column);
    }
  };
  if (row.count <= lanes) {
    const Spans<Index> spans(row, 0);
    each_column([&](std::uint32_t column) { to = spans.write(column, to); });
  } else if (row.count <= 2 * lanes) {
    const Spans<Index> spans(row, 0), more(row, lanes);
    each_column([&](std::uint32_t column) { to = more.write(column, spans.write(column, to)); });
  } else {
    each_column([&](std::uint32_t column) {
      for (std::size_t i = 0; i < row.count; i += lanes) to = Spans<Index>(row, i).write(column, to);
    });
  }
  return to;
}

std::uint8_t* lists_8(const RowSpans<std::uint8_t>& row, std::uint8_t* to, const std::uint8_t* lists,
                      std::uint32_t* begin) {
  return lists_of(row, to, lists, begin);
}

std::uint16_t* lists_16(const RowSpans<std::uint16_t>& row, std::uint16_t* to, const std::uint16_t* lists,
                        std::uint32_t* begin) {
  return lists_of(row, to, lists, begin);
}

std::uint32_t* lists_32(const RowSpans<std::uint32_t>& row, std::uint32_t* to, const std::uint32_t* lists,
                        std::uint32_t* begin) {
  return lists_of(row, to, lists, begin);
}

// A vector of cells at a time gathers the bits of all lights of one word.
void bits_of(const RowSpans<std::uint32_t>& row, std::uint32_t words_per_cell, std::uint32_t* words) {
  const hn::ScalableTag<std::int32_t> d;
  const std::size_t lanes = hn::Lanes(d);
  std::int32_t gathered[k_most_lanes];
  std::fill(words + std::size_t{row.column} * words_per_cell, words + std::size_t{row.end_column} * words_per_cell, 0);
  for (std::size_t column = row.column; column < row.end_column; column += lanes) {
    const auto place = hn::Iota(d, static_cast<std::int32_t>(column));
    const std::size_t cells = std::min<std::size_t>(lanes, row.end_column - column);
    for (std::uint32_t i = 0; i < row.count;) {
      const std::uint32_t word = row.lights[i] / 32;
      auto sum = hn::Zero(d);
      for (; i < row.count && row.lights[i] / 32 == word; ++i) {
        const auto before = hn::Set(d, row.before[i]), after = hn::Set(d, row.after[i]);
        const auto bit = hn::Set(d, static_cast<std::int32_t>(1u << row.lights[i] % 32));
        sum = hn::Or(sum, hn::IfThenElseZero(hn::And(hn::Gt(place, before), hn::Gt(after, place)), bit));
      }
      hn::StoreU(sum, d, gathered);
      for (std::size_t cell = 0; cell < cells; ++cell)
        words[(column + cell) * words_per_cell + word] = static_cast<std::uint32_t>(gathered[cell]);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(lists_8);
HWY_EXPORT(lists_16);
HWY_EXPORT(lists_32);
HWY_EXPORT(bits_of);

std::uint8_t* write_row_lists(const RowSpans<std::uint8_t>& row, std::uint8_t* to, const std::uint8_t* lists,
                              std::uint32_t* begin) {
  return HWY_DYNAMIC_DISPATCH(lists_8)(row, to, lists, begin);
}

std::uint16_t* write_row_lists(const RowSpans<std::uint16_t>& row, std::uint16_t* to, const std::uint16_t* lists,
                               std::uint32_t* begin) {
  return HWY_DYNAMIC_DISPATCH(lists_16)(row, to, lists, begin);
}

std::uint32_t* write_row_lists(const RowSpans<std::uint32_t>& row, std::uint32_t* to, const std::uint32_t* lists,
                               std::uint32_t* begin) {
  return HWY_DYNAMIC_DISPATCH(lists_32)(row, to, lists, begin);
}

void write_row_bits(const RowSpans<std::uint32_t>& row, std::uint32_t words_per_cell, std::uint32_t* words) {
  HWY_DYNAMIC_DISPATCH(bits_of)(row, words_per_cell, words);
}

}  // namespace clusterbench::assign
#endif
