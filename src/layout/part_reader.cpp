#include "layout/part_reader.h"

namespace clusterbench::layout {

std::uint64_t rows_of_cells(const ListPart& part, const Shape& shape) {
  const std::uint64_t tiles = static_cast<std::uint64_t>(shape.cells.x) * static_cast<std::uint64_t>(shape.cells.y);
  return part.lists.per_tile.value_or(false) ? tiles : tiles * static_cast<std::uint64_t>(shape.cells.z);
}

Rows cell_rows(const BufferReader& reader, const ListPart& part, std::uint64_t rows, std::uint64_t row_bytes) {
  const result::DumpRows& given = needed(part.lists.rows, part, "rows");
  const Buffer& buffer = reader.buffer(given.buffer, part.pointer + "/rows/buffer");
  return reader.rows(buffer, given.at.value_or(0), given.stride, rows, row_bytes, part.pointer + "/rows", "row");
}

std::uint64_t end_of(std::span<const Field> fields) {
  std::uint64_t end = 0;
  for (const Field& field : fields) end = std::max(end, field.end());
  return end;
}

namespace {

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

}  // namespace

std::unique_ptr<PartReader> make_reader(const ListPart& part, const BufferReader& reader, const Shape& shape) {
  const std::string& layout = part.lists.layout;
  if (layout == "packed" || layout == "runs") return make_packed_reader(part, reader, shape);
  if (layout == "fixed") return make_fixed_reader(part, reader, shape);
  if (layout == "linked") return std::make_unique<LinkedReader>(part, reader, shape);
  if (layout == "inline") return std::make_unique<InlineReader>(part, shape);
  return make_bits_reader(part, reader, shape);
}

}  // namespace clusterbench::layout
