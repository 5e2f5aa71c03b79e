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

// Writes the wanted ones of a vector's numbers, and up to a vector of anything behind them. Returns their end.
HWY_INLINE std::uint32_t* append(VU numbers, MU wanted, std::uint32_t* to) {
  // Compressing in a register and storing it whole is faster than a compressing store.
  StoreU(compressed(DU(), numbers, wanted), DU(), to);
  return to + CountTrue(DU(), wanted);
}

// The spans of one row, and the columns whose lists are wanted.
struct RowSpans {
  const std::uint32_t *lights, *columns;
  std::uint32_t count, column, end_column, width;
};

// Some columns.
struct Columns {
  std::uint32_t begin, end;
};

// Spans of columns, one per lane.
struct Spans {
  VI first, last;

  HWY_INLINE explicit Spans(VU columns)
      : first(BitCast(DI(), And(columns, Set(DU(), 0xffff)))), last(BitCast(DI(), ShiftRight<16>(columns))) {}

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
};

// The bit of the column behind `skipped` others.
HWY_INLINE VU bit_of(std::uint32_t skipped) {
  return Set(DU(), 1u << skipped);
}

// `vectors` vectors of spans, which stay in registers: their lights and what they have of some columns.
template <std::size_t vectors>
struct SpansInRegisters {
  VU lights[vectors], bits[vectors];

  HWY_INLINE SpansInRegisters(const std::uint32_t* from_lights, const std::uint32_t* from_bits) {
    const DU du;
    for (std::size_t i = 0; i < vectors; ++i) {
      lights[i] = LoadU(du, from_lights + i * Lanes(du));
      bits[i] = LoadU(du, from_bits + i * Lanes(du));
    }
  }
  HWY_INLINE SpansInRegisters(VU some_lights, VU some_bits) : lights{some_lights}, bits{some_bits} {}

  // `skipped`: the columns before these, which the bits have, too.
  HWY_INLINE std::uint32_t* write(const Columns& columns, std::uint32_t skipped, std::uint32_t* to,
                                  const std::uint32_t* lists, std::uint32_t* begin) const {
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
struct StoredSpans {
  const std::uint32_t* lights;
  const std::uint32_t* bits;
  std::size_t count;

  HWY_INLINE std::uint32_t* write(const Columns& columns, std::uint32_t skipped, std::uint32_t* to,
                                  const std::uint32_t* lists, std::uint32_t* begin) const {
    return write_from<1>(columns, skipped, to, lists, begin);
  }

 private:
  // How many vectors of lights and bits stay in registers.
  static constexpr std::size_t k_most_vectors = HWY_TARGET <= HWY_AVX3 ? 8 : 4;

  // At least as many vectors as this.
  template <std::size_t vectors>
  HWY_INLINE std::uint32_t* write_from(const Columns& columns, std::uint32_t skipped, std::uint32_t* to,
                                       const std::uint32_t* lists, std::uint32_t* begin) const {
    if constexpr (vectors > k_most_vectors) {
      return write_many(columns, skipped, to, lists, begin);
    } else {
      if (count <= vectors * Lanes(DU()))
        return SpansInRegisters<vectors>(lights, bits).write(columns, skipped, to, lists, begin);
      return write_from<vectors + 1>(columns, skipped, to, lists, begin);
    }
  }

  HWY_INLINE std::uint32_t* write_many(const Columns& columns, std::uint32_t skipped, std::uint32_t* to,
                                       const std::uint32_t* lists, std::uint32_t* begin) const {
    const DU du;
    VU bit = bit_of(skipped);
    for (std::uint32_t column = columns.begin; column < columns.end; ++column) {
      begin[column] = static_cast<std::uint32_t>(to - lists);
      for (std::size_t i = 0; i < count; i += Lanes(du))
        to = append(LoadU(du, lights + i), TestBit(LoadU(du, bits + i), bit), to);
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
HWY_INLINE bool are_narrow(const RowSpans& row, const Columns& window, std::uint32_t strip) {
  return 5 * (row.width + strip) < 4 * (window.end - window.begin);
}

// All of a row's spans, with what they have of a window.
HWY_INLINE std::uint32_t* lists_at_once(const RowSpans& row, const Columns& window, FewColumns& few, std::uint32_t* to,
                                        const std::uint32_t* lists, std::uint32_t* begin) {
  const DU du;
  std::uint32_t* bits = few.strips[0].bits.data();
  for (std::size_t i = 0; i < row.count; i += Lanes(du)) {
    const VU some = Spans(LoadU(du, row.columns + i)).bits(window);
    StoreU(IfThenElseZero(FirstN(du, row.count - i), some), du, bits + i);
  }
  return StoredSpans{row.lights, bits, row.count}.write(window, 0, to, lists, begin);
}

// Strip by strip, from those spans that hold some of it. All are chosen first, so that none are read while they are
// still being written.
HWY_INLINE std::uint32_t* lists_by_strips(const RowSpans& row, const Columns& window, std::uint32_t strip,
                                          FewColumns& few, std::uint32_t* to, const std::uint32_t* lists,
                                          std::uint32_t* begin) {
  const DU du;
  constexpr std::size_t k_strips = FewColumns::k_strips;
  std::size_t counts[k_strips] = {};
  const auto columns_of = [&](std::size_t i) {
    const std::uint32_t from = window.begin + static_cast<std::uint32_t>(i) * strip;
    return Columns{from, std::min(window.end, from + strip)};
  };
  for (std::size_t i = 0; i < row.count; i += Lanes(du)) {
    const Spans spans(LoadU(du, row.columns + i));
    const VU lights = LoadU(du, row.lights + i), bits = spans.bits(window);
    const MU there = FirstN(du, row.count - i);
    for (std::size_t s = 0; s < k_strips; ++s) {
      const MU some = And(spans.some(columns_of(s)), there);
      append(lights, some, few.strips[s].lights.data() + counts[s]);
      append(bits, some, few.strips[s].bits.data() + counts[s]);
      counts[s] += CountTrue(du, some);
    }
  }
  for (std::size_t s = 0; s < k_strips; ++s) {
    const Columns columns = columns_of(s);
    const FewColumns::Strip& chosen = few.strips[s];
    StoreU(Zero(du), du, few.strips[s].bits.data() + counts[s]);
    to = StoredSpans{chosen.lights.data(), chosen.bits.data(), counts[s]}.write(columns, columns.begin - window.begin,
                                                                                to, lists, begin);
  }
  return to;
}

// Does each span hold all of the columns?
HWY_INLINE bool all_are_full(const RowSpans& row) {
  return std::all_of(row.columns, row.columns + row.count, [&](std::uint32_t span) {
    return ColumnSpan::first(span) <= row.column && ColumnSpan::last(span) + 1 >= row.end_column;
  });
}

// All of the row's lights for each column.
HWY_INLINE std::uint32_t* equal_lists(const RowSpans& row, std::uint32_t* to, const std::uint32_t* lists,
                                      std::uint32_t* begin) {
  const DU d;
  const auto first = LoadU(d, row.lights);
  for (std::uint32_t column = row.column; column < row.end_column; ++column) {
    begin[column] = static_cast<std::uint32_t>(to - lists);
    StoreU(first, d, to);
    for (std::size_t i = Lanes(d); i < row.count; i += Lanes(d)) StoreU(LoadU(d, row.lights + i), d, to + i);
    to += row.count;
  }
  return to;
}

HWY_NOINLINE std::uint32_t* lists_of(const RowSpans& row, FewColumns& few, std::uint32_t* to,
                                     const std::uint32_t* lists, std::uint32_t* begin) {
  const DU du;
  if (all_are_full(row)) return equal_lists(row, to, lists, begin);
  const std::uint32_t strip = strip_columns(row.end_column - row.column);
  const std::uint32_t most = FewColumns::k_strips * strip;
  for (std::uint32_t column = row.column; column < row.end_column; column += most) {
    const Columns window = {column, std::min(row.end_column, column + most)};
    if (row.count <= Lanes(du)) {
      const VU bits = Spans(LoadU(du, row.columns)).bits(window);
      SpansInRegisters<1> spans(LoadU(du, row.lights), IfThenElseZero(FirstN(du, row.count), bits));
      to = spans.write(window, 0, to, lists, begin);
    } else if (are_narrow(row, window, strip)) {
      to = lists_by_strips(row, window, strip, few, to, lists, begin);
    } else {
      to = lists_at_once(row, window, few, to, lists, begin);
    }
  }
  return to;
}

// The row's lists, but for the hole's columns.
HWY_INLINE std::uint32_t* lists_beside(const grid::IndexRange& hole, RowSpans row, FewColumns& few, std::uint32_t* to,
                                       const std::uint32_t* lists, std::uint32_t* begin) {
  const std::uint32_t end_column = row.end_column;
  row.end_column = static_cast<std::uint32_t>(hole.first);
  to = lists_of(row, few, to, lists, begin);
  std::fill_n(begin + hole.first, hole.count(), static_cast<std::uint32_t>(to - lists));
  row.column = static_cast<std::uint32_t>(hole.last) + 1;
  row.end_column = end_column;
  return lists_of(row, few, to, lists, begin);
}

std::uint32_t* lists_of_band(const BandSpans& band, const BandHole& hole, FewColumns& few, std::uint32_t* to,
                             const std::uint32_t* lists, std::uint32_t* begin) {
  for (std::uint32_t row = 0; row < band.rows; ++row, begin += band.row_columns) {
    const std::size_t at = row * band.pitch;
    const RowSpans spans{band.lights + at, band.columns + at, band.sizes[row], 0, band.row_columns, band.width};
    if (spans.count == 0)
      std::fill_n(begin, band.row_columns, static_cast<std::uint32_t>(to - lists));
    else if (hole.columns.empty() || !hole.rows.holds(static_cast<int>(row)))
      to = lists_of(spans, few, to, lists, begin);
    else
      to = lists_beside(hole.columns, spans, few, to, lists, begin);
  }
  return to;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(lists_of_band);

std::uint32_t* write_band_lists(const BandSpans& band, const BandHole& hole, FewColumns& few, std::uint32_t* to,
                                const std::uint32_t* lists, std::uint32_t* begin) {
  few.make_room(band.rows == 0 ? 0 : *std::max_element(band.sizes, band.sizes + band.rows));
  return HWY_DYNAMIC_DISPATCH(lists_of_band)(band, hole, few, to, lists, begin);
}

}  // namespace clusterbench::assign
#endif
