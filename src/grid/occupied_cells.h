#pragma once
// The parts of a frustum grid's cells, or of its tiles, in which visible surfaces may lie, from the depths of a frame.

#include <cstdint>
#include <span>
#include <vector>

#include "core/memory.h"
#include "geom/shapes/cell.h"

namespace clusterbench::grid {

struct OccupiedCells {
  // Numbered as the grid's. A method with one list per tile has a single slice.
  Vec3i counts{0};
  // The parts of cell c, whose union is its occupied volume, are parts[begin[c]] .. parts[begin[c + 1] - 1], front to
  // back; none if nothing is visible.
  std::vector<std::uint32_t> begin{0};
  std::vector<geom::FrustumCell> parts;

  // Ends the current cell: it gets all parts added since the previous cell's end. Throws Error beyond the limit on
  // memory.
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
