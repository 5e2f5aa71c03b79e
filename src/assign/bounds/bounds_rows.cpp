#include "assign/bounds/bounds_rows.h"

#include <limits>

#define HWY_TARGET_INCLUDE "assign/bounds/bounds_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/bounds/bounds_rows-inl.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// Walks each lane through its rows for which reaches(row) is true. The columns of a row go from the first to the last
// for which touches(column) is true; they are counted from the box's first column, in lockstep.
template <class Reaches, class Touches>
HWY_INLINE void walk_columns(const Boxes& boxes, int grid_rows, BatchRows& out, Reaches&& reaches, Touches&& touches) {
  const VI beyond = all(std::numeric_limits<std::int32_t>::max());
  const int most = boxes.most_columns();
  walk_rows(boxes, grid_rows, out, [&](VI row, MI wanted) {
    const MI is_reached = And(wanted, RebindMask(DI(), reaches(row)));
    const int count = AllFalse(DI(), is_reached) ? 0 : most;
    VI first = beyond, last = Zero(DI());
    for (int column = 0; column < count; ++column) {
      const VI index = all(column);
      const MI is_touched = And(RebindMask(DI(), touches(column)), boxes.columns > index);
      first = Min(first, IfThenElse(is_touched, index, beyond));
      last = IfThenElse(is_touched, index, last);
    }
    return boxes.entry(And(is_reached, first < beyond), first, last);
  });
}

// Calls prepare(column, at) for each column of the lanes' boxes; `at` is the place for the lanes' values of that
// column.
template <class Prepare>
HWY_INLINE void each_column(const Boxes& boxes, int count, int grid_columns, Prepare&& prepare) {
  const VI last = all(grid_columns - 1);
  for (int i = 0; i < count; ++i)
    prepare(Min(boxes.first_column + all(i), last), static_cast<std::size_t>(i) * Lanes(D()));
}

// Row by row, without scattering: all entries of a ball are equal.
void bounds_rows(int grid_rows, const BallBatch& batch, BatchRows& out) {
  const Boxes boxes(batch);
  if (!boxes.start(grid_rows, batch.count, out)) return;
  const VU entry = boxes.entry(boxes.rows > Zero(DI()), Zero(DI()), boxes.columns - all(1));
  const VI end = boxes.first_row + boxes.rows;
  for (int row = out.first_row; row <= out.last_row; ++row) {
    const MI holds = AndNot(all(row) < boxes.first_row, all(row) < end);
    StoreU(IfThenElse(RebindMask(DU(), holds), entry, all(BatchRows::k_none)), DU(),
           out.columns.data() + static_cast<std::size_t>(row) * out.lanes);
  }
}

// --- Sphere refinement ---

struct Remainder {
  V depth, squared_radius;

  HWY_INLINE M is_some() const { return Not(squared_radius < Zero(D())); }
};

HWY_INLINE Remainder cut_to_slice(V depth, V radius, float depth0, float depth1) {
  const V nearer = Min(Max(depth, all(depth0)), all(depth1));
  const V gap = nearer - depth;
  return {nearer, radius * radius - gap * gap};
}

// A row's plane, and the signed distance of a ball's centre above it.
struct RowPlane {
  V along, distance;
};

HWY_INLINE Remainder cut_to_row(const Remainder& ball, const RowPlane& top, const RowPlane& bottom) {
  const M is_above = top.distance > Zero(D());
  const V gap = Max(IfThenElse(is_above, top.distance, Neg(bottom.distance)), Zero(D()));
  const V along = IfThenElse(is_above, top.along, Neg(bottom.along));
  return {ball.depth - gap * along, ball.squared_radius - gap * gap};
}

struct Planes {
  V across, along, offset;
};

HWY_INLINE Planes gathered_planes(const std::vector<TilePlane>& planes, VI index) {
  static_assert(sizeof(TilePlane) == 3 * sizeof(float));
  const VI at = index + index + index;
  const TilePlane& first = planes.front();
  // In perspective all planes go through the eye.
  const V offset = first.offset == 0.0f && planes.back().offset == 0.0f ? Zero(D()) : gathered(&first.offset, at);
  return {gathered(&first.across, at), gathered(&first.along, at), offset};
}

void refined_rows(const RefinementPlanes& planes, const BallBatch& batch, LaneColumns& columns, BatchRows& out) {
  const BoundedBalls& bounded = batch.bounded;
  const auto column_planes = static_cast<int>(planes.columns.size()), row_planes = static_cast<int>(planes.rows.size());
  const auto z = static_cast<std::size_t>(batch.slice);
  Boxes boxes(batch);
  const Remainder ball = cut_to_slice(gathered(bounded.depth, boxes.indices), gathered(bounded.radius, boxes.indices),
                                      planes.depths[z], planes.depths[z + 1]);
  boxes.keep(ball.is_some());
  if (!boxes.start(row_planes - 1, batch.count, out)) return;

  // The part of a plane's distance that comes from the centre's x, which no cut changes, and the factor for its depth.
  columns.reserve(planes.columns.size() * k_row_lanes);
  float *const of_x = columns.first.data(), *const of_depth = columns.second.data();
  const V x = gathered(bounded.x, boxes.indices), y = gathered(bounded.y, boxes.indices);
  each_column(boxes, boxes.most_columns() + 1, column_planes, [&](VI column, std::size_t at) {
    const Planes plane = gathered_planes(planes.columns, column);
    StoreU(plane.across * x + plane.offset, D(), of_x + at);
    StoreU(plane.along, D(), of_depth + at);
  });
  const auto row_plane = [&](VI index) {
    const Planes plane = gathered_planes(planes.rows, Min(index, all(row_planes - 1)));
    return RowPlane{plane.along, plane.across * y + plane.along * ball.depth + plane.offset};
  };
  RowPlane top = row_plane(boxes.first_row);
  Remainder in_row;
  const auto distance = [&](int plane) {
    const std::size_t at = static_cast<std::size_t>(plane) * Lanes(D());
    return LoadU(D(), of_x + at) + LoadU(D(), of_depth + at) * in_row.depth;
  };
  V left;
  const auto reaches = [&](VI row) {
    const RowPlane bottom = row_plane(row + all(1));
    in_row = cut_to_row(ball, top, bottom);
    top.along = bottom.along;  // g++ 12 copies a whole struct of vectors through memory
    top.distance = bottom.distance;
    left = distance(0);
    return in_row.is_some();
  };
  walk_columns(boxes, row_planes - 1, out, reaches, [&](int column) {
    const V right = distance(column + 1), gap = Max(Neg(left), right);
    left = right;
    return Or(gap <= Zero(D()), gap * gap <= in_row.squared_radius);
  });
}

// --- Boxes around cells ---

HWY_INLINE V squared_gap(const CellExtents::Axis& axis, VI index, V center) {
  const VI at = index + index;
  const V outside = gap(gathered(&axis.extents.front().lo, at), center, gathered(&axis.extents.front().hi, at));
  return outside * outside;
}

// A sum of squares is rounded to at least each square and grows with each: if one gap is out of reach, so is the sum
// with any other gap. So the columns that a row's boxes reach are one interval, because the boxes' ends ascend.
void box_rows(const CellExtents& cells, const BallBatch& batch, LaneColumns& columns, BatchRows& out) {
  const BoundedBalls& bounded = batch.bounded;
  Boxes boxes(batch);
  const V radius = gathered(bounded.radius, boxes.indices), squared_radius = radius * radius;
  const V z = Neg(gathered(bounded.depth, boxes.indices)), gap_z = squared_gap(cells.z, all(batch.slice), z);
  boxes.keep(gap_z <= squared_radius);
  if (!boxes.start(cells.rows, batch.count, out)) return;

  columns.reserve(static_cast<std::size_t>(cells.columns) * k_row_lanes);
  float* const gaps_x = columns.first.data();
  const V x = gathered(bounded.x, boxes.indices), y = gathered(bounded.y, boxes.indices);
  const VI first_x = all(batch.slice * cells.x.pitch), first_y = all(batch.slice * cells.y.pitch);
  each_column(boxes, boxes.most_columns(), cells.columns,
              [&](VI column, std::size_t at) { StoreU(squared_gap(cells.x, first_x + column, x), D(), gaps_x + at); });
  const VI last_row = all(cells.rows - 1);
  V gap_y;
  const auto reaches = [&](VI row) {
    gap_y = squared_gap(cells.y, first_y + Min(row, last_row), y);
    return gap_y + gap_z <= squared_radius;
  };
  walk_columns(boxes, cells.rows, out, reaches, [&](int column) {  // geom::ball_touches_box, summed in its order
    const V gap_x = LoadU(D(), gaps_x + static_cast<std::size_t>(column) * Lanes(D()));
    return gap_x + gap_y + gap_z <= squared_radius;
  });
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(bounds_rows);
HWY_EXPORT(refined_rows);
HWY_EXPORT(box_rows);

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
