#pragma once
// Lists in the layouts of engines, written without any code of the decoder.

#include <algorithm>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "assign/contract/lists.h"
#include "assign/contract/storage.h"
#include "core/random.h"
#include "layout/decode.h"
#include "layout/describe.h"

namespace clusterbench::layout::testing {

template <class T>
void put(std::vector<std::byte>& bytes, std::size_t at, T value) {
  if (bytes.size() < at + sizeof value) bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

inline assign::Lists random_lists(Vec3i cells, std::uint32_t lights, double share, std::uint64_t seed) {
  SplitMix64 random(seed);
  assign::Lists lists;
  lists.begin.push_back(0);
  for (int cell = 0; cell < cells.x * cells.y * cells.z; ++cell) {
    for (std::uint32_t light = 0; light < lights; ++light)
      if (random.unit() < share) lists.lights.push_back(light);
    lists.begin.push_back(static_cast<std::uint32_t>(lists.lights.size()));
  }
  return lists;
}

inline Described stored(const std::string& storage, const std::map<std::string, assign::ParamValue>& params,
                        const assign::Lists& lists, const view::LightRanges& lights) {
  const assign::StorageDescriptor* row = assign::find_storage(storage);
  const auto made = row->make(assign::Params(row->params, params));
  made->start(lists.cell_count(), lights);
  made->store(lists);
  return *describe(*made->shader_buffers());
}

// Filament: u32 per froxel, offset in bits 31 to 16 and count in bits 7 to 0; records of 8 bits.
inline Described filament(const assign::Lists& lists) {
  Described out;
  out.buffers = {{"froxels", "froxels.bin", 0, {}}, {"records", "records.bin", 0, {}}};
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    const auto count = static_cast<std::uint32_t>(lists.of(cell).size());
    put<std::uint32_t>(out.buffers[0].bytes, 4 * cell, lists.begin[cell] << 16 | count);
  }
  for (std::size_t i = 0; i < lists.lights.size(); ++i)
    put(out.buffers[1].bytes, i, static_cast<std::uint8_t>(lists.lights[i]));
  out.lists.layout = "packed";
  out.lists.rows = result::DumpRows{"froxels", {}, 4};
  out.lists.offset = result::DumpField{0, "u32", result::Counts2{16, 16}};
  out.lists.counts = {{0, "u32", result::Counts2{0, 8}}};
  out.lists.entries = result::DumpEntries{"records", {}, "u8", {}, {}, {}};
  return out;
}

// One index after the other, where each list begins, and where the last one ends.
inline Described begins(const assign::Lists& lists) {
  Described out;
  out.buffers = {{"begins", "begins.bin", 0, {}}, {"entries", "entries.bin", 0, {}}};
  for (std::size_t cell = 0; cell < lists.begin.size(); ++cell)
    put<std::uint32_t>(out.buffers[0].bytes, 4 * cell, lists.begin[cell]);
  for (std::size_t i = 0; i < lists.lights.size(); ++i)
    put(out.buffers[1].bytes, 2 * i, static_cast<std::uint16_t>(lists.lights[i]));
  out.lists.layout = "packed";
  out.lists.rows = result::DumpRows{"begins", {}, 4};
  out.lists.offset = result::DumpField{0, "u32", {}};
  out.lists.end = result::DumpField{4, "u32", {}};
  out.lists.entries = result::DumpEntries{"entries", {}, "u16", {}, {}, {}};
  return out;
}

// Begin and end of each list, in bytes; lists lie in the order of cells, last cell first.
inline Described begin_and_end(const assign::Lists& lists) {
  Described out = begins(lists);
  out.buffers[0].bytes.clear();
  out.buffers[1].bytes.clear();
  std::uint32_t at = 0;
  for (std::uint32_t cell = lists.cell_count(); cell-- > 0;) {
    put(out.buffers[0].bytes, 8 * std::size_t{cell}, at);
    for (const std::uint32_t light : lists.of(cell)) {
      put(out.buffers[1].bytes, at, static_cast<std::uint16_t>(light));
      at += 2;
    }
    put(out.buffers[0].bytes, 8 * std::size_t{cell} + 4, at);
  }
  out.lists.rows->stride = 8;
  out.lists.offset_is = "bytes";
  return out;
}

// The tutorial: a struct of 32 bytes of bounds, a count at 32, `cap` indices from 36.
inline Described tutorial(const assign::Lists& lists, std::uint32_t cap) {
  Described out;
  out.buffers = {{"clusters", "clusters.bin", 0, {}}};
  const std::size_t stride = 36 + 4 * std::size_t{cap};
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    const auto list = lists.of(cell);
    put(out.buffers[0].bytes, (cell + 1) * stride - 4, ~0u);
    put(out.buffers[0].bytes, cell * stride + 32, static_cast<std::uint32_t>(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) put(out.buffers[0].bytes, cell * stride + 36 + 4 * i, list[i]);
  }
  out.lists.layout = "fixed";
  out.lists.rows = result::DumpRows{"clusters", {}, stride};
  out.lists.counts = {{32, "u32", {}}};
  out.lists.per_cell = cap;
  out.lists.entries = result::DumpEntries{{}, 36, "u32", {}, {}, {}};
  return out;
}

// PlayCanvas: N indices per cell that count from 1, 0 ends the list.
inline Described from_one(const assign::Lists& lists, std::uint32_t cap) {
  Described out;
  out.buffers = {{"cells", "cells.bin", 0, {}}};
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
    for (std::uint32_t i = 0; i < cap; ++i) {
      const auto list = lists.of(cell);
      put(out.buffers[0].bytes, 2 * (std::size_t{cell} * cap + i),
          static_cast<std::uint16_t>(i < list.size() ? list[i] + 1 : 0));
    }
  out.lists.layout = "fixed";
  out.lists.per_cell = cap;
  out.lists.entries = result::DumpEntries{"cells", {}, "u16", {}, 1, 0};
  return out;
}

inline Described in_json(const assign::Lists& lists) {
  Described out;
  out.lists.layout = "inline";
  out.lists.cells.emplace();
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
    out.lists.cells->emplace_back(lists.of(cell).begin(), lists.of(cell).end());
  return out;
}

// Tiles and ranges of lights, and the lists that they mean. Cells of the lists are in the grid's own order.
struct TileLists {
  assign::Lists lists;
  std::vector<std::vector<std::uint32_t>> tiles;  // by x + nx * y from the top
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>>
      ranges;  // [tile or 0][slice from near], first and end
};

inline TileLists random_tiles(Vec3i cells, std::uint32_t lights, bool range_per_tile, std::uint64_t seed) {
  SplitMix64 random(seed);
  TileLists out;
  const auto tiles = static_cast<std::size_t>(cells.x * cells.y), slices = static_cast<std::size_t>(cells.z);
  out.tiles.resize(tiles);
  for (auto& tile : out.tiles)
    for (std::uint32_t light = 0; light < lights; ++light)
      if (random.unit() < 0.3) tile.push_back(light);
  out.ranges.resize(range_per_tile ? tiles : 1);
  for (auto& of_tile : out.ranges)
    for (std::size_t z = 0; z < slices; ++z) {
      const auto first = static_cast<std::uint32_t>(random.unit() * lights);
      const auto count = static_cast<std::uint32_t>(random.unit() * (lights - first));
      of_tile.emplace_back(first, first + count);  // some are empty
    }
  out.lists.begin.push_back(0);
  for (std::size_t z = 0; z < slices; ++z)
    for (std::size_t tile = 0; tile < tiles; ++tile) {
      const auto [first, end] = out.ranges[range_per_tile ? tile : 0][z];
      for (const std::uint32_t light : out.tiles[tile])
        if (light >= first && light < end) out.lists.lights.push_back(light);
      out.lists.begin.push_back(static_cast<std::uint32_t>(out.lists.lights.size()));
    }
  return out;
}

// Godot (a range per tile and slice behind the tile's bits, ends outside) and Unity URP (per slice, ends inside).
inline Described tile_bits(const TileLists& given, Vec3i cells, std::uint32_t lights, const CellOrder& order) {
  const bool per_tile = given.ranges.size() > 1 || cells.x * cells.y == 1;
  const std::size_t words = (lights + 31) / 32, slices = static_cast<std::size_t>(cells.z);
  const std::size_t stride = 4 * (words + (per_tile ? slices : 0));
  Described out;
  out.buffers = {{"tiles", "tiles.bin", 0, {}}, {"bins", "bins.bin", 0, {}}};
  for (int y = 0; y < cells.y; ++y)
    for (int x = 0; x < cells.x; ++x) {
      const auto from = static_cast<std::size_t>(x + cells.x * y);
      const std::size_t row = order.tile({x, y, 0}, cells) * stride;
      std::vector<std::uint32_t> bits(words, 0);
      for (const std::uint32_t light : given.tiles[from]) bits[light / 32] |= 1u << light % 32;
      for (std::size_t w = 0; w < words; ++w) put(out.buffers[0].bytes, row + 4 * w, bits[w]);
      for (int z = 0; z < cells.z; ++z) {
        const auto [first, end] = given.ranges[per_tile ? from : 0][static_cast<std::size_t>(z)];
        const std::size_t slice = order.slice(z, cells);
        if (per_tile)
          put(out.buffers[0].bytes, row + 4 * (words + slice), first | end << 16);
        else
          put(out.buffers[1].bytes, 8 * slice, first == end ? 0x0000'ffffu : first | (end - 1) << 16);
      }
    }
  if (!per_tile) put(out.buffers[1].bytes, 8 * (slices - 1) + 4, 0u);
  out.lists.layout = per_tile ? "bits_and_slice_ranges" : "bits_and_bins";
  out.lists.rows = result::DumpRows{"tiles", {}, stride};
  result::DumpLightRanges ranges{"bins", {}, 8, {}, {0, "u16", {}}, {2, "u16", {}}, "last", {}};
  if (per_tile) ranges = {"tiles", 4 * words, 4, stride, {0, "u32", result::Counts2{0, 16}}, {2, "u16", {}}, "end", {}};
  out.lists.ranges = ranges;
  return out;
}

inline Decoded decoded(const Described& described, const Shape& shape) {
  const ListPart part{described.lists, "/lists/0"};
  return decode({&part, 1}, described.buffers, shape);
}

}  // namespace clusterbench::layout::testing
