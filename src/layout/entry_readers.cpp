// Lists whose lights stand one after the other, as numbers.

#include <limits>

#include "layout/part_reader.h"

namespace clusterbench::layout {
namespace {

std::vector<Field> count_fields(const BufferReader& reader, const ListPart& part) {
  std::vector<Field> out;
  if (!part.lists.counts) return out;
  const std::uint64_t stride = needed(part.lists.rows, part, "rows").stride;
  for (std::size_t i = 0; i < part.lists.counts->size(); ++i)
    out.push_back(reader.field((*part.lists.counts)[i], stride, part.pointer + "/counts/" + std::to_string(i)));
  return out;
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

}  // namespace

std::unique_ptr<PartReader> make_packed_reader(const ListPart& part, const BufferReader& reader, const Shape& shape) {
  return std::make_unique<PackedReader>(part, reader, shape);
}

std::unique_ptr<PartReader> make_fixed_reader(const ListPart& part, const BufferReader& reader, const Shape& shape) {
  return std::make_unique<FixedReader>(part, reader, shape);
}

}  // namespace clusterbench::layout
