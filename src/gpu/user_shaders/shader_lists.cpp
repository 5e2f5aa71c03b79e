#include "gpu/user_shaders/shader_lists.h"

#include <algorithm>

#include "assign/storages/fixed.h"

namespace clusterbench::gpu {
namespace {

std::uint64_t size_of_type(const std::string& type) {
  return layout::size_of(layout::number_type(type));
}

const layout::Buffer* find_buffer(const std::vector<layout::Buffer>& buffers, const std::string& name) {
  const auto found = std::ranges::find(buffers, name, &layout::Buffer::name);
  return found == buffers.end() ? nullptr : &*found;
}

// Elements from byte `at` on.
std::uint64_t room_in(const std::vector<layout::Buffer>& buffers, const std::string& name, std::uint64_t at,
                      std::uint64_t stride) {
  const layout::Buffer* buffer = find_buffer(buffers, name);
  return buffer == nullptr || stride == 0 || buffer->bytes.size() < at ? 0 : (buffer->bytes.size() - at) / stride;
}

const char* storage_of(const std::string& layout) {
  if (layout == "packed" || layout == "runs" || layout == "linked")
    return layout == "packed" ? "packed" : layout == "runs" ? "runs" : "linked";
  return layout.starts_with("bits") ? "bitfield" : "packed";
}

void write_count(std::byte* at, layout::NumberType type, std::uint64_t value) {
  for (std::uint64_t i = 0; i < layout::size_of(type); ++i) at[i] = static_cast<std::byte>(value >> 8 * i & 0xffu);
}

}  // namespace

ShaderLists::ShaderLists(const std::string& layout, std::uint32_t index_bits)
    : layout_(layout), index_bits_(index_bits) {}

std::unique_ptr<assign::Storage> ShaderLists::new_storage(std::uint64_t per_cell) const {
  if (layout_ == "fixed")
    return std::make_unique<assign::FixedLists>(assign::FixedLists::Form{
        .cap = static_cast<std::uint32_t>(per_cell), .index_bits = index_bits_, .is_uploaded = false});
  const assign::StorageDescriptor& row = *assign::find_storage(storage_of(layout_));
  return row.make(assign::Params(row.params));
}

void ShaderLists::take(Contents contents, const grid::Grid& grid, const view::LightRanges& lights,
                       std::uint64_t per_cell) {
  if (!storage_ || per_cell != per_cell_) storage_ = new_storage(per_cell);
  per_cell_ = per_cell;
  contents_ = std::move(contents);
  storage_->start(grid, lights);
  storage_->store(contents_.lists);
}

assign::StructureUse ShaderLists::use() const {
  assign::StructureUse out;
  out.index_entries = contents_.entries;
  for (const ShaderBufferUse& buffer : contents_.buffers)
    (buffer.is_header ? out.header_bytes : out.index_bytes) += buffer.used * buffer.element_bytes;
  out.dropped_pairs = contents_.dropped_pairs;
  out.overflowing_cells = contents_.overflowing_cells;
  out.repeated_pairs = contents_.repeated_pairs;
  return out;
}

assign::StructureLimit ShaderLists::limit() const {
  assign::StructureLimit out{contents_.entry_room, 0};
  for (const ShaderBufferUse& buffer : contents_.buffers) out.bytes += buffer.room * buffer.element_bytes;
  return out;
}

std::vector<assign::BufferNeed> ShaderLists::buffers() const {
  std::vector<assign::BufferNeed> out;
  for (const ShaderBufferUse& buffer : contents_.buffers)
    out.push_back({buffer.name, static_cast<std::uint32_t>(buffer.element_bytes), buffer.used, buffer.room});
  return out;
}

std::vector<ShaderBufferUse> buffer_use(const result::DumpLists& lists, std::uint64_t rows, std::uint64_t entries,
                                        const std::vector<layout::Buffer>& buffers) {
  std::vector<ShaderBufferUse> out;
  const bool is_fixed = lists.layout == "fixed", is_bits = lists.layout.starts_with("bits");
  const auto add_lists = [&](const char* name, std::uint64_t element_bytes, std::uint64_t used, std::uint64_t room) {
    out.push_back({name, element_bytes, used, room, false, std::min(entries, room), room});
  };
  if (is_bits && lists.rows) {
    const std::uint64_t word = size_of_type(lists.word.value_or("u32")), words = rows * lists.rows->stride / word;
    out.push_back({"words", word, words, words, false, words, words});
  } else if (is_fixed && lists.rows && lists.entries && !lists.entries->buffer) {
    out.push_back({"cells", lists.rows->stride, rows, rows, false, entries, rows * lists.per_cell.value_or(0)});
  } else if (lists.rows) {
    out.push_back({lists.layout == "linked" ? "heads" : "headers", lists.rows->stride, rows, rows, true, 0, 0});
  }
  if (lists.entries && lists.entries->buffer) {
    const bool is_runs = lists.layout == "runs";
    const std::uint64_t stride = lists.entries->stride.value_or(size_of_type(lists.entries->type) * (is_runs ? 2 : 1)),
                        room = is_fixed
                                   ? rows * lists.per_cell.value_or(0)
                                   : room_in(buffers, *lists.entries->buffer, lists.entries->at.value_or(0), stride);
    add_lists(is_runs ? "runs" : "indices", stride, is_fixed ? room : std::min(entries, room), room);
  }
  if (lists.nodes) {
    const std::uint64_t room = room_in(buffers, lists.nodes->buffer, lists.nodes->at.value_or(0), lists.nodes->stride);
    add_lists("nodes", lists.nodes->stride, std::min(entries, room), room);
  }
  if (lists.ranges) {
    const layout::Buffer* buffer = find_buffer(buffers, lists.ranges->buffer);
    const std::uint64_t bytes = buffer == nullptr ? 0 : buffer->bytes.size();
    out.push_back({"ranges", 1, bytes, bytes, true, 0, 0});
  }
  return out;
}

Dropped cut_counts(const result::DumpLists& lists, std::uint64_t rows, std::vector<layout::Buffer>& buffers) {
  Dropped out;
  const bool is_fixed = lists.layout == "fixed";
  if ((!is_fixed && lists.layout != "packed") || !lists.rows || !lists.counts) return out;
  const auto found = std::ranges::find(buffers, lists.rows->buffer, &layout::Buffer::name);
  if (found == buffers.end()) return out;
  const layout::BufferReader reader(buffers);
  std::vector<layout::Field> counts;
  for (const result::DumpField& field : *lists.counts) {
    if (field.bits) return out;  // a count within a word is read as it is
    counts.push_back(reader.field(field, lists.rows->stride, "/counts"));
  }
  const layout::Field offset =
      lists.offset ? reader.field(*lists.offset, lists.rows->stride, "/offset") : layout::Field{};
  std::uint64_t entry_room = 0, unit = 1;
  if (!is_fixed && lists.entries && lists.entries->buffer) {
    const std::uint64_t stride = lists.entries->stride.value_or(size_of_type(lists.entries->type));
    entry_room = room_in(buffers, *lists.entries->buffer, lists.entries->at.value_or(0), stride);
    unit = lists.offset_is.value_or("entries") == "bytes" ? stride : 1;
  }
  for (std::uint64_t row = 0; row < rows; ++row) {
    const std::uint64_t at = lists.rows->at.value_or(0) + row * lists.rows->stride;
    if (at > found->bytes.size() || lists.rows->stride > found->bytes.size() - at) return out;  // the decoder says so
    std::byte* bytes = found->bytes.data() + at;
    std::uint64_t room = lists.per_cell.value_or(0);
    if (!is_fixed) room = entry_room - std::min(entry_room, offset.whole(bytes) / unit);
    bool is_full = false;
    for (const layout::Field& field : counts) {
      const std::uint64_t count = field.whole(bytes), kept = std::min(count, room);
      room -= kept;
      if (kept == count) continue;
      is_full = true;
      out.pairs += count - kept;
      write_count(bytes + field.at, field.type, kept);
      if (!is_fixed && kept == 0) write_count(bytes + offset.at, offset.type, 0);
    }
    out.cells += is_full ? 1 : 0;
  }
  return out;
}

}  // namespace clusterbench::gpu
