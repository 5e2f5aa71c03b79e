#include "assign/box_grid/box_levels.h"

namespace clusterbench::assign {
namespace {

// The boxes of one level. Its extents come from cells of the top row, the left column and the farthest layer, which are
// never holes.
BoxGrid boxes_of_level(const grid::Grid& grid, int level) {
  const grid::CascadesGrid& cascades = grid.cascades();
  const Vec3i cells = grid.cells(), of_level = cascades.cells;
  const int z0 = level * of_level.z, farthest = z0 + of_level.z - 1;
  const auto box = [&](int x, int y, int z) {
    return std::get<geom::Box>(grid.cell(grid::cell_index({x, y, z}, cells)));
  };
  BoxGrid boxes;
  boxes.first_cell = grid::cell_index({0, 0, z0}, cells);
  for (int x = 0; x < of_level.x; ++x) {
    const geom::Box cell = box(x, 0, farthest);
    boxes.x.push_back({cell.lo.x, cell.hi.x});
  }
  for (int y = 0; y < of_level.y; ++y) {
    const geom::Box cell = box(0, y, farthest);
    boxes.y.push_back({cell.lo.y, cell.hi.y});
  }
  for (int z = z0; z <= farthest; ++z) {
    const geom::Box cell = box(0, 0, z);
    boxes.z.push_back({cell.lo.z, cell.hi.z});
  }
  if (level > 0) {
    boxes.hole_x = {of_level.x / 4, of_level.x * 3 / 4 - 1};
    boxes.hole_y = {of_level.y / 4, of_level.y * 3 / 4 - 1};
    boxes.hole_z = {0, of_level.z / 2 - 1};
  }
  return boxes;
}

BoxAxis axis_of(const std::vector<float>& boundaries) {
  BoxAxis axis;
  for (std::size_t i = 0; i + 1 < boundaries.size(); ++i) axis.push_back({boundaries[i], boundaries[i + 1]});
  return axis;
}

}  // namespace

std::vector<BoxGrid> box_levels(const grid::Grid& grid) {
  if (grid.world_origin()) {
    const grid::WorldGrid& world = grid.world();
    BoxGrid boxes;
    boxes.x = axis_of(world.x);
    boxes.y = axis_of(world.y);
    boxes.z = axis_of(world.z);
    return {boxes};
  }
  std::vector<BoxGrid> levels;
  for (int level = 0; level < grid.cascades().levels; ++level) levels.push_back(boxes_of_level(grid, level));
  return levels;
}

}  // namespace clusterbench::assign
