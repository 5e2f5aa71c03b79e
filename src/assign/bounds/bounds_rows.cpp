#include "assign/bounds/bounds_rows.h"

#include <limits>
#include <variant>

#include "geom/single_precision/bounding_volumes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/bounds/bounds_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/bounds/bounds_rows-inl.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

M is_none(V square) {
  return square < Zero(D());
}

// The first and the last of a lane's columns that touches(column) says it touches, as an entry; none if there is none.
// Columns are counted from the box's first, in lockstep.
template <class Touches>
HWY_INLINE VU ends(const Boxes& boxes, int most, Touches&& touches) {
  const VI beyond = all_int(std::numeric_limits<std::int32_t>::max());
  VI first = beyond, last = Zero(DI());
  for (int column = 0; column < most; ++column) {
    const VI index = all_int(column);
    const MI is_touched = And(RebindMask(DI(), touches(column)), boxes.columns > index);
    first = Min(first, IfThenElse(is_touched, index, beyond));
    last = IfThenElse(is_touched, index, last);
  }
  const auto is_some = RebindMask(DU(), first < beyond);
  return IfThenElse(is_some, boxes.entry(first, last), Set(DU(), BatchRows::k_none));
}

int most_columns(const Boxes& boxes) {
  const MI wanted = boxes.rows > Zero(DI());
  return GetLane(MaxOfLanes(DI(), IfThenElseZero(wanted, boxes.columns)));
}

void bounds_rows(int grid_rows, const BallBatch& batch, BatchRows& out) {
  const Boxes boxes(batch);
  if (!boxes.start(grid_rows, batch.count, out)) return;
  const VU entry = boxes.entry(Zero(DI()), boxes.columns - all_int(1));
  const VI end = boxes.first_row + boxes.rows;
  for (int row = out.first_row; row <= out.last_row; ++row) {
    const VI index = all_int(row);
    const MI holds = AndNot(index < boxes.first_row, index < end);
    StoreU(IfThenElse(RebindMask(DU(), holds), entry, Set(DU(), BatchRows::k_none)), DU(),
           out.columns.data() + static_cast<std::size_t>(row) * out.lanes);
  }
}

// --- Sphere refinement ---

struct Remainder {
  V depth, squared_radius;
};

HWY_INLINE Remainder cut_to_slice(V depth, V radius, float depth0, float depth1) {
  const V nearer = Min(Max(depth, all(depth0)), all(depth1));
  const V gap = nearer - depth;
  return {nearer, radius * radius - gap * gap};
}

// A row's plane, and how far above it a ball's centre is.
struct RowPlane {
  V along, distance;
};

HWY_INLINE Remainder cut_to_row(const Remainder& ball, const RowPlane& top, const RowPlane& bottom) {
  const M is_above = top.distance > Zero(D());
  const V gap = Max(IfThenElse(is_above, top.distance, Neg(bottom.distance)), Zero(D()));
  const V along = IfThenElse(is_above, top.along, Neg(bottom.along));
  return {ball.depth - gap * along, ball.squared_radius - gap * gap};
}

// For each column's plane of the lanes' boxes: its normal's part along the depth, and what the centre's x adds to the
// distance from it, which no cut changes.
HWY_INLINE void prepare_columns(const RefinementPlanes& planes, const Boxes& boxes, int most, V x, LaneColumns& out) {
  const std::size_t lanes = Lanes(D());
  out.reserve(planes.column_across.size() * k_row_lanes);
  const VI last = all_int(static_cast<int>(planes.column_across.size()) - 1);
  for (int i = 0; i <= most; ++i) {
    const VI index = Min(boxes.first_column + all_int(i), last);
    const std::size_t to = static_cast<std::size_t>(i) * lanes;
    V distance = gathered(planes.column_across, index) * x;
    if (!planes.column_offset.empty()) distance = distance + gathered(planes.column_offset, index);
    StoreU(distance, D(), out.first.data() + to);
    StoreU(gathered(planes.column_along, index), D(), out.second.data() + to);
  }
}

HWY_INLINE VU columns_reached(const Boxes& boxes, int most, const Remainder& ball, const LaneColumns& columns) {
  const std::size_t lanes = Lanes(D());
  const auto distance = [&](int plane) {
    const std::size_t at = static_cast<std::size_t>(plane) * lanes;
    const V along = LoadU(D(), columns.second.data() + at) * ball.depth;
    return LoadU(D(), columns.first.data() + at) + along;
  };
  V left = distance(0);
  return ends(boxes, most, [&](int column) {
    const V right = distance(column + 1);
    const V gap = Max(Neg(left), right);
    left = right;
    return Or(gap <= Zero(D()), gap * gap <= ball.squared_radius);
  });
}

void refined_rows(const RefinementPlanes& planes, const BallBatch& batch, LaneColumns& columns, BatchRows& out) {
  const BoundedBalls& bounded = batch.bounded;
  const int grid_rows = static_cast<int>(planes.row_across.size()) - 1;
  const auto z = static_cast<std::size_t>(batch.slice);
  Boxes boxes(batch);
  const Remainder ball = cut_to_slice(gathered(bounded.depth, boxes.indices), gathered(bounded.radius, boxes.indices),
                                      planes.depths[z], planes.depths[z + 1]);
  boxes.keep(Not(is_none(ball.squared_radius)));
  if (!boxes.start(grid_rows, batch.count, out)) return;
  const V y = gathered(bounded.y, boxes.indices);
  const int most = most_columns(boxes);
  prepare_columns(planes, boxes, most, gathered(bounded.x, boxes.indices), columns);
  const auto plane_at = [&](VI index) {
    const VI plane = Min(index, all_int(grid_rows));
    const V along = gathered(planes.row_along, plane);
    V distance = gathered(planes.row_across, plane) * y + along * ball.depth;
    if (!planes.row_offset.empty()) distance = distance + gathered(planes.row_offset, plane);
    return RowPlane{along, distance};
  };
  RowPlane top = plane_at(boxes.first_row);
  walk_rows(boxes, grid_rows, out, [&](VI row, MI wanted) {
    const RowPlane bottom = plane_at(row + all_int(1));
    const Remainder in_row = cut_to_row(ball, top, bottom);
    top = bottom;
    const VU none = Set(DU(), BatchRows::k_none);
    const MI reaches = AndNot(RebindMask(DI(), is_none(in_row.squared_radius)), wanted);
    if (AllFalse(DI(), reaches)) return none;
    return IfThenElse(RebindMask(DU(), reaches), columns_reached(boxes, most, in_row, columns), none);
  });
}

// --- Boxes around cells ---

HWY_INLINE V squared_gap(const CellExtents::Axis& axis, VI index, V center) {
  const V below = gathered(axis.lo, index) - center, above = center - gathered(axis.hi, index);
  const V gap = Max(Zero(D()), Max(below, above));
  return gap * gap;
}

HWY_INLINE void prepare_gaps(const CellExtents& cells, const Boxes& boxes, int slice, int most, V x, LaneColumns& out) {
  const std::size_t lanes = Lanes(D());
  out.reserve(static_cast<std::size_t>(cells.columns) * k_row_lanes);
  const VI last = all_int(cells.columns - 1), before = all_int(slice * cells.x.pitch);
  for (int i = 0; i < most; ++i) {
    const VI index = Min(boxes.first_column + all_int(i), last) + before;
    StoreU(squared_gap(cells.x, index, x), D(), out.first.data() + static_cast<std::size_t>(i) * lanes);
  }
}

// Sums of squares are rounded to what is at least each square and grows with each: so what one gap puts out of reach,
// no other brings back, and the columns that a row's boxes reach are one interval, because the boxes' ends ascend.
void box_rows(const CellExtents& cells, const BallBatch& batch, LaneColumns& columns, BatchRows& out) {
  const BoundedBalls& bounded = batch.bounded;
  Boxes boxes(batch);
  const V radius = gathered(bounded.radius, boxes.indices), squared_radius = radius * radius;
  const V z = Neg(gathered(bounded.depth, boxes.indices)), gap_z = squared_gap(cells.z, all_int(batch.slice), z);
  boxes.keep(gap_z <= squared_radius);
  if (!boxes.start(cells.rows, batch.count, out)) return;
  const V y = gathered(bounded.y, boxes.indices);
  const int most = most_columns(boxes);
  prepare_gaps(cells, boxes, batch.slice, most, gathered(bounded.x, boxes.indices), columns);
  const VI last = all_int(cells.rows - 1), before = all_int(batch.slice * cells.y.pitch);
  walk_rows(boxes, cells.rows, out, [&](VI row, MI wanted) {
    const V gap_y = squared_gap(cells.y, Min(row, last) + before, y);
    const VU none = Set(DU(), BatchRows::k_none);
    const MI reaches = And(wanted, RebindMask(DI(), gap_y + gap_z <= squared_radius));
    if (AllFalse(DI(), reaches)) return none;
    const VU found = ends(boxes, most, [&](int column) {  // geom::ball_touches_box, summed in its order
      const V gap_x = LoadU(D(), columns.first.data() + static_cast<std::size_t>(column) * Lanes(D()));
      return gap_x + gap_y + gap_z <= squared_radius;
    });
    return IfThenElse(RebindMask(DU(), reaches), found, none);
  });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(bounds_rows);
HWY_EXPORT(refined_rows);
HWY_EXPORT(box_rows);

RefinementPlanes::RefinementPlanes(const grid::ScreenGrid& grid) : depths(grid.slices.boundaries) {
  const bool orthographic = grid.tiles.orthographic;
  const auto add = [&](const std::vector<float>& boundaries, std::vector<float>& across, std::vector<float>& along,
                       std::vector<float>& offset) {
    for (const TilePlane& plane : tile_planes(boundaries, orthographic)) {
      across.push_back(plane.across);
      along.push_back(plane.along);
      if (orthographic) offset.push_back(plane.offset);
    }
  };
  add(grid.tiles.x, column_across, column_along, column_offset);
  add(grid.tiles.y, row_across, row_along, row_offset);
}

std::size_t RefinementPlanes::capacity_bytes() const {
  return bytes_of(column_across, column_along, row_across, row_along, column_offset, row_offset, depths);
}

CellExtents::CellExtents(const grid::Grid& grid) : columns(grid.cells().x), rows(grid.cells().y) {
  x.pitch = columns;
  y.pitch = rows;
  const auto cells = static_cast<std::uint32_t>(columns * rows);
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
    const std::uint32_t in_slice = cell % cells;
    const geom::Box box = geom::box_around(std::get<geom::FrustumCell>(grid.cell(cell)));
    const auto add = [&](Axis& axis, int i) {
      axis.lo.push_back(box.lo[i]);
      axis.hi.push_back(box.hi[i]);
    };
    if (in_slice < static_cast<std::uint32_t>(columns)) add(x, 0);
    if (in_slice % static_cast<std::uint32_t>(columns) == 0) add(y, 1);
    if (in_slice == 0) add(z, 2);
  }
}

std::size_t CellExtents::capacity_bytes() const {
  return bytes_of(x.lo, x.hi, y.lo, y.hi, z.lo, z.hi);
}

void find_bounds_rows(int rows, const BallBatch& batch, BatchRows& out) {
  HWY_DYNAMIC_DISPATCH(bounds_rows)(rows, batch, out);
}

void find_refined_rows(const RefinementPlanes& planes, const BallBatch& batch, LaneColumns& columns, BatchRows& out) {
  HWY_DYNAMIC_DISPATCH(refined_rows)(planes, batch, columns, out);
}

void find_box_rows(const CellExtents& cells, const BallBatch& batch, LaneColumns& columns, BatchRows& out) {
  HWY_DYNAMIC_DISPATCH(box_rows)(cells, batch, columns, out);
}

}  // namespace clusterbench::assign
#endif
