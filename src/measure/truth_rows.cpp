#include "measure/truth_rows.h"

#include <algorithm>
#include <cmath>

#include "geom/projection/row_slopes.h"

namespace clusterbench::measure {
namespace {

using Hull = geom::SlopeHull<double>;
using Eye = geom::BallFromEye<double>;
using DepthRange = geom::DepthRange<double>;

ColumnRange columns_touched(const grid::Tiles& tiles, const Hull& slopes) {
  return grid::intervals_touched(tiles.x, slopes.lo, slopes.hi);
}

// Appends the rows of one slab of depths.
void append_slab(const grid::Tiles& tiles, const BallInSpace& ball, DepthRange range, int slice, bool with_inner,
                 std::vector<Row>& rows) {
  const Eye larger{ball.center.x, ball.center.y, -ball.center.z, ball.radius + ball.slack};
  const Eye smaller{larger.x, larger.y, larger.depth, std::max(0.0, ball.radius - ball.slack)};
  Hull up;
  geom::add_disk(up, larger.y, larger.depth, larger.radius * larger.radius, range.near, range.far, 1.0,
                 geom::Errs::outward);
  const ColumnRange touched = grid::descending_intervals_touched(tiles.y, up.lo, up.hi);
  for (int row = touched.first; row <= touched.last; ++row) {
    const double y0 = tiles.y_min(row), y1 = tiles.y_max(row);
    Row found;
    found.outer = columns_touched(tiles, geom::row_slopes(larger, y0, y1, range, geom::Errs::outward));
    if (found.outer.empty()) continue;
    if (with_inner && ball.radius > ball.slack)
      found.inner = columns_touched(tiles, geom::row_slopes(smaller, y0, y1, range, geom::Errs::inward));
    found.first_cell = grid::cell_index({0, row, slice}, {tiles.count.x, tiles.count.y, 0});
    rows.push_back(found);
  }
}

std::vector<Extent> extents(const std::vector<float>& boundaries) {
  std::vector<Extent> list;
  for (std::size_t i = 0; i + 1 < boundaries.size(); ++i)
    list.push_back({std::min(boundaries[i], boundaries[i + 1]), std::max(boundaries[i], boundaries[i + 1])});
  return list;
}

BoxBlock orthographic_block(const grid::ScreenGrid& grid) {
  BoxBlock block{extents(grid.tiles.x), extents(grid.tiles.y), {}, 0};
  for (const Extent& depth : extents(grid.slices.boundaries)) block.z.push_back({-depth.hi, -depth.lo});
  return block;
}

BoxBlock cascade_block(const grid::Grid& grid, int level) {
  const Vec3i cells = grid.cascades().cells;
  // Holes have no cell, so extents come from the outermost column and row, which are never part of one.
  const auto box_at = [&](int x, int y, int z) {
    return std::get<geom::Box>(grid.cell(grid::cell_index({x, y, level * cells.z + z}, cells)));
  };
  BoxBlock block;
  for (int x = 0; x < cells.x; ++x) block.x.push_back({box_at(x, 0, 0).lo.x, box_at(x, 0, 0).hi.x});
  for (int y = 0; y < cells.y; ++y) block.y.push_back({box_at(0, y, 0).lo.y, box_at(0, y, 0).hi.y});
  for (int z = 0; z < cells.z; ++z) block.z.push_back({box_at(0, 0, z).lo.z, box_at(0, 0, z).hi.z});
  block.first_cell = grid::cell_index({0, 0, level * cells.z}, cells);
  const auto hole = [&](int count, const auto& is_hole) {
    ColumnRange range{count, -1};
    for (int i = 0; i < count; ++i)
      if (is_hole(i)) range = {std::min(range.first, i), i};
    return range;
  };
  const grid::CascadesGrid& nested = grid.cascades();
  const Vec3i middle{cells.x / 2, cells.y / 2, 0};
  block.hole_x = hole(cells.x, [&](int x) { return nested.is_hole(level, {x, middle.y, middle.z}); });
  block.hole_y = hole(cells.y, [&](int y) { return nested.is_hole(level, {middle.x, y, middle.z}); });
  block.hole_z = hole(cells.z, [&](int z) { return nested.is_hole(level, {middle.x, middle.y, z}); });
  return block;
}

double gap_to(const Extent& extent, double coordinate) {
  return std::max({0.0, extent.lo - coordinate, coordinate - extent.hi});
}

// Extents that may lie within `reach` of a coordinate; they ascend or descend.
grid::IndexRange extents_near(const std::vector<Extent>& extents, double coordinate, double reach) {
  constexpr double k_slack = 1e-12;  // far more than the rounding of a gap
  const double wider = reach + k_slack * (std::abs(coordinate) + reach);
  const bool ascend = extents.front().lo <= extents.back().lo;
  const auto is_before = [&](const Extent& e) {
    return ascend ? e.hi < coordinate - wider : e.lo > coordinate + wider;
  };
  const auto is_not_beyond = [&](const Extent& e) {
    return ascend ? e.lo <= coordinate + wider : e.hi >= coordinate - wider;
  };
  const auto from = std::partition_point(extents.begin(), extents.end(), is_before);
  const auto to = std::partition_point(from, extents.end(), is_not_beyond);
  return {static_cast<int>(from - extents.begin()), static_cast<int>(to - extents.begin()) - 1};
}

// Columns whose extent meets [middle - half, middle + half].
ColumnRange columns_within(const std::vector<Extent>& columns, double middle, double squared_half) {
  if (!(squared_half >= 0.0)) return {};
  const double half = std::sqrt(squared_half);
  const auto from =
      std::partition_point(columns.begin(), columns.end(), [&](const Extent& e) { return e.hi < middle - half; });
  const auto to = std::partition_point(from, columns.end(), [&](const Extent& e) { return e.lo <= middle + half; });
  return {static_cast<int>(from - columns.begin()), static_cast<int>(to - columns.begin()) - 1};
}

ColumnRange cut(const ColumnRange& range, int first, int last) {
  return {std::max(range.first, first), std::min(range.last, last)};
}

// The parts of a row to the left and right of a hole.
void append_beside(const ColumnRange& hole, const Row& row, std::vector<Row>& rows) {
  for (const auto& [first, last] : {ColumnRange{row.outer.first, hole.first - 1}, {hole.last + 1, row.outer.last}}) {
    const Row part{row.first_cell, cut(row.outer, first, last), cut(row.inner, first, last)};
    if (!part.outer.empty()) rows.push_back(part);
  }
}

}  // namespace

void append_rows(const grid::ScreenGrid& grid, const BallInSpace& ball, std::vector<Row>& rows) {
  const std::vector<float>& depths = grid.slices.boundaries;
  const double depth = -ball.center.z, reach = ball.radius + ball.slack;
  const ColumnRange slices = grid::intervals_touched(depths, depth - reach, depth + reach);
  for (int slice = slices.first; slice <= slices.last; ++slice) {
    const auto k = static_cast<std::size_t>(slice);
    append_slab(grid.tiles, ball, {depths[k], depths[k + 1]}, slice, true, rows);
  }
}

void append_tile_rows(const grid::ScreenGrid& grid, const BallInSpace& ball, std::vector<Row>& rows) {
  const double reach = std::max(0.0, -ball.center.z + ball.radius + ball.slack);
  append_slab(grid.tiles, ball, {0.0, reach}, 0, false, rows);
}

std::vector<BoxBlock> box_blocks(const grid::Grid& grid) {
  if (grid.world_origin()) return {{extents(grid.world().x), extents(grid.world().y), extents(grid.world().z), 0}};
  if (grid.has_tiles()) return {orthographic_block(grid.screen())};
  std::vector<BoxBlock> blocks;
  for (int level = 0; level < grid.cascades().levels; ++level) blocks.push_back(cascade_block(grid, level));
  return blocks;
}

void append_rows(const BoxBlock& block, const BallInSpace& ball, std::vector<Row>& rows) {
  const double larger = ball.radius + ball.slack, smaller = std::max(0.0, ball.radius - ball.slack);
  const grid::IndexRange slices = extents_near(block.z, ball.center.z, larger);
  const grid::IndexRange lines = extents_near(block.y, ball.center.y, larger);
  for (int slice = slices.first; slice <= slices.last; ++slice) {
    const auto z = static_cast<std::size_t>(slice);
    const double gap_z = gap_to(block.z[z], ball.center.z);
    if (gap_z > larger) continue;
    for (int line = lines.first; line <= lines.last; ++line) {
      const auto y = static_cast<std::size_t>(line);
      const double gap_y = gap_to(block.y[y], ball.center.y);
      if (gap_y > larger) continue;
      const double square = gap_z * gap_z + gap_y * gap_y;
      Row row;
      row.outer = columns_within(block.x, ball.center.x, larger * larger - square);
      if (row.outer.empty()) continue;
      if (ball.radius > ball.slack) row.inner = columns_within(block.x, ball.center.x, smaller * smaller - square);
      row.first_cell = block.first_cell + static_cast<std::uint32_t>((z * block.y.size() + y) * block.x.size());
      if (block.hole_z.holds(slice) && block.hole_y.holds(line))
        append_beside(block.hole_x, row, rows);
      else
        rows.push_back(row);
    }
  }
}

}  // namespace clusterbench::measure
