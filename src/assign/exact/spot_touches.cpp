#include "assign/exact/spot_touches.h"

#include <algorithm>

#include "assign/cull/frustum_cull.h"
#include "geom/numbers/bounded_double.h"

#define HWY_TARGET_INCLUDE "assign/exact/spot_touches.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/cone/spot_vectors-inl.h"
#include "assign/exact/ball_runs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// How far inside of the cone's side a way from the apex ends, which changes by no more than the way does. The cone is
// given in single precision: the axis of length 1 to 5 u, all numbers off by u of themselves, u = 2^-24. So this is off
// by less than 20 u of the way's length.
HWY_INLINE VD cone_margin(const view::LightArrays& lights, VH spot, const PointOf<VD>& way) {
  const auto of = [&](const std::vector<float>& list) { return gathered_wide(list, spot); };
  const PointOf<VD> axis{of(lights.axis_x), of(lights.axis_y), Neg(of(lights.axis_z))};
  const VD along = dot(way, axis);
  return of(lights.sin_angle) * along - of(lights.cos_angle) * length(way - along * axis);
}
constexpr double k_cone_error = 0x1p-19;  // 32 u

// From the centre to a gap's other end.
HWY_INLINE VD across(const Gap& gap) {
  return IfThenElse(gap.is_below, gap.size.value, Neg(gap.size.value));
}

void look_at(const view::LightArrays& lights, const RowPlanes& planes, SpotTouches& out) {
  const SpotCells& runs = out.runs;
  const std::size_t lanes = Lanes(DD());
  const VD zero = Zero(DD());
  for (std::size_t first = 0; first < runs.count; first += lanes) {
    const auto load = [&](const std::vector<std::uint32_t>& list) {
      return BitCast(DH(), LoadU(hn::RebindToUnsigned<DH>(), list.data() + first));
    };
    const VH spot = load(runs.spot), light = spot + Set(DH(), static_cast<std::int32_t>(lights.spots.first));
    const BallRuns balls(lights, planes,
                         {light, load(runs.slice), load(runs.row), load(runs.column), load(runs.end_column)});
    const BallRuns::Nearest nearest = balls.nearest();
    const VD error = enlarged(nearest.excess.error), excess = nearest.excess.value;
    const VD steep = balls.steepness(nearest), undershoot = BallRuns::undershoot(steep);
    // The nearest point is no farther from the point that was looked at than `shift`; common points are no farther
    // from it than `play`.
    const VD shift = enlarged(steep * balls.longest_way());
    const VD play_square = enlarged(Max(zero, Neg(excess)) + (error + undershoot));
    const VD play = enlarged(Sqrt(play_square));
    const MD is_exact = And(And(excess == zero, error == zero), steep == zero);

    const PointOf<VD> way{across(nearest.x), across(nearest.y), nearest.along.value};
    const VD off = nearest.x.size.error + nearest.y.size.error + nearest.along.error;
    const VD margin = cone_margin(lights, spot, way);
    const VD tolerance = all(k_cone_error) * length(way) + all(2.0) * off;
    const MD is_in_cone = margin > tolerance;
    const MD is_beside = margin + all(2.0) * (shift + play) < Neg(tolerance);

    const VD reach = gathered_wide(lights.reach, light);
    const MD is_plain = And(all(double{planes.least_reach}) <= reach, reach <= all(double{k_most_row_reach}));
    const MD touches = And(is_plain, And(excess <= Neg(error), is_in_cone));
    const MD misses = And(is_plain, Or(excess - undershoot > error, is_beside));
    const auto store = [&](VD value, std::vector<double>& list) { StoreU(value, DD(), list.data() + first); };
    const MD is_x_sure = And(nearest.x.is_outside, nearest.x.size.value > all(2.0) * nearest.x.size.error);
    store(balls.x().value, out.x);
    store(enlarged(balls.x().error), out.x_error);
    store(nearest.depth.value, out.depth);
    store(enlarged(nearest.depth.error), out.depth_error);
    store_touches(touches, misses, out.runs.touch.data() + first);
    const MD is_alone = And(And(touches, is_exact), Or(is_x_sure, Not(nearest.x.is_outside)));
    const unsigned alone = bits_of(DD(), is_alone);
    const unsigned outside = bits_of(DD(), nearest.x.is_outside), below = bits_of(DD(), nearest.x.is_below);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto is = [&](unsigned mask) { return (mask >> lane & 1) != 0; };
      out.is_alone[first + lane] = is(alone);
      out.side[first + lane] = static_cast<std::int8_t>(!is(outside) ? 0 : is(below) ? -1 : 1);
    }
  }
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(look_at);

void SpotTouches::look(const view::LightArrays& lights, const RowPlanes& planes) {
  if (runs.count == 0) return;
  runs.pad();
  for (std::vector<double>* list : {&x, &x_error, &depth, &depth_error}) list->resize(runs.spot.size());
  is_alone.resize(runs.spot.size());
  side.resize(runs.spot.size());
  HWY_DYNAMIC_DISPATCH(look_at)(lights, planes, *this);
}

grid::IndexRange SpotTouches::only_columns(std::uint32_t index, const RowPlanes& planes) const {
  using geom::Bounded;
  const grid::IndexRange none{},
      columns{static_cast<int>(runs.column[index]), static_cast<int>(runs.end_column[index]) - 1};
  const Bounded at_x(x[index], x_error[index]), at_depth(depth[index], depth_error[index]);
  // At the eye all columns meet.
  if (is_alone[index] == 0 || (!planes.orthographic && !at_depth.is_surely_above(0.0))) return none;
  if (side[index] < 0) return {columns.first, columns.first};
  if (side[index] > 0) return {columns.last, columns.last};
  const auto plane = [&](int column) {
    const Bounded given(double{planes.side[static_cast<std::size_t>(column)]});
    return planes.orthographic ? given : given * at_depth;
  };
  const auto begin = planes.side.begin();
  const double slope = planes.orthographic ? at_x.value : at_x.value / at_depth.value;
  const auto above = std::upper_bound(begin + columns.first, begin + columns.last + 2, slope,
                                      [](double value, float side_of) { return value < double{side_of}; });
  const int column = static_cast<int>(above - begin) - 1;
  if (column < columns.first || column > columns.last + 1) return none;
  const int middle = std::min(column, columns.last);
  grid::IndexRange touched{middle, middle};
  const Bounded beyond_left = at_x - plane(middle), before_right = plane(middle + 1) - at_x;
  const auto is_nothing = [](const Bounded& number) { return number.value == 0.0 && number.error == 0.0; };
  if (is_nothing(beyond_left))
    touched.first = std::max(columns.first, middle - 1);
  else if (!beyond_left.is_surely_above(0.0))
    return none;
  if (is_nothing(before_right))
    touched.last = std::min(columns.last, middle + 1);
  else if (!before_right.is_surely_above(0.0))
    return none;
  return touched;
}

}  // namespace clusterbench::assign
#endif
