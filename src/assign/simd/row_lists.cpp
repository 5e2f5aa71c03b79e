#include "assign/simd/row_lists.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/simd/row_lists.cpp"
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
using MU = hn::Mask<DU>;

// Lights in lanes of 32 bits, whatever they are kept in.
template <class Index>
HWY_INLINE VU loaded(const Index* from) {
  if constexpr (sizeof(Index) == 4) {
    return hn::LoadU(DU(), from);
  } else {
    return hn::PromoteTo(DU(), hn::LoadU(hn::Rebind<Index, DU>(), from));
  }
}

// Writes the wanted ones of a vector's numbers, which fit into an Index, and up to a vector of anything behind them.
// Returns their end.
template <class Index>
HWY_INLINE Index* append(VU numbers, MU wanted, Index* to) {
  // Compressing in a register and storing it whole is faster than a compressing store.
  const VU first = compressed(DU(), numbers, wanted);
  if constexpr (sizeof(Index) == 4) {
    hn::StoreU(first, DU(), to);
  } else {
    const hn::Rebind<Index, DU> slim;
    hn::StoreU(hn::TruncateTo(slim, first), slim, to);
  }
  return to + hn::CountTrue(DU(), wanted);
}

// Some columns, at most as many as a number has bits.
struct Piece {
  static constexpr std::uint32_t k_most = 32;
  std::uint32_t begin, end;
};

// What spans have of a piece: a bit for each of its columns, and whether that is any.
struct SpanBits {
  VU bits;
  MU any;

  HWY_INLINE SpanBits(VU columns, const Piece& piece) {
    const DU du;
    const DI di;
    const auto of_int = [&](std::uint32_t value) { return hn::Set(di, static_cast<std::int32_t>(value)); };
    const auto first = hn::BitCast(di, hn::And(columns, hn::Set(du, 0xffff)));
    const auto last = hn::BitCast(di, hn::ShiftRight<16>(columns));
    const auto from = hn::Sub(hn::Max(first, of_int(piece.begin)), of_int(piece.begin));
    const auto to = hn::Sub(hn::Min(last, of_int(piece.end - 1)), of_int(piece.begin));
    any = hn::RebindMask(du, hn::Not(hn::Gt(from, to)));
    // Shifts are by less than the bits of a number, also where there is nothing.
    const VU all = hn::Set(du, 0xffffffff), most = hn::Set(du, Piece::k_most - 1);
    const VU before = hn::And(hn::BitCast(du, from), most), behind = hn::And(hn::Not(hn::BitCast(du, to)), most);
    bits = hn::IfThenElseZero(any, hn::And(hn::Shl(all, before), hn::Shr(all, behind)));
  }
};

// Lists of a piece's columns from `vectors` vectors of spans, which stay in registers.
template <std::size_t vectors, class Index>
HWY_INLINE Index* lists_in_registers(const VU (&lights)[vectors], const VU (&bits)[vectors], const Piece& piece,
                                     Index* to, const Index* lists, std::uint32_t* begin) {
  const DU du;
  VU bit = hn::Set(du, 1);
  for (std::uint32_t column = piece.begin; column < piece.end; ++column) {
    begin[column] = static_cast<std::uint32_t>(to - lists);
    for (std::size_t i = 0; i < vectors; ++i) to = append(lights[i], hn::TestBit(bits[i], bit), to);
    bit = hn::ShiftLeft<1>(bit);
  }
  return to;
}

// Those spans of a row that hold some of a piece's columns.
class FewSpans {
 public:
  template <class Index>
  HWY_INLINE FewSpans(const RowSpans<Index>& row, const Piece& piece, FewColumns& few)
      : lights_(few.lights.data()), bits_(few.bits.data()) {
    const DU du;
    std::uint32_t *next_light = few.lights.data(), *next_bits = few.bits.data();
    for (std::size_t i = 0; i < row.count; i += hn::Lanes(du)) {
      const SpanBits spans(hn::LoadU(du, row.columns + i), piece);
      const MU wanted = hn::And(spans.any, hn::FirstN(du, row.count - i));
      next_light = append(loaded(row.lights + i), wanted, next_light);
      next_bits = append(spans.bits, wanted, next_bits);
    }
    count_ = static_cast<std::size_t>(next_bits - bits_);
    hn::StoreU(hn::Zero(du), du, next_bits);
  }

  template <class Index>
  HWY_INLINE Index* write(const Piece& piece, Index* to, const Index* lists, std::uint32_t* begin) const {
    const DU du;
    const std::size_t lanes = hn::Lanes(du);
    if (count_ <= lanes) {
      const VU lights[1] = {hn::LoadU(du, lights_)}, bits[1] = {hn::LoadU(du, bits_)};
      return lists_in_registers(lights, bits, piece, to, lists, begin);
    }
    if (count_ <= 2 * lanes) {
      const VU lights[2] = {hn::LoadU(du, lights_), hn::LoadU(du, lights_ + lanes)};
      const VU bits[2] = {hn::LoadU(du, bits_), hn::LoadU(du, bits_ + lanes)};
      return lists_in_registers(lights, bits, piece, to, lists, begin);
    }
    for (std::uint32_t column = piece.begin; column < piece.end; ++column) {
      begin[column] = static_cast<std::uint32_t>(to - lists);
      const VU bit = hn::Set(du, 1u << (column - piece.begin));
      for (std::size_t i = 0; i < count_; i += lanes)
        to = append(hn::LoadU(du, lights_ + i), hn::TestBit(hn::LoadU(du, bits_ + i), bit), to);
    }
    return to;
  }

 private:
  const std::uint32_t *lights_, *bits_;
  std::size_t count_;
};

// How many columns at a time are cheapest. In cycles: about 8 per piece and vector of the row's spans, and 5 per column
// and vector of those spans that hold some of the piece.
template <class Index>
HWY_INLINE std::uint32_t columns_at_once(const RowSpans<Index>& row) {
  const DU du;
  const std::size_t lanes = hn::Lanes(du);
  VU longer = hn::Zero(du);  // than one column
  for (std::size_t i = 0; i < row.count; i += lanes) {
    const VU span = hn::IfThenElseZero(hn::FirstN(du, row.count - i), hn::LoadU(du, row.columns + i));
    longer = hn::Add(longer, hn::Sub(hn::ShiftRight<16>(span), hn::And(span, hn::Set(du, 0xffff))));
  }
  const auto columns = static_cast<float>(row.end_column - row.column), count = static_cast<float>(row.count);
  const auto beyond = static_cast<float>(hn::GetLane(hn::SumOfLanes(du, longer)));
  const float per_lane = 1.0f / static_cast<float>(lanes), vectors = count * per_lane, per_column = 1.0f / columns;
  std::uint32_t cheapest = Piece::k_most;
  float least = std::numeric_limits<float>::infinity();
  for (std::uint32_t piece = Piece::k_most; piece >= 4; piece /= 2) {
    const auto some = static_cast<float>(piece);
    const float share = std::min(1.0f, (beyond + count * some) * per_column / count);
    const float cost = 8.0f * std::max(1.0f, columns / some) * vectors + 5.0f * columns * (share * vectors + 0.5f);
    if (cost < least) {
      cheapest = piece;
      least = cost;
    }
  }
  return cheapest;
}

template <class Index>
HWY_INLINE Index* lists_of(const RowSpans<Index>& row, FewColumns& few, Index* to, const Index* lists,
                           std::uint32_t* begin) {
  const DU du;
  const bool is_short = row.count <= hn::Lanes(du);
  const std::uint32_t at_once = is_short ? Piece::k_most : columns_at_once(row);
  const VU first_lights = loaded(row.lights), first_columns = hn::LoadU(du, row.columns);
  for (std::uint32_t column = row.column; column < row.end_column; column += at_once) {
    const Piece piece = {column, std::min(row.end_column, column + at_once)};
    if (is_short) {
      const VU bits = SpanBits(first_columns, piece).bits;
      const VU some[1] = {first_lights}, some_bits[1] = {hn::IfThenElseZero(hn::FirstN(du, row.count), bits)};
      to = lists_in_registers(some, some_bits, piece, to, lists, begin);
    } else {
      to = FewSpans(row, piece, few).write(piece, to, lists, begin);
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
        const auto before = hn::Set(d, static_cast<std::int32_t>(ColumnSpan::first(row.columns[i])) - 1);
        const auto after = hn::Set(d, static_cast<std::int32_t>(ColumnSpan::last(row.columns[i])) + 1);
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

void write_row_bits(const RowSpans<std::uint32_t>& row, std::uint32_t words_per_cell, std::uint32_t* words) {
  HWY_DYNAMIC_DISPATCH(bits_of)(row, words_per_cell, words);
}

}  // namespace clusterbench::assign
#endif
