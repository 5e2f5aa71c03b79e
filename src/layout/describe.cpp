#include "layout/describe.h"

#include <string>

namespace clusterbench::layout {
namespace {

using assign::ShaderBuffers;
using assign::Walk;

std::string unsigned_of(std::uint64_t bytes) {
  return "u" + std::to_string(8 * bytes);
}

// Offset u32, then counts of points and spots of 16 or 32 bits, then one of boxes.
void add_header(const ShaderBuffers& shader, result::DumpLists& lists) {
  const std::uint64_t count_bytes = shader.has_wide_counts ? 4 : 2;
  lists.rows = result::DumpRows{"headers", {}, std::uint64_t{4} * shader.header_words};
  lists.offset = result::DumpField{0, "u32", {}};
  lists.counts = {{4, unsigned_of(count_bytes), {}}, {4 + count_bytes, unsigned_of(count_bytes), {}}};
  if (shader.has_boxes) lists.counts->push_back({4 + 2 * count_bytes, "u32", {}});
}

result::DumpEntries entries_in(const char* buffer, std::uint64_t bytes) {
  return {buffer, {}, unsigned_of(bytes), {}, {}, {}};
}

bool add_lists(const ShaderBuffers& shader, result::DumpLists& lists) {
  switch (shader.walk) {
    case Walk::packed:
      if (shader.is_sparse) return false;
      lists.layout = "packed";
      add_header(shader, lists);
      lists.entries = entries_in("indices", shader.index_bytes);
      return true;
    case Walk::runs:
      lists.layout = "runs";
      add_header(shader, lists);
      lists.entries = entries_in("runs", shader.index_bytes);
      return true;
    case Walk::fixed:
      lists.layout = "fixed";
      lists.per_cell = shader.per_cell;
      lists.entries = entries_in("indices", shader.index_bytes);
      if (shader.end_mark) {
        lists.entries->end = *shader.end_mark;
      } else {
        lists.rows = result::DumpRows{"counts", {}, 4};
        lists.counts = {{0, "u32", {}}};
      }
      return true;
    case Walk::bitfield:
      lists.layout = "bits";
      lists.rows = result::DumpRows{"words", {}, std::uint64_t{4} * shader.per_cell};
      return true;
    case Walk::linked:
      lists.layout = "linked";
      lists.rows = result::DumpRows{"heads", {}, 4};
      lists.head = result::DumpField{0, "u32", {}};
      lists.nodes = result::DumpNodes{"nodes", {}, 8, {0, "u32", {}}, {4, "u32", {}}, {}};
      return true;
    case Walk::masks:
    case Walk::hierarchy:
      break;
  }
  return false;
}

}  // namespace

std::optional<Described> describe(const ShaderBuffers& shader) {
  Described out;
  if (!add_lists(shader, out.lists)) return std::nullopt;
  for (const ShaderBuffers::Buffer& buffer : shader.buffers) out.buffers.push_back({buffer.name, "", 0, buffer.bytes});
  return out;
}

assign::Lists in_order(const assign::Lists& lists, Vec3i cells, const CellOrder& order) {
  std::vector<std::uint32_t> cell_of_list(lists.cell_count());
  std::uint32_t cell = 0;
  for (int z = 0; z < cells.z; ++z)
    for (int y = 0; y < cells.y; ++y)
      for (int x = 0; x < cells.x; ++x) cell_of_list[order.cell({x, y, z}, cells)] = cell++;
  assign::Lists out;
  out.begin.push_back(0);
  for (const std::uint32_t source : cell_of_list) {
    const auto list = lists.of(source);
    out.lights.insert(out.lights.end(), list.begin(), list.end());
    out.begin.push_back(static_cast<std::uint32_t>(out.lights.size()));
  }
  return out;
}

}  // namespace clusterbench::layout
