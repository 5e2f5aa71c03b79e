#include "assign/bounds/cell_extents.h"

#include <cstdint>
#include <variant>

#include "core/memory.h"
#include "geom/single_precision/bounding_volumes.h"

namespace clusterbench::assign {

CellExtents cell_extents(const grid::Grid& grid) {
  const Vec3i cells = grid.cells();
  CellExtents out{.x = {{}, cells.x}, .y = {{}, cells.y}, .z = {}, .columns = cells.x, .rows = cells.y};
  check_memory("boxes around cells", std::uint64_t(cells.z) * (std::uint64_t(cells.x) + std::uint64_t(cells.y) + 1),
               sizeof(Interval));
  const auto add = [&](CellExtents::Axis& axis, int i, const Vec3i& cell) {
    const geom::Box box = geom::box_around(std::get<geom::FrustumCell>(grid.cell(grid::cell_index(cell, cells))));
    axis.extents.push_back({box.lo[i], box.hi[i]});
  };
  for (int z = 0; z < cells.z; ++z) {
    for (int x = 0; x < cells.x; ++x) add(out.x, 0, {x, 0, z});
    for (int y = 0; y < cells.y; ++y) add(out.y, 1, {0, y, z});
    add(out.z, 2, {0, 0, z});
  }
  return out;
}

}  // namespace clusterbench::assign
