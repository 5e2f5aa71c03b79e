#pragma once
// The order in which a program numbers its cells: which axis is the fastest, and where its first row and slice are.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geom/shapes/vec.h"

namespace clusterbench::layout {

struct CellOrder {
  std::string axes = "xyz";  // the fastest first
  bool is_from_bottom = false, is_from_far = false;

  // The number of a cell. `at`: column from the left, row from the top, slice from the near end.
  std::uint64_t cell(Vec3i at, Vec3i cells) const { return number(at, cells, true); }
  // The number of its tile, in the same order without slices.
  std::uint64_t tile(Vec3i at, Vec3i cells) const { return number(at, cells, false); }
  std::uint64_t slice(int z, Vec3i cells) const {
    return static_cast<std::uint64_t>(is_from_far ? cells.z - 1 - z : z);
  }

  // The cell of a number.
  Vec3i cell_at(std::uint64_t cell, Vec3i cells) const { return at(cell, cells, true); }
  // The cell in slice z (from the near end) whose tile has this number.
  Vec3i tile_at(std::uint64_t tile, int z, Vec3i cells) const {
    Vec3i out = at(tile, cells, false);
    out.z = z;
    return out;
  }

  friend bool operator==(const CellOrder&, const CellOrder&) = default;

 private:
  std::uint64_t number(Vec3i at, Vec3i cells, bool with_slices) const {
    if (is_from_bottom) at.y = cells.y - 1 - at.y;
    if (is_from_far) at.z = cells.z - 1 - at.z;
    std::uint64_t out = 0, step = 1;
    for (const char axis : axes) {
      const int i = axis - 'x';
      if (i == 2 && !with_slices) continue;
      out += static_cast<std::uint64_t>(at[i]) * step;
      step *= static_cast<std::uint64_t>(cells[i]);
    }
    return out;
  }

  Vec3i at(std::uint64_t number, Vec3i cells, bool with_slices) const {
    Vec3i out{0};
    for (const char axis : axes) {
      const int i = axis - 'x';
      if (i == 2 && !with_slices) continue;
      out[i] = static_cast<int>(number % static_cast<std::uint64_t>(cells[i]));
      number /= static_cast<std::uint64_t>(cells[i]);
    }
    if (is_from_bottom) out.y = cells.y - 1 - out.y;
    if (is_from_far && with_slices) out.z = cells.z - 1 - out.z;
    return out;
  }
};

// 6 orders of axes x 2 of rows x 2 of slices.
inline std::vector<CellOrder> all_orders() {
  std::vector<CellOrder> out;
  for (const char* axes : {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"})
    for (const bool is_from_bottom : {false, true})
      for (const bool is_from_far : {false, true}) out.push_back({axes, is_from_bottom, is_from_far});
  return out;
}

}  // namespace clusterbench::layout
