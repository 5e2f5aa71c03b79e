#pragma once
// What the depths of a frame leave of a frustum grid's cells, or of its tiles: of each cell the parts in which visible
// surfaces may lie.

#include <cstdint>
#include <span>
#include <vector>

#include "core/memory.h"
#include "geom/shapes/cell.h"

namespace clusterbench::grid {

struct OccupiedCells {
  // Numbered as the grid's. A method with one list per tile has a single slice.
  Vec3i counts{0};
  // The parts of cell c, which is their union, are parts[begin[c]] .. parts[begin[c + 1] - 1], front to back; none
  // where nothing is visible.
  std::vector<std::uint32_t> begin{0};
  std::vector<geom::FrustumCell> parts;

  // The parts behind those of the cell before are all of this one. Throws Error beyond the limit on memory.
  void end_cell() {
    check_memory("parts of cells that hold surfaces", parts.size(), sizeof(geom::FrustumCell));
    begin.push_back(static_cast<std::uint32_t>(parts.size()));
  }
  std::uint32_t cell_count() const { return static_cast<std::uint32_t>(begin.size()) - 1; }
  std::span<const geom::FrustumCell> of(std::uint32_t cell) const {
    return {parts.data() + begin[cell], begin[cell + 1] - begin[cell]};
  }
};

}  // namespace clusterbench::grid
