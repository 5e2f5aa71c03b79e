#include "layout/decode.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"

namespace clusterbench::layout {
namespace {

using result::DumpLists;

std::string number(std::uint64_t value) {
  return std::to_string(value);
}

template <class T>
const T& needed(const std::optional<T>& part, const ListPart& of, const char* key) {
  if (part) return *part;
  throw Error("", of.pointer + "/" + key, "is missing: layout '" + of.lists.layout + "' needs it");
}

// The lights of one part.
struct PartLights {
  std::uint64_t first = 0, count = 0;

  PartLights(const ListPart& part, std::uint32_t lights) {
    first = part.lists.first_light.value_or(0);
    if (first > lights)
      throw Error("", part.pointer + "/first_light",
                  "is " + number(first) + "; the dump has " + number_of(lights, "light"));
    count = part.lists.lights.value_or(lights - first);
    if (count > lights - first)
      throw Error("", part.pointer + "/lights",
                  "is " + number(count) + " from " + number(first) + " on; the dump has " + number_of(lights, "light"));
  }
};

// An entry of a list, as it lies in its buffer.
struct Place {
  const Buffer* buffer = nullptr;  // null: in the dump itself
  std::uint64_t byte = 0, value = 0;
};

// The lists as they grow, and where the entries of one list are if that is asked for.
class ListSink {
 public:
  explicit ListSink(std::vector<std::uint32_t>& lights, std::vector<Place>* places = nullptr)
      : lights_(lights), places_(places) {}
  std::size_t size() const { return lights_.size(); }
  void add(std::uint64_t light, const Place& place) {
    lights_.push_back(static_cast<std::uint32_t>(light));
    if (places_ != nullptr) places_->push_back(place);
  }

 private:
  std::vector<std::uint32_t>& lights_;
  std::vector<Place>* places_;
};

// Where a list is read.
struct CellRow {
  std::uint32_t cell = 0;
  std::uint64_t row = 0, tile = 0, slice = 0;  // in the part's own order
};

// Reads the lists of one part. A reader's constructor checks all that does not depend on values.
class PartReader {
 public:
  PartReader(const ListPart& part, const Shape& shape) : lights_(part, shape.lights) {}
  virtual ~PartReader() = default;
  PartReader(const PartReader&) = delete;
  PartReader& operator=(const PartReader&) = delete;

  // Appends lights of the dump.
  virtual void read(const CellRow& at, ListSink& out, Faults& faults) const = 0;

 protected:
  std::string lights_text() const { return "the " + number_of(lights_.count, "light"); }

  // False if there is no such light. `first`: the value that means light 0.
  bool add(std::uint64_t value, std::uint64_t first, const Rows& rows, std::uint64_t row, std::uint64_t at,
           const CellRow& cell, ListSink& out, Faults& faults) const {
    const Place place{&rows.buffer(), rows.byte_of(row) + at, value};
    if (value >= first && value - first < lights_.count) {
      out.add(lights_.first + (value - first), place);
      return true;
    }
    faults.add({place.buffer, place.byte, value, cell.cell, index_fault(value, first)});
    return false;
  }
  std::string index_fault(std::uint64_t value, std::uint64_t first) const {
    if (value == k_no_whole) return "an index is no whole number";
    if (value < first) return "index " + number(value) + " is below that of the first light, " + number(first);
    return "index " + number(value) + " is not below " + lights_text() +
           (first > 0 ? ", which begin at " + number(first) : "");
  }

  PartLights lights_;
};

std::uint64_t rows_of_cells(const ListPart& part, const Shape& shape) {
  const std::uint64_t tiles = static_cast<std::uint64_t>(shape.cells.x) * static_cast<std::uint64_t>(shape.cells.y);
  return part.lists.per_tile.value_or(false) ? tiles : tiles * static_cast<std::uint64_t>(shape.cells.z);
}

Rows cell_rows(const BufferReader& reader, const ListPart& part, std::uint64_t rows, std::uint64_t row_bytes) {
  const result::DumpRows& given = needed(part.lists.rows, part, "rows");
  const Buffer& buffer = reader.buffer(given.buffer, part.pointer + "/rows/buffer");
  return reader.rows(buffer, given.at.value_or(0), given.stride, rows, row_bytes, part.pointer + "/rows", "row");
}

std::vector<Field> count_fields(const BufferReader& reader, const ListPart& part) {
  std::vector<Field> out;
  if (!part.lists.counts) return out;
  const std::uint64_t stride = needed(part.lists.rows, part, "rows").stride;
  for (std::size_t i = 0; i < part.lists.counts->size(); ++i)
    out.push_back(reader.field((*part.lists.counts)[i], stride, part.pointer + "/counts/" + std::to_string(i)));
  return out;
}

std::uint64_t end_of(std::span<const Field> fields) {
  std::uint64_t end = 0;
  for (const Field& field : fields) end = std::max(end, field.end());
  return end;
}

// The entry behind a list's last; it may lie in the row of the next cell.
std::vector<Field> end_field(const BufferReader& reader, const ListPart& part, std::uint64_t stride) {
  if (!part.lists.end) return {};
  const std::string pointer = part.pointer + "/end";
  if (part.lists.counts) throw Error("", pointer, "does not go with counts: either says how long a list is");
  const result::DumpField& end = *part.lists.end;
  if (const auto& offset = part.lists.offset; offset && offset->at == end.at && offset->bits == end.bits)
    throw Error("", pointer, "is the field that `offset` is: all lists would be empty");
  const std::uint64_t size = size_of(number_type(end.type));
  if (end.at > stride && (end.at - stride > stride || size > stride - (end.at - stride)))
    throw Error("", pointer + "/at",
                "is " + number(end.at) + ": its " + number_of(size, "byte") + " end beyond the next row; rows are " +
                    number_of(stride, "byte") + " apart");
  return {reader.field(end, end.at + size, pointer)};
}

// Where the end of a list is the offset of the next one, the last one's needs a row more than there are cells.
void check_last_end(const BufferReader& reader, const ListPart& part, std::uint64_t rows, std::uint64_t row_bytes) {
  const result::DumpRows& given = *part.lists.rows;
  const std::uint64_t bytes = reader.buffer(given.buffer, part.pointer + "/rows/buffer").bytes.size();
  const std::uint64_t begin = std::min(given.at.value_or(0), bytes);
  if (row_bytes <= given.stride || given.stride == 0 || (bytes - begin) / given.stride != rows) return;
  throw Error("", part.pointer + "/end",
              "of the last cell would lie behind the end of buffer '" + given.buffer + "', in a row more than the " +
                  number(rows) + " that its " + number_of(bytes, "byte") + " hold");
}

// The sum of a row's counts, which may not be above `most`; nullopt: it is.
std::optional<std::uint64_t> count_in(const std::vector<Field>& fields, const Rows& rows, const CellRow& at,
                                      std::uint64_t most, const std::string& most_text, Faults& faults) {
  std::uint64_t sum = 0;
  for (const Field& field : fields) {
    const std::uint64_t count = field.whole(rows.row(at.row));
    if (count <= most - sum) {
      sum += count;
      continue;
    }
    faults.add({&rows.buffer(), rows.byte_of(at.row) + field.at, count, at.cell,
                count == k_no_whole && !is_whole(field.type)
                    ? "a count is no whole number"
                    : "count " + number(count) + (sum > 0 ? " after " + number(sum) : "") + " is above " + most_text});
    return std::nullopt;
  }
  return sum;
}

// Offset and counts (or end) in rows, entries elsewhere. runs: two numbers per entry.
class PackedReader final : public PartReader {
 public:
  PackedReader(const ListPart& part, const BufferReader& reader, const Shape& shape)
      : PartReader(part, shape), is_runs_(part.lists.layout == "runs") {
    const result::DumpRows& given = needed(part.lists.rows, part, "rows");
    std::vector<Field> fields{
        reader.field(needed(part.lists.offset, part, "offset"), given.stride, part.pointer + "/offset")};
    offset_ = fields.front();
    end_ = end_field(reader, part, given.stride);
    if (end_.empty() && !part.lists.counts)
      throw Error("", part.pointer,
                  "has neither counts nor end, and layout '" + part.lists.layout + "' needs one of them");
    counts_ = count_fields(reader, part);
    fields.insert(fields.end(), counts_.begin(), counts_.end());
    fields.insert(fields.end(), end_.begin(), end_.end());
    if (!end_.empty()) check_last_end(reader, part, rows_of_cells(part, shape), end_of(end_));
    rows_ = cell_rows(reader, part, rows_of_cells(part, shape), end_of(fields));

    const result::DumpEntries& entries = needed(part.lists.entries, part, "entries");
    const Buffer& buffer =
        reader.buffer(needed(entries.buffer, part, "entries/buffer"), part.pointer + "/entries/buffer");
    type_ = number_type(entries.type);
    const std::uint64_t size = size_of(type_) * (is_runs_ ? 2 : 1);
    entries_ =
        reader.all_rows(buffer, entries.at.value_or(0), entries.stride.value_or(size), size, part.pointer + "/entries");
    first_ = entries.first_light.value_or(0);
    offset_unit_ = part.lists.offset_is.value_or("entries") == "bytes" ? entries_.stride() : 1;
  }

  void read(const CellRow& at, ListSink& out, Faults& faults) const override {
    const std::uint64_t given = offset_.whole(rows_.row(at.row));
    const std::optional<std::uint64_t> count = end_.empty() ? counted(at, faults) : count_to_end(at, given, faults);
    if (!count || *count == 0) return;
    const std::uint64_t offset = given == k_no_whole ? given : given / offset_unit_;
    if (given % offset_unit_ != 0 || offset > entries_.count() || *count > entries_.count() - offset) {
      faults.add({&rows_.buffer(), rows_.byte_of(at.row) + offset_.at, given, at.cell,
                  given % offset_unit_ != 0
                      ? "offset " + number(given) + " is no multiple of " + number(offset_unit_) + " bytes"
                      : "offset " + number(given) + " and count " + number(*count) + " end beyond the " +
                            number(entries_.count()) + " entries of buffer '" + entries_.buffer().name + "'"});
      return;
    }
    const std::size_t begin = out.size();
    for (std::uint64_t i = offset; i < offset + *count; ++i)
      if (!read_entry(i, at, begin, out, faults)) return;
  }

 private:
  std::optional<std::uint64_t> counted(const CellRow& at, Faults& faults) const {
    return count_in(counts_, rows_, at, lights_.count, lights_text() + " of its part", faults);
  }

  // From the offset to the end.
  std::optional<std::uint64_t> count_to_end(const CellRow& at, std::uint64_t offset, Faults& faults) const {
    const Field& field = end_.front();
    const std::uint64_t end = field.whole(rows_.row(at.row));
    const auto fault = [&](const std::string& text) {
      faults.add({&rows_.buffer(), rows_.byte_of(at.row) + field.at, end, at.cell, text});
      return std::nullopt;
    };
    if (end == k_no_whole && !is_whole(field.type)) return fault("an end is no whole number");
    if (end < offset) return fault("end " + number(end) + " is before the offset " + number(offset));
    if ((end - offset) % offset_unit_ != 0)
      return fault("end " + number(end) + " is no multiple of " + number(offset_unit_) + " bytes behind the offset " +
                   number(offset));
    const std::uint64_t count = (end - offset) / offset_unit_;
    if (count > lights_.count)
      return fault("end " + number(end) + " is " + number(count) + " behind the offset " + number(offset) +
                   ", more than " + lights_text() + " of its part");
    return count;
  }

  // `begin`: the cell's first light in `out`.
  bool read_entry(std::uint64_t entry, const CellRow& at, std::size_t begin, ListSink& out, Faults& faults) const {
    const std::uint64_t value = whole_at(entries_.row(entry), type_), index = value - first_;
    if (!is_runs_) return add(value, first_, entries_, entry, 0, at, out, faults);
    const std::uint64_t more = whole_at(entries_.row(entry) + size_of(type_), type_);
    if (value < first_ || index >= lights_.count || more >= lights_.count - index) {
      faults.add(
          {&entries_.buffer(), entries_.byte_of(entry), value, at.cell,
           "the run of light " + number(value) + " and " + number(more) + " more is not below " + lights_text()});
      return false;
    }
    if (more >= lights_.count - (out.size() - begin)) {
      faults.add({&entries_.buffer(), entries_.byte_of(entry), value, at.cell,
                  "with the run of light " + number(value) + " and " + number(more) +
                      " more the cell has more lights than " + lights_text() + " of its part"});
      return false;
    }
    for (std::uint64_t i = index; i <= index + more; ++i)
      out.add(lights_.first + i, {&entries_.buffer(), entries_.byte_of(entry), value});
    return true;
  }

  bool is_runs_;
  Rows rows_, entries_;
  Field offset_;
  std::vector<Field> counts_, end_;  // one of both; end_ has one field
  NumberType type_ = NumberType::u32;
  std::uint64_t first_ = 0, offset_unit_ = 1;
};

// The same room for each cell, in rows or beside each other.
class FixedReader final : public PartReader {
 public:
  FixedReader(const ListPart& part, const BufferReader& reader, const Shape& shape)
      : PartReader(part, shape), per_cell_(needed(part.lists.per_cell, part, "per_cell")) {
    const result::DumpEntries& entries = needed(part.lists.entries, part, "entries");
    type_ = number_type(entries.type);
    first_ = entries.first_light.value_or(0);
    end_ = entries.end;
    step_ = entries.stride.value_or(size_of(type_));
    const std::uint64_t rows = rows_of_cells(part, shape);
    counts_ = count_fields(reader, part);
    if (counts_.empty() && !end_)
      throw Error("", part.pointer, "layout 'fixed' needs counts or entries.end, to know where a list ends");
    const std::uint64_t size = size_of(type_);
    constexpr std::uint64_t k_most = std::numeric_limits<std::uint64_t>::max();
    if (step_ == 0) throw Error("", part.pointer + "/entries/stride", "is 0; allowed: at least 1");
    if (per_cell_ > (k_most - size) / step_)
      throw Error("", part.pointer + "/per_cell", "is " + number(per_cell_) + ", which no buffer holds");
    const std::uint64_t list_bytes = (per_cell_ - 1) * step_ + size;
    if (entries.buffer) {
      if (!counts_.empty()) rows_ = cell_rows(reader, part, rows, end_of(counts_));
      const Buffer& buffer = reader.buffer(*entries.buffer, part.pointer + "/entries/buffer");
      entries_ = reader.rows(buffer, entries.at.value_or(0), per_cell_ * step_, rows, list_bytes,
                             part.pointer + "/entries", "list");
      return;
    }
    entry_at_ = entries.at.value_or(0);
    const std::uint64_t stride = needed(part.lists.rows, part, "rows").stride;
    if (entry_at_ > stride || list_bytes > stride - entry_at_)
      throw Error("", part.pointer + "/entries/at",
                  "is " + number(entry_at_) + ": " + number(per_cell_) + " entries there end beyond the stride of " +
                      number(stride) + " bytes");
    entries_ = rows_ = cell_rows(reader, part, rows, std::max(end_of(counts_), entry_at_ + list_bytes));
  }

  void read(const CellRow& at, ListSink& out, Faults& faults) const override {
    std::uint64_t count = per_cell_;
    if (!counts_.empty()) {
      const auto given = count_in(counts_, rows_, at, per_cell_, "per_cell, " + number(per_cell_), faults);
      if (!given) return;
      count = *given;
    }
    const std::byte* list = entries_.row(at.row) + entry_at_;
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t value = whole_at(list + i * step_, type_);
      if (end_ && value == *end_) return;
      if (!add(value, first_, entries_, at.row, entry_at_ + i * step_, at, out, faults)) return;
    }
  }

 private:
  std::uint64_t per_cell_, first_ = 0, step_ = 0, entry_at_ = 0;
  std::optional<std::uint64_t> end_;
  NumberType type_ = NumberType::u32;
  std::vector<Field> counts_;
  Rows rows_, entries_;
};

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

class LinkedReader final : public PartReader {
 public:
  LinkedReader(const ListPart& part, const BufferReader& reader, const Shape& shape) : PartReader(part, shape) {
    const result::DumpNodes& nodes = needed(part.lists.nodes, part, "nodes");
    const std::string pointer = part.pointer + "/nodes";
    light_ = reader.field(nodes.light, nodes.stride, pointer + "/light");
    next_ = reader.field(nodes.next, nodes.stride, pointer + "/next");
    const Field fields[] = {light_, next_};
    nodes_ = reader.all_rows(reader.buffer(nodes.buffer, pointer + "/buffer"), nodes.at.value_or(0), nodes.stride,
                             end_of(fields), pointer);
    const std::uint64_t stride = needed(part.lists.rows, part, "rows").stride;
    head_ = reader.field(needed(part.lists.head, part, "head"), stride, part.pointer + "/head");
    rows_ = cell_rows(reader, part, rows_of_cells(part, shape), head_.end());
    const auto all_bits = [](const Field& field) {
      const std::uint64_t width = 8 * size_of(field.type);
      return field.mask & (width == 64 ? k_no_whole : (std::uint64_t{1} << width) - 1);
    };
    head_end_ = nodes.end.value_or(all_bits(head_));
    next_end_ = nodes.end.value_or(all_bits(next_));
  }

  void read(const CellRow& at, ListSink& out, Faults& faults) const override {
    std::uint64_t node = head_.whole(rows_.row(at.row));
    if (node == head_end_) return;
    std::uint64_t byte = rows_.byte_of(at.row) + head_.at;
    const Buffer* buffer = &rows_.buffer();
    for (std::uint64_t seen = 0;; ++seen) {
      if (node >= nodes_.count() || seen == lights_.count) {
        faults.add({buffer, byte, node, at.cell,
                    node >= nodes_.count()
                        ? "node " + number(node) + " is not below the " + number_of(nodes_.count(), "node") +
                              " of buffer '" + nodes_.buffer().name + "'"
                        : "the list has more nodes than " + lights_text() +
                              " of its part: it goes in a circle, or has a light twice"});
        return;
      }
      if (!add(light_.whole(nodes_.row(node)), 0, nodes_, node, light_.at, at, out, faults)) return;
      byte = nodes_.byte_of(node) + next_.at;
      buffer = &nodes_.buffer();
      node = next_.whole(nodes_.row(node));
      if (node == next_end_) return;
    }
  }

 private:
  Rows rows_, nodes_;
  Field head_, light_, next_;
  std::uint64_t head_end_ = 0, next_end_ = 0;
};

class InlineReader final : public PartReader {
 public:
  InlineReader(const ListPart& part, const Shape& shape)
      : PartReader(part, shape), cells_(needed(part.lists.cells, part, "cells")) {
    const std::uint64_t rows = rows_of_cells(part, shape);
    if (cells_.size() != rows)
      throw Error("", part.pointer + "/cells",
                  "has " + number_of(cells_.size(), "list") + "; the grid has " + number_of(rows, "cell"));
  }

  void read(const CellRow& at, ListSink& out, Faults& faults) const override {
    for (const std::uint64_t light : cells_[at.row]) {
      if (light < lights_.count) {
        out.add(lights_.first + light, {nullptr, 0, light});
        continue;
      }
      faults.add({nullptr, 0, light, at.cell, "index " + number(light) + " is not below " + lights_text()});
      return;
    }
  }

 private:
  const std::vector<std::vector<std::uint64_t>>& cells_;
};

std::unique_ptr<PartReader> make_reader(const ListPart& part, const BufferReader& reader, const Shape& shape) {
  const std::string& layout = part.lists.layout;
  if (layout == "packed" || layout == "runs") return std::make_unique<PackedReader>(part, reader, shape);
  if (layout == "fixed") return std::make_unique<FixedReader>(part, reader, shape);
  if (layout == "linked") return std::make_unique<LinkedReader>(part, reader, shape);
  if (layout == "inline") return std::make_unique<InlineReader>(part, shape);
  return std::make_unique<BitsReader>(part, reader, shape);
}

// Sorts the list that begins at `begin` and keeps each light once. Returns how many entries that removes.
std::size_t tidy(std::vector<std::uint32_t>& lights, std::size_t begin) {
  const auto from = lights.begin() + static_cast<std::ptrdiff_t>(begin);
  if (!std::is_sorted(from, lights.end())) std::sort(from, lights.end());
  const auto end = std::unique(from, lights.end());
  const auto removed = static_cast<std::size_t>(lights.end() - end);
  lights.erase(end, lights.end());
  return removed;
}

std::string place_text(const Place& place) {
  return place.buffer == nullptr ? std::string("")
                                 : ", first at byte " + number(place.byte) + " of buffer '" + place.buffer->name + "'";
}

void check_pairs(std::size_t pairs, const std::string& pointer) {
  if (pairs <= memory_limit() / sizeof(std::uint32_t) && pairs <= std::numeric_limits<std::uint32_t>::max()) return;
  throw Error("", pointer,
              "its lists have more than " + number(pairs) +
                  " pairs of a cell and a light, which take more memory than " + number(memory_limit() >> 20) + " MiB");
}

}  // namespace

namespace {

// The lists of all parts, cell by cell.
class Decoder {
 public:
  Decoder(std::span<const ListPart> parts, std::span<const Buffer> buffers, const Shape& shape)
      : parts_(parts), shape_(shape) {
    const BufferReader reader(buffers);
    for (const ListPart& part : parts) readers_.push_back(make_reader(part, reader, shape));
  }

  void read_cell(std::uint32_t cell, Vec3i at) {
    std::vector<std::uint32_t>& lights = out_.lists.lights;
    const std::uint64_t unreadable = out_.faults.count;
    ListSink sink(lights);
    read_parts(cell, at, sink, out_.faults);
    const std::size_t removed = tidy(lights, out_.lists.begin.back());
    if (removed > 0 && out_.faults.count == unreadable) add_twice(cell, at, removed);
    check_pairs(lights.size(), parts_.front().pointer);
    out_.lists.begin.push_back(static_cast<std::uint32_t>(lights.size()));
  }
  Decoded& out() { return out_; }

 private:
  void read_parts(std::uint32_t cell, Vec3i at, ListSink& sink, Faults& faults) const {
    const std::uint64_t tile = shape_.order.tile(at, shape_.cells);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const DumpLists& lists = parts_[i].lists;
      const bool is_of_tiles = lists.per_tile.value_or(false) || lists.layout.starts_with("bits_and");
      const CellRow row{cell, is_of_tiles ? tile : shape_.order.cell(at, shape_.cells), tile,
                        shape_.order.slice(at.z, shape_.cells)};
      readers_[i]->read(row, sink, faults);
    }
  }

  // Reads the list again, now with the places of its entries.
  void add_twice(std::uint32_t cell, Vec3i at, std::size_t entries) {
    Faults& faults = out_.faults;
    faults.twice += entries;
    if (faults.first_twice.size() >= Faults::k_most_kept) return;
    std::vector<std::uint32_t> lights;
    std::vector<Place> places;
    ListSink sink(lights, &places);
    Faults none;
    read_parts(cell, at, sink, none);
    std::map<std::uint32_t, Place> first;
    for (std::size_t i = 0; i < lights.size() && faults.first_twice.size() < Faults::k_most_kept; ++i) {
      const auto [earlier, is_new] = first.emplace(lights[i], places[i]);
      if (is_new) continue;
      faults.first_twice.push_back(
          {places[i].buffer, places[i].byte, places[i].value, cell,
           "light " + number(lights[i]) + " is twice in its list" + place_text(earlier->second)});
    }
  }

  std::span<const ListPart> parts_;
  const Shape& shape_;
  std::vector<std::unique_ptr<PartReader>> readers_;
  Decoded out_;
};

}  // namespace

Decoded decode(std::span<const ListPart> parts, std::span<const Buffer> buffers, const Shape& shape) {
  Decoder decoder(parts, buffers, shape);
  const std::uint64_t cells = static_cast<std::uint64_t>(shape.cells.x) * static_cast<std::uint64_t>(shape.cells.y) *
                              static_cast<std::uint64_t>(shape.cells.z);
  check_memory("lists of cells", cells + 1, sizeof(std::uint32_t));
  decoder.out().lists.begin.reserve(cells + 1);
  decoder.out().lists.begin.push_back(0);
  std::uint32_t cell = 0;
  for (int z = 0; z < shape.cells.z; ++z)
    for (int y = 0; y < shape.cells.y; ++y)
      for (int x = 0; x < shape.cells.x; ++x) decoder.read_cell(cell++, {x, y, z});
  return std::move(decoder.out());
}

std::uint64_t bytes_of(std::span<const ListPart> parts, std::span<const Buffer> buffers) {
  std::set<std::string> names;
  for (const ListPart& part : parts) {
    if (part.lists.rows) names.insert(part.lists.rows->buffer);
    if (part.lists.entries && part.lists.entries->buffer) names.insert(*part.lists.entries->buffer);
    if (part.lists.ranges) names.insert(part.lists.ranges->buffer);
    if (part.lists.nodes) names.insert(part.lists.nodes->buffer);
  }
  std::uint64_t sum = 0;
  for (const Buffer& buffer : buffers)
    if (names.contains(buffer.name)) sum += buffer.bytes.size();
  return sum;
}

}  // namespace clusterbench::layout
