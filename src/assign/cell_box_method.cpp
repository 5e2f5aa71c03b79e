#include "assign/cell_box_method.h"

namespace clusterbench::assign {

void CellAabbs::build(const grid::Grid& grid) {
  boxes_.clear();
  boxes_.reserve(grid.cell_count());
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
    boxes_.push_back(geom::box_around(std::get<geom::FrustumPiece>(grid.cell(cell))));
}

void CellPlanes::build(const grid::Grid& grid) {
  planes_.assign(grid.cell_count(), {});
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
    geom::outward_planes(std::get<geom::FrustumPiece>(grid.cell(cell)), planes_[cell].of);
}

}  // namespace clusterbench::assign
