#include "grid/broad_phase.h"

#include <algorithm>
#include <cmath>

namespace clusterbench::grid {
namespace {

double gap_to(const Extent& extent, double coordinate) {
  return std::max({0.0, extent.lo - coordinate, coordinate - extent.hi});
}

// Extents that may be within `reach` of a coordinate; they ascend or descend.
IndexRange extents_near(const std::vector<Extent>& extents, double coordinate, double reach) {
  constexpr double k_slack = 1e-12;  // much more than the rounding of a gap
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
IndexRange columns_within(const std::vector<Extent>& columns, double middle, double squared_half) {
  if (!(squared_half >= 0.0)) return {};
  const double half = std::sqrt(squared_half);
  const auto from =
      std::partition_point(columns.begin(), columns.end(), [&](const Extent& e) { return e.hi < middle - half; });
  const auto to = std::partition_point(from, columns.end(), [&](const Extent& e) { return e.lo <= middle + half; });
  return {static_cast<int>(from - columns.begin()), static_cast<int>(to - columns.begin()) - 1};
}

IndexRange cut(const IndexRange& range, int first, int last) {
  return {std::max(range.first, first), std::min(range.last, last)};
}

// The parts of a row to the left and right of a hole.
void append_beside(const IndexRange& hole, const CellRow& row, std::vector<CellRow>& rows) {
  for (const auto& [first, last] : {IndexRange{row.outer.first, hole.first - 1}, {hole.last + 1, row.outer.last}}) {
    const CellRow part{row.first_cell, cut(row.outer, first, last), cut(row.inner, first, last)};
    if (!part.outer.empty()) rows.push_back(part);
  }
}

void append_block_rows(const BoxBlock& block, const BallInSpace& ball, std::vector<CellRow>& rows) {
  const double larger = ball.radius + ball.slack, smaller = std::max(0.0, ball.radius - ball.slack);
  const IndexRange slices = extents_near(block.z, ball.center.z, larger);
  const IndexRange lines = extents_near(block.y, ball.center.y, larger);
  for (int slice = slices.first; slice <= slices.last; ++slice) {
    const auto z = static_cast<std::size_t>(slice);
    const double gap_z = gap_to(block.z[z], ball.center.z);
    if (gap_z > larger) continue;
    for (int line = lines.first; line <= lines.last; ++line) {
      const auto y = static_cast<std::size_t>(line);
      const double gap_y = gap_to(block.y[y], ball.center.y);
      if (gap_y > larger) continue;
      const double square = gap_z * gap_z + gap_y * gap_y;
      CellRow row;
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

}  // namespace

std::vector<Extent> extents_between(const std::vector<float>& boundaries) {
  std::vector<Extent> list;
  for (std::size_t i = 0; i + 1 < boundaries.size(); ++i)
    list.push_back({std::min(boundaries[i], boundaries[i + 1]), std::max(boundaries[i], boundaries[i + 1])});
  return list;
}

void BoxBroadPhase::append_rows(const BallInSpace& ball, std::vector<CellRow>& rows) const {
  for (const BoxBlock& block : blocks_) append_block_rows(block, ball, rows);
}

}  // namespace clusterbench::grid
