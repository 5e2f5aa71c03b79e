#include "assign/lists/row_lists.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/lists/row_lists.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

using DU = hn::ScalableTag<std::uint32_t>;
using DI = hn::ScalableTag<std::int32_t>;
using VU = hn::Vec<DU>;
using VI = hn::Vec<DI>;
using MU = hn::Mask<DU>;

HWY_INLINE VI all_int(std::uint32_t value) {
  return Set(DI(), static_cast<std::int32_t>(value));
}

// Lights in lanes of 32 bits, whatever they are kept in.
template <class Index>
HWY_INLINE VU loaded(const Index* from) {
  if constexpr (sizeof(Index) == 4) {
    return LoadU(DU(), from);
  } else {
    return PromoteTo(DU(), LoadU(hn::Rebind<Index, DU>(), from));
  }
}

// Writes the wanted ones of a vector's numbers, which fit into an Index, and up to a vector of anything behind them.
// Returns their end.
template <class Index>
HWY_INLINE Index* append(VU numbers, MU wanted, Index* to) {
  // Compressing in a register and storing it whole is faster than a compressing store.
  const VU first = compressed(DU(), numbers, wanted);
  if constexpr (sizeof(Index) == 4) {
    StoreU(first, DU(), to);
  } else {
    const hn::Rebind<Index, DU> slim;
    StoreU(TruncateTo(slim, first), slim, to);
  }
  return to + CountTrue(DU(), wanted);
}

// Some columns.
struct Columns {
  std::uint32_t begin, end;
};

// Spans of columns, one per lane.
struct Spans {
  VI first, last;

  // Of columns as a row has them.
  template <class Row>
  static HWY_INLINE Spans of(const Row&, VU columns) {
    return Spans(And(columns, Set(DU(), 0xffff)), ShiftRight<16>(columns));
  }
  static HWY_INLINE Spans of(const RowLightSpans&, VU spans) {
    const VU byte = Set(DU(), 0xff);
    return Spans(And(spans, byte), And(ShiftRight<8>(spans), byte));
  }

  // Which of them hold some of these columns.
  HWY_INLINE MU some(const Columns& of) const {
    return RebindMask(DU(), And(all_int(of.end) > first, last > all_int(of.begin - 1)));
  }

  // What each has of at most 32 columns: a bit for each of these, the first one's lowest.
  HWY_INLINE VU bits(const Columns& of) const {
    const DU du;
    const VI begin = all_int(of.begin), most = all_int(31);
    const VI from = Max(first, begin) - begin;
    const VI to = Min(last, all_int(of.end - 1)) - begin;
    // Shifts are by less than 32, also where there is nothing.
    const VU before = BitCast(du, And(from, most)), behind = BitCast(du, AndNot(to, most));
    const VU all = Set(du, 0xffffffff);
    const MU none = RebindMask(du, from > to);
    return IfThenZeroElse(none, And(Shl(all, before), Shr(all, behind)));
  }

 private:
  HWY_INLINE Spans(VU first_columns, VU last_columns)
      : first(BitCast(DI(), first_columns)), last(BitCast(DI(), last_columns)) {}
};

// A vector of a row's spans and their lights.
template <class Index>
HWY_INLINE Spans spans_at(const RowSpans<Index>& row, std::size_t i) {
  return Spans::of(row, LoadU(DU(), row.columns + i));
}
template <class Index>
HWY_INLINE VU lights_at(const RowSpans<Index>& row, std::size_t i) {
  return loaded(row.lights + i);
}
HWY_INLINE Spans spans_at(const RowLightSpans& row, std::size_t i) {
  return Spans::of(row, LoadU(DU(), row.spans + i));
}
HWY_INLINE VU lights_at(const RowLightSpans& row, std::size_t i) {
  return hn::ShiftRight<16>(LoadU(DU(), row.spans + i));
}

// The bit of the column behind `skipped` others.
HWY_INLINE VU bit_of(std::uint32_t skipped) {
  return Set(DU(), 1u << skipped);
}

// `vectors` vectors of spans, which stay in registers: their lights and what they have of some columns.
template <std::size_t vectors>
struct SpansInRegisters {
  VU lights[vectors], bits[vectors];

  template <class Light>
  HWY_INLINE SpansInRegisters(const Light* from_lights, const std::uint32_t* from_bits) {
    const DU du;
    for (std::size_t i = 0; i < vectors; ++i) {
      lights[i] = loaded(from_lights + i * Lanes(du));
      bits[i] = LoadU(du, from_bits + i * Lanes(du));
    }
  }
  HWY_INLINE SpansInRegisters(VU some_lights, VU some_bits) : lights{some_lights}, bits{some_bits} {}

  // `skipped`: the columns before these, which the bits have, too.
  template <class Index>
  HWY_INLINE Index* write(const Columns& columns, std::uint32_t skipped, Index* to, const Index* lists,
                          std::uint32_t* begin) const {
    VU bit = bit_of(skipped);
    for (std::uint32_t column = columns.begin; column < columns.end; ++column) {
      begin[column] = static_cast<std::uint32_t>(to - lists);
      for (std::size_t i = 0; i < vectors; ++i) to = append(lights[i], TestBit(bits[i], bit), to);
      bit = ShiftLeft<1>(bit);
    }
    return to;
  }
};

// Spans in memory, up to a vector of ones without bits behind them.
template <class Light>
struct StoredSpans {
  const Light* lights;
  const std::uint32_t* bits;
  std::size_t count;

  template <class Index>
  HWY_INLINE Index* write(const Columns& columns, std::uint32_t skipped, Index* to, const Index* lists,
                          std::uint32_t* begin) const {
    return write_from<1>(columns, skipped, to, lists, begin);
  }

 private:
  // How many vectors of lights and bits stay in registers.
  static constexpr std::size_t k_most_vectors = HWY_TARGET <= HWY_AVX3 ? 8 : 4;

  // At least as many vectors as this.
  template <std::size_t vectors, class Index>
  HWY_INLINE Index* write_from(const Columns& columns, std::uint32_t skipped, Index* to, const Index* lists,
                               std::uint32_t* begin) const {
    if constexpr (vectors > k_most_vectors) {
      return write_many(columns, skipped, to, lists, begin);
    } else {
      if (count <= vectors * Lanes(DU()))
        return SpansInRegisters<vectors>(lights, bits).write(columns, skipped, to, lists, begin);
      return write_from<vectors + 1>(columns, skipped, to, lists, begin);
    }
  }

  template <class Index>
  HWY_INLINE Index* write_many(const Columns& columns, std::uint32_t skipped, Index* to, const Index* lists,
                               std::uint32_t* begin) const {
    const DU du;
    VU bit = bit_of(skipped);
    for (std::uint32_t column = columns.begin; column < columns.end; ++column) {
      begin[column] = static_cast<std::uint32_t>(to - lists);
      for (std::size_t i = 0; i < count; i += Lanes(du))
        to = append(loaded(lights + i), TestBit(LoadU(du, bits + i), bit), to);
      bit = ShiftLeft<1>(bit);
    }
    return to;
  }
};

// How many columns a strip has: those spans of a row are chosen first that hold some of them.
std::uint32_t strip_columns(std::uint32_t columns) {
  return columns <= 16 ? 4 : 8;
}

// Do most spans hold none of most strips? To choose them costs as much as to ask them for a fifth of the columns.
template <class Row>
HWY_INLINE bool are_narrow(const Row& row, const Columns& window, std::uint32_t strip) {
  return 5 * (row.width + strip) < 4 * (window.end - window.begin);
}

// All of a row's spans, with what they have of a window.
template <class Row, class Index>
HWY_INLINE Index* lists_at_once(const Row& row, const Columns& window, FewColumns& few, Index* to, const Index* lists,
                                std::uint32_t* begin) {
  const DU du;
  std::uint32_t* bits = few.strips[0].bits.data();
  std::uint32_t* lights = few.strips[0].lights.data();
  for (std::size_t i = 0; i < row.count; i += Lanes(du)) {
    StoreU(IfThenElseZero(FirstN(du, row.count - i), spans_at(row, i).bits(window)), du, bits + i);
    StoreU(lights_at(row, i), du, lights + i);
  }
  return StoredSpans<std::uint32_t>{lights, bits, row.count}.write(window, 0, to, lists, begin);
}

// Appends a vector's wanted spans to a strip's.
template <class Index>
HWY_INLINE void choose(const RowSpans<Index>& row, std::size_t i, const Spans& spans, MU wanted, const Columns& window,
                       FewColumns::Strip& strip, std::size_t count) {
  append(lights_at(row, i), wanted, strip.lights.data() + count);
  append(spans.bits(window), wanted, strip.bits.data() + count);
}
HWY_INLINE void choose(const RowLightSpans& row, std::size_t i, const Spans&, MU wanted, const Columns&,
                       FewColumns::Strip& strip, std::size_t count) {
  append(LoadU(DU(), row.spans + i), wanted, strip.lights.data() + count);
}

template <class Index>
HWY_INLINE Index* write_chosen(const RowSpans<Index>&, FewColumns::Strip& strip, std::size_t count,
                               const Columns& window, const Columns& columns, Index* to, const Index* lists,
                               std::uint32_t* begin) {
  StoreU(Zero(DU()), DU(), strip.bits.data() + count);
  return StoredSpans<std::uint32_t>{strip.lights.data(), strip.bits.data(), count}.write(
      columns, columns.begin - window.begin, to, lists, begin);
}
HWY_INLINE std::uint32_t* write_chosen(const RowLightSpans&, FewColumns::Strip& strip, std::size_t count,
                                       const Columns&, const Columns& columns, std::uint32_t* to,
                                       const std::uint32_t* lists, std::uint32_t* begin) {
  const DU du;
  StoreU(Set(du, LightSpan::k_none), du, strip.lights.data() + count);
  const RowLightSpans chosen{strip.lights.data(), static_cast<std::uint32_t>(count), columns.begin, columns.end};
  if (count <= Lanes(du)) {
    const SpansInRegisters<1> spans(lights_at(chosen, 0), spans_at(chosen, 0).bits(columns));
    return spans.write(columns, 0, to, lists, begin);
  }
  for (std::size_t i = 0; i < count; i += Lanes(du)) {
    const VU lights = lights_at(chosen, i);
    StoreU(spans_at(chosen, i).bits(columns), du, strip.bits.data() + i);
    StoreU(lights, du, strip.lights.data() + i);
  }
  return StoredSpans<std::uint32_t>{strip.lights.data(), strip.bits.data(), count}.write(columns, 0, to, lists, begin);
}

// Strip by strip, from those spans that hold some of it. All are chosen first, so that none are read while they are
// still being written.
template <class Row, class Index>
HWY_INLINE Index* lists_by_strips(const Row& row, const Columns& window, std::uint32_t strip, FewColumns& few,
                                  Index* to, const Index* lists, std::uint32_t* begin) {
  const DU du;
  constexpr std::size_t k_strips = FewColumns::k_strips;
  std::size_t counts[k_strips] = {};
  const auto columns_of = [&](std::size_t i) {
    const std::uint32_t from = window.begin + static_cast<std::uint32_t>(i) * strip;
    return Columns{from, std::min(window.end, from + strip)};
  };
  for (std::size_t i = 0; i < row.count; i += Lanes(du)) {
    const Spans spans = spans_at(row, i);
    const MU there = FirstN(du, row.count - i);
    for (std::size_t s = 0; s < k_strips; ++s) {
      const MU some = And(spans.some(columns_of(s)), there);
      choose(row, i, spans, some, window, few.strips[s], counts[s]);
      counts[s] += CountTrue(du, some);
    }
  }
  for (std::size_t s = 0; s < k_strips; ++s) {
    const Columns columns = columns_of(s);
    to = write_chosen(row, few.strips[s], counts[s], window, columns, to, lists, begin);
  }
  return to;
}

// Does each span hold all of the columns?
template <class Index>
HWY_INLINE bool all_are_full(const RowSpans<Index>& row) {
  return std::all_of(row.columns, row.columns + row.count, [&](std::uint32_t span) {
    return ColumnSpan::first(span) <= row.column && ColumnSpan::last(span) + 1 >= row.end_column;
  });
}
HWY_INLINE bool all_are_full(const RowLightSpans& row) {
  return std::all_of(row.spans, row.spans + row.count, [&](std::uint32_t span) {
    return LightSpan::first(span) <= row.column && LightSpan::last(span) + 1 >= row.end_column;
  });
}

// All of the row's lights for each column.
HWY_INLINE std::uint32_t* equal_lists(const RowLightSpans& row, std::uint32_t* to, const std::uint32_t* lists,
                                      std::uint32_t* begin) {
  const DU du;
  const VU first = lights_at(row, 0);
  for (std::uint32_t column = row.column; column < row.end_column; ++column) {
    begin[column] = static_cast<std::uint32_t>(to - lists);
    StoreU(first, du, to);
    for (std::size_t i = Lanes(du); i < row.count; i += Lanes(du)) StoreU(lights_at(row, i), du, to + i);
    to += row.count;
  }
  return to;
}
template <class Index>
HWY_INLINE Index* equal_lists(const RowSpans<Index>& row, Index* to, const Index* lists, std::uint32_t* begin) {
  const hn::ScalableTag<Index> d;
  const auto first = LoadU(d, row.lights);
  for (std::uint32_t column = row.column; column < row.end_column; ++column) {
    begin[column] = static_cast<std::uint32_t>(to - lists);
    StoreU(first, d, to);
    for (std::size_t i = Lanes(d); i < row.count; i += Lanes(d)) StoreU(LoadU(d, row.lights + i), d, to + i);
    to += row.count;
  }
  return to;
}

template <class Row, class Index>
HWY_INLINE Index* lists_of(const Row& row, FewColumns& few, Index* to, const Index* lists, std::uint32_t* begin) {
  const DU du;
  if (all_are_full(row)) return equal_lists(row, to, lists, begin);
  const std::uint32_t strip = strip_columns(row.end_column - row.column);
  const std::uint32_t most = FewColumns::k_strips * strip;
  for (std::uint32_t column = row.column; column < row.end_column; column += most) {
    const Columns window = {column, std::min(row.end_column, column + most)};
    if (row.count <= Lanes(du)) {
      const VU bits = spans_at(row, 0).bits(window);
      SpansInRegisters<1> spans(lights_at(row, 0), IfThenElseZero(FirstN(du, row.count), bits));
      to = spans.write(window, 0, to, lists, begin);
    } else if (are_narrow(row, window, strip)) {
      to = lists_by_strips(row, window, strip, few, to, lists, begin);
    } else {
      to = lists_at_once(row, window, few, to, lists, begin);
    }
  }
  return to;
}

std::uint8_t* lists_8(const RowSpans<std::uint8_t>& row, FewColumns& few, std::uint8_t* to, const std::uint8_t* lists,
                      std::uint32_t* begin) {
  return lists_of(row, few, to, lists, begin);
}

std::uint16_t* lists_16(const RowSpans<std::uint16_t>& row, FewColumns& few, std::uint16_t* to,
                        const std::uint16_t* lists, std::uint32_t* begin) {
  return lists_of(row, few, to, lists, begin);
}

std::uint32_t* lists_32(const RowSpans<std::uint32_t>& row, FewColumns& few, std::uint32_t* to,
                        const std::uint32_t* lists, std::uint32_t* begin) {
  return lists_of(row, few, to, lists, begin);
}

std::uint32_t* lists_of_light_spans(const RowLightSpans& row, FewColumns& few, std::uint32_t* to,
                                    const std::uint32_t* lists, std::uint32_t* begin) {
  return lists_of(row, few, to, lists, begin);
}

// A vector of cells at a time gathers the bits of all lights of one word.
void bits_of(const RowSpans<std::uint32_t>& row, std::uint32_t words_per_cell, std::uint32_t* words) {
  const hn::ScalableTag<std::int32_t> d;
  const std::size_t lanes = Lanes(d);
  std::int32_t gathered[k_most_lanes];
  std::fill(words + std::size_t{row.column} * words_per_cell, words + std::size_t{row.end_column} * words_per_cell, 0);
  for (std::size_t column = row.column; column < row.end_column; column += lanes) {
    const auto lane_column = Iota(d, static_cast<std::int32_t>(column));
    const std::size_t cells = std::min<std::size_t>(lanes, row.end_column - column);
    for (std::uint32_t i = 0; i < row.count;) {
      const std::uint32_t word = row.lights[i] / 32;
      auto sum = Zero(d);
      for (; i < row.count && row.lights[i] / 32 == word; ++i) {
        const auto before = Set(d, static_cast<std::int32_t>(ColumnSpan::first(row.columns[i])) - 1);
        const auto after = Set(d, static_cast<std::int32_t>(ColumnSpan::last(row.columns[i])) + 1);
        const auto bit = Set(d, static_cast<std::int32_t>(1u << row.lights[i] % 32));
        sum = Or(sum, IfThenElseZero(And(lane_column > before, after > lane_column), bit));
      }
      StoreU(sum, d, gathered);
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
HWY_EXPORT(lists_of_light_spans);
HWY_EXPORT(bits_of);

std::uint8_t* write_row_lists(const RowSpans<std::uint8_t>& row, FewColumns& few, std::uint8_t* to,
                              const std::uint8_t* lists, std::uint32_t* begin) {
  few.make_room(row.count);
  return HWY_DYNAMIC_DISPATCH(lists_8)(row, few, to, lists, begin);
}

std::uint16_t* write_row_lists(const RowSpans<std::uint16_t>& row, FewColumns& few, std::uint16_t* to,
                               const std::uint16_t* lists, std::uint32_t* begin) {
  few.make_room(row.count);
  return HWY_DYNAMIC_DISPATCH(lists_16)(row, few, to, lists, begin);
}

std::uint32_t* write_row_lists(const RowSpans<std::uint32_t>& row, FewColumns& few, std::uint32_t* to,
                               const std::uint32_t* lists, std::uint32_t* begin) {
  few.make_room(row.count);
  return HWY_DYNAMIC_DISPATCH(lists_32)(row, few, to, lists, begin);
}

std::uint32_t* write_row_lists(const RowLightSpans& row, FewColumns& few, std::uint32_t* to, const std::uint32_t* lists,
                               std::uint32_t* begin) {
  few.make_room(row.count);
  return HWY_DYNAMIC_DISPATCH(lists_of_light_spans)(row, few, to, lists, begin);
}

void write_row_bits(const RowSpans<std::uint32_t>& row, std::uint32_t words_per_cell, std::uint32_t* words) {
  HWY_DYNAMIC_DISPATCH(bits_of)(row, words_per_cell, words);
}

}  // namespace clusterbench::assign
#endif
