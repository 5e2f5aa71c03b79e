#include <bit>

#include "layout/part_reader.h"

namespace clusterbench::layout {
namespace {

// Ranges of lights per slice, or per tile and slice, with or without bits.
class LightRangesReader {
 public:
  LightRangesReader(const ListPart& part, const BufferReader& reader, const Shape& shape, std::uint64_t words_bytes) {
    const result::DumpLightRanges& ranges = needed(part.lists.ranges, part, "ranges");
    const std::string pointer = part.pointer + "/ranges";
    first_ = reader.field(ranges.first, ranges.stride, pointer + "/first");
    last_ = reader.field(ranges.last, ranges.stride, pointer + "/last");
    is_end_ = ranges.last_is.value_or("last") == "end";
    words_at_ = ranges.words_at;
    if (words_at_ && (*words_at_ > ranges.stride || words_bytes > ranges.stride - *words_at_))
      throw Error(
          "", pointer + "/words_at",
          "is " + number(*words_at_) + ": " + number(words_bytes) + " bytes of bits there end beyond the stride");
    const Field fields[] = {first_, last_};
    const std::uint64_t row_bytes = std::max(end_of(fields), words_at_ ? *words_at_ + words_bytes : 0);
    const Buffer& buffer = reader.buffer(ranges.buffer, pointer + "/buffer");
    const auto slices = static_cast<std::uint64_t>(shape.cells.z);
    const std::uint64_t at = ranges.at.value_or(0);
    slices_ = reader.rows(buffer, at, ranges.stride, slices, row_bytes, pointer, "range");
    if (part.lists.layout != "bits_and_slice_ranges") return;
    tile_stride_ = needed(ranges.tile_stride, part, "ranges/tile_stride");
    const std::uint64_t tile_bytes = (slices - 1) * ranges.stride + row_bytes;
    reader.rows(buffer, at, tile_stride_, rows_of_cells(part, shape), tile_bytes, pointer, "tile");
  }

  struct Range {
    std::uint64_t first, end;
  };
  // Of the lights of the part; nullopt: an end that cannot be.
  std::optional<Range> range(const CellRow& at, std::uint64_t lights, Faults& faults) const {
    const std::byte* row = slices_.row(at.slice) + at.tile * tile_stride_;
    const std::uint64_t first = first_.whole(row), last = last_.whole(row);
    if (is_end_ ? first >= last : first > last) return Range{0, 0};
    const std::uint64_t end = is_end_ ? last : last + 1;
    if (end <= lights && last != k_no_whole) return Range{first, end};
    faults.add({&slices_.buffer(), slices_.byte_of(at.slice) + at.tile * tile_stride_ + last_.at, last, at.cell,
                "the range of lights " + number(first) + " to " + number(last) + " is not below the " +
                    number_of(lights, "light")});
    return std::nullopt;
  }
  // Bits of the slice's own lights; null without.
  const std::byte* words(const CellRow& at) const { return words_at_ ? slices_.row(at.slice) + *words_at_ : nullptr; }

 private:
  Rows slices_;
  Field first_, last_;
  bool is_end_ = false;
  std::uint64_t tile_stride_ = 0;
  std::optional<std::uint64_t> words_at_;
};

class BitsReader final : public PartReader {
 public:
  BitsReader(const ListPart& part, const BufferReader& reader, const Shape& shape)
      : PartReader(part, shape),
        word_(number_type(part.lists.word.value_or("u32"))),
        first_bit_(part.lists.first_bit.value_or(0)),
        has_others_(part.lists.first_bit.has_value()) {
    const std::uint64_t width = 8 * size_of(word_);
    const result::DumpRows& given = needed(part.lists.rows, part, "rows");
    words_ = first_bit_ / width + (first_bit_ % width + lights_.count + width - 1) / width;
    const std::uint64_t bytes = words_ * size_of(word_);
    if (first_bit_ / 8 > given.stride || bytes > given.stride)
      throw Error("", part.pointer + "/rows/stride",
                  "is " + number(given.stride) + "; bits of " + number_of(lights_.count, "light") +
                      (has_others_ ? " from bit " + number(first_bit_) + " on" : std::string("")) + " take " +
                      number(bytes) + " bytes");
    ListPart tiles = part;
    if (part.lists.layout != "bits") tiles.lists.per_tile = true;
    rows_ = cell_rows(reader, tiles, rows_of_cells(tiles, shape), bytes);
    if (part.lists.layout != "bits") ranges_.emplace(tiles, reader, shape, bytes);
  }

  void read(const CellRow& at, ListSink& out, Faults& faults) const override {
    LightRangesReader::Range range{0, k_no_whole};
    if (ranges_) {
      const auto found = ranges_->range(at, lights_.count, faults);
      if (!found) return;
      range = *found;
    }
    const std::uint64_t width = 8 * size_of(word_);
    const std::byte* own = ranges_ ? ranges_->words(at) : nullptr;
    for (std::uint64_t w = 0; w < words_; ++w) {
      std::uint64_t bits = whole_at(rows_.row(at.row) + w * size_of(word_), word_);
      if (own != nullptr) bits &= whole_at(own + w * size_of(word_), word_);
      for (; bits != 0; bits &= bits - 1) {
        const std::uint64_t bit = w * width + static_cast<std::uint64_t>(std::countr_zero(bits));
        if (has_others_ && (bit < first_bit_ || bit - first_bit_ >= lights_.count)) continue;
        const std::uint64_t light = bit - first_bit_;
        const bool is_in_range = light >= range.first && light < range.end;
        if (is_in_range && !add(light, 0, rows_, at.row, w * size_of(word_), at, out, faults)) return;
      }
    }
  }

 private:
  NumberType word_;
  std::uint64_t first_bit_, words_ = 0;
  bool has_others_;  // bits that are no lights
  Rows rows_;
  std::optional<LightRangesReader> ranges_;
};

}  // namespace

std::unique_ptr<PartReader> make_bits_reader(const ListPart& part, const BufferReader& reader, const Shape& shape) {
  return std::make_unique<BitsReader>(part, reader, shape);
}

}  // namespace clusterbench::layout
