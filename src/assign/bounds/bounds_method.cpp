#include "assign/bounds/bounds_method.h"

#include "core/memory.h"
#include "geom/single_precision/bounding_volumes.h"

namespace clusterbench::assign {

void CellAabbs::build(const grid::Grid& grid) {
  boxes_.clear();
  check_memory("boxes around cells", grid.cell_count(), sizeof(geom::Box));
  boxes_.reserve(grid.cell_count());
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
    boxes_.push_back(geom::box_around(std::get<geom::FrustumCell>(grid.cell(cell))));
}

void FrustumCells::build(const grid::Grid& grid) {
  check_memory("frustum cells", grid.cell_count(), sizeof(geom::FrustumCell));
  cells_.clear();
  cells_.reserve(grid.cell_count());
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
    cells_.push_back(std::get<geom::FrustumCell>(grid.cell(cell)));
}

void CellPlanes::build(const grid::Grid& grid) {
  check_memory("planes of cells", grid.cell_count(), sizeof(planes_[0]));
  planes_.assign(grid.cell_count(), {});
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
    geom::outward_planes(std::get<geom::FrustumCell>(grid.cell(cell)), planes_[cell].of);
}

}  // namespace clusterbench::assign
