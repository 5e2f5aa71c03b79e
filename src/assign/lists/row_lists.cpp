#include "assign/lists/row_lists.h"

#include <algorithm>
#include <array>

#define HWY_TARGET_INCLUDE "assign/lists/row_lists.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

using MU = hn::Mask<DU>;

const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

bool add_batch(const BandSpans& band, int first_row, int last_row, const std::uint32_t* columns,
               const std::uint32_t* lights, std::uint8_t* is_left) {
  const BandSpans to = band;  // a copy, which stays in registers: no store can change it
  const VU light = LoadU(DU(), lights), none = all(ColumnSpan::k_none);
  bool some_are_left = false;
  for (int row = first_row; row <= last_row; ++row) {
    const auto r = static_cast<std::size_t>(row);
    const VU span = LoadU(DU(), columns + r * Lanes(DU()));
    const MU wanted = Ne(span, none), uncertain = TestBit(span, all(ColumnSpan::k_uncertain));
    is_left[r] = AllFalse(DU(), And(wanted, uncertain)) ? 0 : 1;
    if (is_left[r] != 0) {
      some_are_left = true;
      continue;
    }
    const std::size_t end = r * to.pitch + to.sizes[r];
    store_wanted(light, wanted, to.lights + end);
    store_wanted(span, wanted, to.columns + end);
    to.sizes[r] += static_cast<std::uint32_t>(CountTrue(DU(), wanted));
  }
  return some_are_left;
}

void add_rows(const BandSpans& band, int first_row, int last_row, const std::uint32_t* sizes,
              const std::uint32_t* columns, const std::uint32_t* lights) {
  const BandSpans to = band;  // as above
  std::size_t begin = static_cast<std::size_t>(first_row) * to.pitch;
  for (int row = first_row; row <= last_row; ++row, begin += to.pitch) {
    const std::uint32_t size = sizes[row], earlier = to.sizes[row];
    StoreU(LoadU(DU(), columns), DU(), to.columns + begin + earlier);
    StoreU(LoadU(DU(), lights), DU(), to.lights + begin + earlier);
    to.sizes[row] = earlier + size;
    columns += size;
    lights += size;
  }
}

std::uint64_t count_pairs(const BandSpans& band) {
  const VU none = all(ColumnSpan::k_none), half = all(0xffffu), one = all(1u);
  constexpr std::uint32_t k_most_spans = 1u << 16;  // the sum of their columns is below 2^32
  std::uint64_t total = 0;
  for (std::uint32_t row = 0; row < band.rows; ++row) {
    const std::uint32_t* spans = band.columns + row * band.pitch;
    const std::uint32_t size = band.sizes[row];
    for (std::uint32_t i = 0; i < size;) {
      VU sum = Zero(DU());
      for (const std::uint32_t end = std::min(size, i + k_most_spans); i < end; i += lane_count()) {
        const VU span = LoadU(DU(), spans + i);
        const MU wanted = And(FirstN(DU(), size - i), Ne(span, none));
        sum = sum + IfThenElseZero(wanted, ShiftRight<16>(span) - And(span, half) + one);
      }
      total += GetLane(SumOfLanes(DU(), sum));
    }
  }
  return total;
}

// Writes the selected lanes of a vector of numbers; up to a vector of undefined values follows. Returns their end.
HWY_INLINE std::uint32_t* append(VU numbers, MU wanted, std::uint32_t* to) {
  // Compressing in a register and storing it whole is faster than a compressing store.
  store_wanted(numbers, wanted, to);
  return to + CountTrue(DU(), wanted);
}

// A range of columns.
struct Columns {
  std::uint32_t begin, end;
};

// The part of spans, one per lane, within at most 32 columns: one bit for each column, the lowest bit for the first.
HWY_INLINE VU column_bits(VU spans, const Columns& columns) {
  const VI begin = all(static_cast<std::int32_t>(columns.begin)), most = all(31);
  const VI last = all(static_cast<std::int32_t>(columns.end) - 1);
  const VI from = Max(BitCast(DI(), And(spans, all(0xffffu))), begin) - begin;
  const VI to = Min(BitCast(DI(), ShiftRight<16>(spans)), last) - begin;
  // Shifts are by less than 32, also for spans without columns.
  const VU before = BitCast(DU(), And(from, most)), behind = BitCast(DU(), AndNot(to, most));
  const VU ones = all(0xffffffffu);
  return IfThenZeroElse(RebindMask(DU(), from > to), And(Shl(ones, before), Shr(ones, behind)));
}

// Writes the lists of one row's cells.
struct RowLists {
  const std::uint32_t *row_lights, *row_columns;  // of the row's spans
  std::uint32_t row_size, width;
  FewColumns& few;
  const std::uint32_t* lists;
  std::uint32_t* begin;  // where each column's list begins in `lists`

  // Writes the lists of some columns. Returns their end.
  HWY_NOINLINE std::uint32_t* write(const Columns& columns, std::uint32_t* to) const {
    const RowLists row = *this;  // a copy, which stays in registers: no store can change it
    const std::uint32_t strip = columns.end - columns.begin <= 16 ? 4 : 8, most = FewColumns::k_strips * strip;
    for (std::uint32_t column = columns.begin; column < columns.end; column += most) {
      const Columns window{column, std::min(columns.end, column + most)};
      if (row.row_size <= Lanes(DU()))
        to = row.write_kept<1>({LoadU(DU(), row.row_lights)}, {row.bits_from(0, window)}, window, 0, to);
      else
        to = row.are_narrow(window, strip) ? row.by_strips(window, strip, to) : row.at_once(window, to);
    }
    return to;
  }

 private:
  // The number of vectors of lights and bits that stay in registers.
  static constexpr std::size_t k_most_vectors = HWY_TARGET <= HWY_AVX3 ? 8 : 4;

  // Do most spans miss most strips? Selecting the spans of a strip costs as much as testing them for a fifth of the
  // columns.
  HWY_INLINE bool are_narrow(const Columns& window, std::uint32_t strip) const {
    return 5 * (width + strip) < 4 * (window.end - window.begin);
  }

  // With all spans.
  HWY_INLINE std::uint32_t* at_once(const Columns& window, std::uint32_t* to) const {
    std::uint32_t* bits = few.strips[0].bits.data();
    for (std::uint32_t i = 0; i < row_size; i += lane_count()) StoreU(bits_from(i, window), DU(), bits + i);
    return write_some(row_lights, bits, row_size, window, 0, to);
  }

  // Strip by strip, with the spans that touch the strip. The spans of all strips are selected first, so that none are
  // read while they are still being written.
  HWY_INLINE std::uint32_t* by_strips(const Columns& window, std::uint32_t strip, std::uint32_t* to) const {
    std::size_t counts[FewColumns::k_strips] = {};
    for (std::uint32_t i = 0; i < row_size; i += lane_count()) {
      const VU lights = LoadU(DU(), row_lights + i), bits = bits_from(i, window);
      for (std::uint32_t s = 0; s < FewColumns::k_strips; ++s) {
        const VU of_strip = all(((1u << strip) - 1) << s * strip);
        const MU some = Ne(And(bits, of_strip), Zero(DU()));
        append(lights, some, few.strips[s].lights.data() + counts[s]);
        append(bits, some, few.strips[s].bits.data() + counts[s]);
        counts[s] += CountTrue(DU(), some);
      }
    }
    for (std::uint32_t s = 0; s < FewColumns::k_strips; ++s) {
      FewColumns::Strip& chosen = few.strips[s];
      StoreU(Zero(DU()), DU(), chosen.bits.data() + counts[s]);
      const std::uint32_t column = window.begin + s * strip;
      const Columns columns{column, std::min(window.end, column + strip)};
      to = write_some(chosen.lights.data(), chosen.bits.data(), counts[s], columns, s * strip, to);
    }
    return to;
  }

  // Bits of a vector of spans; none after the last span.
  HWY_INLINE VU bits_from(std::uint32_t i, const Columns& columns) const {
    return IfThenElseZero(FirstN(DU(), row_size - i), column_bits(LoadU(DU(), row_columns + i), columns));
  }

  // Writes the lists of columns from some lights, which fill at least this many vectors, and the bits of these columns
  // and of `skipped` columns before them. A vector of lights without bits can be read after the last one.
  template <std::size_t vectors = 1>
  HWY_INLINE std::uint32_t* write_some(const std::uint32_t* lights, const std::uint32_t* bits, std::size_t count,
                                       const Columns& columns, std::uint32_t skipped, std::uint32_t* to) const {
    if constexpr (vectors > k_most_vectors) {
      return each_column(columns, skipped, to, [&](VU bit, std::uint32_t* at) {
        for (std::size_t i = 0; i < count; i += Lanes(DU()))
          at = append(LoadU(DU(), lights + i), TestBit(LoadU(DU(), bits + i), bit), at);
        return at;
      });
    } else {
      if (count > vectors * Lanes(DU())) return write_some<vectors + 1>(lights, bits, count, columns, skipped, to);
      std::array<VU, vectors> kept_lights, kept_bits;
      for (std::size_t i = 0; i < vectors; ++i) {
        kept_lights[i] = LoadU(DU(), lights + i * Lanes(DU()));
        kept_bits[i] = LoadU(DU(), bits + i * Lanes(DU()));
      }
      return write_kept<vectors>(kept_lights, kept_bits, columns, skipped, to);
    }
  }

  // The same, with vectors in registers.
  template <std::size_t vectors>
  HWY_INLINE std::uint32_t* write_kept(const std::array<VU, vectors>& lights, const std::array<VU, vectors>& bits,
                                       const Columns& columns, std::uint32_t skipped, std::uint32_t* to) const {
    return each_column(columns, skipped, to, [&](VU bit, std::uint32_t* at) {
      for (std::size_t i = 0; i < vectors; ++i) at = append(lights[i], TestBit(bits[i], bit), at);
      return at;
    });
  }

  // add(bit, to) appends the lights that have a column's bit.
  template <class Add>
  HWY_INLINE std::uint32_t* each_column(const Columns& columns, std::uint32_t skipped, std::uint32_t* to,
                                        Add&& add) const {
    VU bit = all(1u << skipped);
    for (std::uint32_t column = columns.begin; column < columns.end; ++column) {
      begin[column] = static_cast<std::uint32_t>(to - lists);
      to = add(bit, to);
      bit = ShiftLeft<1>(bit);
    }
    return to;
  }
};

std::uint32_t* write_lists(const BandSpans& band, const BandHole& hole, FewColumns& few, std::uint32_t* to,
                           const std::uint32_t* lists, std::uint32_t* begin) {
  for (std::uint32_t row = 0; row < band.rows; ++row, begin += band.row_columns) {
    const std::size_t first = std::size_t{row} * band.pitch;
    const RowLists row_lists{band.lights + first, band.columns + first, band.sizes[row], band.width, few, lists, begin};
    if (band.sizes[row] == 0) {
      std::fill_n(begin, band.row_columns, static_cast<std::uint32_t>(to - lists));
    } else if (!hole.rows.holds(static_cast<int>(row))) {
      to = row_lists.write({0, band.row_columns}, to);
    } else {
      to = row_lists.write({0, static_cast<std::uint32_t>(hole.columns.first)}, to);
      std::fill_n(begin + hole.columns.first, hole.columns.count(), static_cast<std::uint32_t>(to - lists));
      to = row_lists.write({static_cast<std::uint32_t>(hole.columns.last) + 1, band.row_columns}, to);
    }
  }
  return to;
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(target_name);
HWY_EXPORT(add_batch);
HWY_EXPORT(add_rows);
HWY_EXPORT(count_pairs);
HWY_EXPORT(write_lists);

const char* simd_target_name() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

bool add_batch_rows(const BandSpans& band, int first_row, int last_row, const std::uint32_t* columns,
                    const std::uint32_t* lights, std::uint8_t* is_left) {
  return HWY_DYNAMIC_DISPATCH(add_batch)(band, first_row, last_row, columns, lights, is_left);
}

void add_listed_rows(const BandSpans& band, int first_row, int last_row, const std::uint32_t* sizes,
                     const std::uint32_t* columns, const std::uint32_t* lights) {
  HWY_DYNAMIC_DISPATCH(add_rows)(band, first_row, last_row, sizes, columns, lights);
}

std::uint64_t pairs_of(const BandSpans& band) {
  return HWY_DYNAMIC_DISPATCH(count_pairs)(band);
}

std::uint32_t* write_band_lists(const BandSpans& band, const BandHole& hole, FewColumns& few, std::uint32_t* to,
                                const std::uint32_t* lists, std::uint32_t* begin) {
  few.make_room(band.rows == 0 ? 0 : *std::max_element(band.sizes, band.sizes + band.rows));
  return HWY_DYNAMIC_DISPATCH(write_lists)(band, hole, few, to, lists, begin);
}

}  // namespace clusterbench::assign
#endif
