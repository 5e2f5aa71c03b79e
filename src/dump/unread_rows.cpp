#include "dump/unread_rows.h"

#include <algorithm>

namespace clusterbench::dump {
namespace {

// A run of rows as a part describes it.
struct RowRun {
  std::string buffer, key;
  std::uint64_t at = 0, stride = 0, rows = 0;
  const char* of;  // "cells": one row for each
};

std::vector<RowRun> runs_of(const layout::ListPart& part, Vec3i cells) {
  const result::DumpLists& lists = part.lists;
  const bool of_tiles = lists.per_tile.value_or(false) || lists.layout.starts_with("bits_and");
  const auto tiles = static_cast<std::uint64_t>(cells.x) * static_cast<std::uint64_t>(cells.y),
             slices = static_cast<std::uint64_t>(cells.z), rows = of_tiles ? tiles : tiles * slices;
  const char* of = of_tiles ? "tiles" : "cells";
  std::vector<RowRun> out;
  if (lists.rows)
    out.push_back(
        {lists.rows->buffer, part.pointer + "/rows", lists.rows->at.value_or(0), lists.rows->stride, rows, of});
  if (lists.layout == "fixed" && lists.entries && lists.entries->buffer) {
    const std::uint64_t size = layout::size_of(layout::number_type(lists.entries->type));
    out.push_back({*lists.entries->buffer, part.pointer + "/entries", lists.entries->at.value_or(0),
                   lists.entries->stride.value_or(size) * lists.per_cell.value_or(0), rows, of});
  }
  if (lists.layout == "bits_and_bins" && lists.ranges)
    out.push_back({lists.ranges->buffer, part.pointer + "/ranges", lists.ranges->at.value_or(0), lists.ranges->stride,
                   slices, "slices"});
  return out;
}

// How often lists and lights name a buffer.
std::size_t uses_of(const std::string& buffer, const result::Dump& dump) {
  std::size_t uses = 0;
  for (const result::DumpLists& lists : dump.lists) {
    uses += lists.rows && lists.rows->buffer == buffer;
    uses += lists.entries && lists.entries->buffer == buffer;
    uses += lists.ranges && lists.ranges->buffer == buffer;
    uses += lists.nodes && lists.nodes->buffer == buffer;
  }
  if (dump.lights.rows)
    for (const result::DumpLightRows& rows : *dump.lights.rows) uses += rows.buffer == buffer;
  return uses;
}

// Rows are known to lie within their buffer.
std::string unread_text(const RowRun& run, const layout::Buffer& buffer) {
  if (run.stride == 0 || run.at > buffer.bytes.size()) return "";
  constexpr std::uint64_t k_alignment = 256;
  const std::uint64_t there = (buffer.bytes.size() - run.at) / run.stride;
  if (there <= run.rows || (there < 2 * run.rows && (there - run.rows) * run.stride < k_alignment)) return "";
  return run.key + ": buffer '" + buffer.name + "' has " + std::to_string(there) +
         " rows from there on, and the grid " + std::to_string(run.rows) + " " + run.of +
         ": are all of them described (grid.tiles, grid.slices)?";
}

}  // namespace

std::vector<std::string> unread_rows(const DumpFile& dump, const ListSet& set, Vec3i cells) {
  std::vector<std::string> out;
  for (const layout::ListPart& part : set.parts)
    for (const RowRun& run : runs_of(part, cells)) {
      const auto buffer = std::ranges::find(dump.buffers, run.buffer, &layout::Buffer::name);
      if (buffer == dump.buffers.end() || uses_of(run.buffer, dump.record) > 1) continue;
      if (std::string text = unread_text(run, *buffer); !text.empty()) out.push_back(std::move(text));
    }
  return out;
}

}  // namespace clusterbench::dump
