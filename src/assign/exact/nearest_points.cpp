#include "assign/exact/nearest_points.h"

#include <algorithm>

#include "geom/numbers/bounded_double.h"

#define HWY_TARGET_INCLUDE "assign/exact/nearest_points.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// geom::Bounded, one per lane. Sums and products of errors are themselves rounded; enlarged() makes up for fewer than a
// hundred such operations, where the errors are used.
struct Bound {
  VD value, error;
};

HWY_INLINE Bound exactly(VD value) {
  return {value, Zero(DD())};
}
HWY_INLINE VD enlarged(VD error) {
  const VD larger = error * all(1.0 + 0x1p-44) + all(0x1p-1000);
  return IfThenZeroElse(error == Zero(DD()), larger);  // NaN stays NaN
}
HWY_INLINE Bound operator+(const Bound& a, const Bound& b) {
  const VD sum = a.value + b.value, from_b = sum - a.value;
  const VD lost = a.value - (sum - from_b) + (b.value - from_b);
  return {sum, a.error + b.error + Abs(lost)};
}
HWY_INLINE Bound operator-(const Bound& a, const Bound& b) {
  return a + Bound{Neg(b.value), b.error};
}
// The rounding error of a product, up to its sign: from a fused multiply and subtract, or else from the products of
// halves of 26 bits (Veltkamp's split), for factors below 2^990.
HWY_INLINE VD lost_by_product(VD a, VD b, VD product) {
#if HWY_NATIVE_FMA
  return MulSub(a, b, product);
#else
  const auto high = [](VD value) {
    const VD big = all(0x1p27 + 1.0) * value;
    return big - (big - value);
  };
  const VD a_high = high(a), b_high = high(b), a_low = a - a_high, b_low = b - b_high;
  return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
#endif
}
// The rounding error of a product is always a double, unless it underflows. The products of errors must not underflow
// to 0 either.
HWY_INLINE Bound operator*(const Bound& a, const Bound& b) {
  const VD zero = Zero(DD());
  const VD product = a.value * b.value, lost = Abs(lost_by_product(a.value, b.value, product));
  const VD size_of_a = Abs(a.value) + a.error, size_of_b = Abs(b.value) + b.error;
  const MD is_nonzero = And(size_of_a > zero, size_of_b > zero);
  const MD is_rough = Or(Abs(product) < all(0x1p-900), a.error + b.error > zero);
  const VD rounding = Max(lost, IfThenElseZero(And(is_nonzero, is_rough), all(0x1p-1000)));
  const VD of_a = a.error * size_of_b, of_b = Abs(a.value) * b.error;
  return {product, of_a + of_b + rounding};
}

// The distance of a centre outside of low <= at <= high, and the slope of the side that makes it change with depth (0:
// none).
struct Gap {
  Bound size;
  VD slope;
  MD is_below, is_outside;
};
HWY_INLINE Gap gap_between(const Bound& low, const Bound& at, const Bound& high, VD slope_low, VD slope_high) {
  const VD zero = Zero(DD());
  const Bound below = low - at, above = at - high;
  const MD is_below = below.value > above.value;
  const VD value = Max(below.value, above.value);
  // If it is certainly beyond one side, it is not beyond the other: only that side's error counts.
  const VD larger = enlarged(Max(below.error, above.error));
  const VD own = enlarged(IfThenElse(is_below, below.error, above.error));
  const VD error = IfThenElse(value >= own, own, larger);
  const MD is_outside = value > zero;
  const VD most = Max(enlarged(value + error), zero);
  const VD inside = IfThenElseZero(error > zero, most);
  const VD slope = IfThenElseZero(is_outside, IfThenElse(is_below, slope_low, Neg(slope_high)));
  return {{Max(value, zero), IfThenElse(is_outside, error, inside)}, slope, is_below, is_outside};
}

// Half the derivative of a gap's square along depth.
HWY_INLINE Bound half_slope(const Gap& gap, VD slope_low, VD slope_high) {
  const Bound product = exactly(gap.slope) * gap.size;
  const VD unsure = (Abs(slope_low) + Abs(slope_high)) * gap.size.error;
  return {product.value, enlarged(product.error + unsure)};
}

HWY_INLINE VD gathered_wide(const std::vector<float>& from, VH indices) {
  return PromoteTo(DD(), GatherIndex(DF(), from.data(), indices));
}

// Writes the result of each lane to touch[0] and following.
HWY_INLINE void store_touches(MD touches, MD misses, Touch* touch) {
  const unsigned yes = bits_of(DD(), touches), no = bits_of(DD(), misses);
  for (std::size_t lane = 0; lane < Lanes(DD()); ++lane)
    touch[lane] = (yes >> lane & 1) != 0 ? Touch::yes : (no >> lane & 1) != 0 ? Touch::no : Touch::uncertain;
}

// Neighbouring cells of a row, tested as one cell: those between two planes of columns.
struct RowRuns {
  VH light, slice, row, column, end_column;
};

// A vector of balls, each with its own run.
class BallRuns {
 public:
  HWY_INLINE BallRuns(const view::LightArrays& lights, const RowPlanes& planes, const RowRuns& runs)
      : orthographic_(planes.orthographic) {
    const VH next = Set(DH(), 1);
    x0_ = gathered_wide(planes.side, runs.column);
    x1_ = gathered_wide(planes.side, runs.end_column);
    y0_ = gathered_wide(planes.slope, runs.row + next);
    y1_ = gathered_wide(planes.slope, runs.row);
    depth0_ = gathered_wide(planes.depth, runs.slice);
    depth1_ = gathered_wide(planes.depth, runs.slice + next);

    constexpr std::size_t k_stride = sizeof(scene::WorldLight) / sizeof(double);
    static_assert(sizeof(scene::WorldLight) % sizeof(double) == 0);
    const auto index = PromoteTo(hn::Rebind<std::int64_t, DD>(), runs.light) *
                       Set(hn::Rebind<std::int64_t, DD>(), std::int64_t{k_stride});
    const auto of_light = [&](const double& first) { return exactly(GatherIndex(DD(), &first, index)); };
    const scene::WorldLight& first = lights.source.front();
    const Bound range = of_light(first.range_m);
    squared_range_ = range * range;
    const view::Space& space = lights.space;
    const Bound from_origin[3] = {of_light(first.position.x) - exactly(all(space.origin.x)),
                                  of_light(first.position.y) - exactly(all(space.origin.y)),
                                  of_light(first.position.z) - exactly(all(space.origin.z))};
    x_ = turned(space.rotation, 0, from_origin);
    y_ = turned(space.rotation, 1, from_origin);
    const Bound z = turned(space.rotation, 2, from_origin);
    depth_ = {Neg(z.value), z.error};
  }

  // The run's nearest point, approximately: the depth at which it was computed, and the values there. As in geom/ball.
  struct Nearest {
    Gap x, y;
    Bound depth, along;  // along: relative to the centre's depth
    Bound excess;        // the squared distance minus the squared radius
  };
  HWY_INLINE Nearest nearest() const {
    const VD at = nearest_depth();
    const MD is_level = is_level_at(at);
    const Bound along_at = exactly(at) - depth_;
    Nearest found;
    found.depth = {at, IfThenElseZero(is_level, depth_.error)};
    found.along = {IfThenZeroElse(is_level, along_at.value), IfThenZeroElse(is_level, along_at.error)};
    found.x = gap_between(plane(x0_, found.depth), x_, plane(x1_, found.depth), x0_, x1_);
    found.y = gap_between(plane(y0_, found.depth), y_, plane(y1_, found.depth), y0_, y1_);
    found.excess =
        found.x.size * found.x.size + found.y.size * found.y.size + found.along * found.along - squared_range_;
    return found;
  }
  // An upper bound of half the derivative of the squared distance along depth, in directions that lead to the run's
  // nearest point. So that point's depth differs by at most this bound, and its squared distance is smaller by at most
  // the square of this bound.
  HWY_INLINE VD steepness(const Nearest& found) const {
    const VD zero = Zero(DD());
    if (orthographic_) return zero;
    const Bound slope = half_slope(found.x, x0_, x1_) + half_slope(found.y, y0_, y1_) + found.along;
    const VD slope_error = enlarged(slope.error);
    const VD falls = IfThenElseZero(found.depth.value < depth1_, slope_error - slope.value);
    const VD rises = IfThenElseZero(found.depth.value > depth0_, slope_error + slope.value);
    return enlarged(Max(zero, Max(falls, rises)));
  }
  // A square that underflows must not become 0.
  static HWY_INLINE VD undershoot(VD steepness) {
    const VD square = Max(enlarged(steepness * steepness), all(0x1p-1000));
    return IfThenElseZero(steepness > Zero(DD()), square);
  }

  const Bound& x() const { return x_; }
  // Along planes of the runs, the length of a step of one metre in depth is less than this.
  VD longest_way() const { return all(1.0) + (Max(Abs(x0_), Abs(x1_)) + Max(Abs(y0_), Abs(y1_))); }

 private:
  // A coordinate of a vector in a space. For cameras that stand straight only one of its terms is not 0.
  static HWY_INLINE Bound turned(const Mat3d& rotation, int row, const Bound (&vector)[3]) {
    Bound sum = exactly(Zero(DD()));
    for (int column = 0; column < 3; ++column)
      if (const double factor = rotation[column][row]; factor != 0.0) sum = sum + exactly(all(factor)) * vector[column];
    return sum;
  }

  HWY_INLINE Bound plane(VD slope, const Bound& depth) const {
    return orthographic_ ? exactly(slope) : exactly(slope) * depth;
  }
  // Is the nearest point certainly at the centre's depth? Then it is computed at that depth, and the vector to it is as
  // exact as the coordinates across. This is the case for all contacts with planes through the eye's own axes.
  HWY_INLINE MD is_level_at(VD at) const {
    const VD zero = Zero(DD()), error = enlarged(depth_.error);
    const MD is_within = And(depth0_ < depth_.value - error, depth_.value + error < depth1_);
    if (orthographic_) return is_within;
    const MD is_upright = And(slope_at(at, x_.value, x0_, x1_) == zero, slope_at(at, y_.value, y0_, y1_) == zero);
    return And(And(is_within, at == depth_.value), is_upright);
  }
  HWY_INLINE VD slope_at(VD at, VD coordinate, VD low, VD high) const {
    return IfThenElse(coordinate < low * at, low, IfThenElseZero(coordinate > high * at, high));
  }
  HWY_INLINE VD clamped(VD depth) const { return Min(Max(depth, depth0_), depth1_); }

  HWY_INLINE VD nearest_depth() const {
    VD at = clamped(depth_.value);
    if (orthographic_) return at;
    constexpr int k_steps = 3;
    for (int i = 0; i < k_steps; ++i) {
      const VD slope_x = slope_at(at, x_.value, x0_, x1_), slope_y = slope_at(at, y_.value, y0_, y1_);
      const VD along = depth_.value + (slope_x * x_.value + slope_y * y_.value);
      const VD square = all(1.0) + (slope_x * slope_x + slope_y * slope_y);
      const VD next = clamped(along / square);
      if (AllTrue(DD(), next == at)) break;
      at = next;
    }
    return at;
  }

  bool orthographic_;
  VD x0_, x1_, y0_, y1_, depth0_, depth1_;
  Bound x_, y_, depth_, squared_range_;
};

void filter_balls(const view::LightArrays& lights, const RowPlanes& planes, BallCells& cells) {
  const std::size_t lanes = Lanes(DD());
  for (std::size_t first = 0; first < cells.count; first += lanes) {
    const auto load = [&](const std::vector<std::int32_t>& from) { return LoadU(DH(), from.data() + first); };
    const VH column = load(cells.column);
    const BallRuns balls(lights, planes,
                         {load(cells.light), load(cells.slice), load(cells.row), column, column + Set(DH(), 1)});
    const BallRuns::Nearest nearest = balls.nearest();
    const VD error = enlarged(nearest.excess.error);
    const MD touches = nearest.excess.value <= Neg(error);
    VD undershoot = Zero(DD());
    if (!AllTrue(DD(), touches)) undershoot = BallRuns::undershoot(balls.steepness(nearest));
    const MD misses = nearest.excess.value - undershoot > error;
    store_touches(touches, misses, cells.touch.data() + first);
  }
}

// The margin of the end of a vector from the apex inside the cone's side. It changes by no more than the vector does.
// The cone is given in single precision: the axis of length 1 to 5 u, all numbers off by u of themselves, u = 2^-24. So
// this is off by less than 20 u of the vector's length.
HWY_INLINE VD cone_margin(const view::LightArrays& lights, VH spot, const PointOf<VD>& way) {
  const auto of = [&](const std::vector<float>& list) { return gathered_wide(list, spot); };
  const PointOf<VD> axis{of(lights.axis_x), of(lights.axis_y), Neg(of(lights.axis_z))};
  const VD along = dot(way, axis);
  return of(lights.sin_angle) * along - of(lights.cos_angle) * length(way - along * axis);
}
constexpr double k_cone_error = 0x1p-19;  // 32 u

// The signed distance from the centre to the other end of a gap.
HWY_INLINE VD across(const Gap& gap) {
  return IfThenElse(gap.is_below, gap.size.value, Neg(gap.size.value));
}

void test_contacts(const view::LightArrays& lights, const RowPlanes& planes, SpotContacts& out) {
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
    // The nearest point is no farther than `shift` from the computed point; common points are no farther than `play`
    // from the nearest point.
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
    const MD is_in_range = And(all(double{planes.least_reach}) <= reach, reach <= all(double{k_most_row_reach}));
    const MD touches = And(is_in_range, And(excess <= Neg(error), is_in_cone));
    const MD misses = And(is_in_range, Or(excess - undershoot > error, is_beside));
    const auto store = [&](VD value, std::vector<double>& list) { StoreU(value, DD(), list.data() + first); };
    const MD is_x_sure = And(nearest.x.is_outside, nearest.x.size.value > all(2.0) * nearest.x.size.error);
    store(balls.x().value, out.x);
    store(enlarged(balls.x().error), out.x_error);
    store(nearest.depth.value, out.depth);
    store(enlarged(nearest.depth.error), out.depth_error);
    store_touches(touches, misses, out.runs.touch.data() + first);
    const MD is_only_point = And(And(touches, is_exact), Or(is_x_sure, Not(nearest.x.is_outside)));
    const unsigned only_point = bits_of(DD(), is_only_point);
    const unsigned outside = bits_of(DD(), nearest.x.is_outside), below = bits_of(DD(), nearest.x.is_below);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto is = [&](unsigned mask) { return (mask >> lane & 1) != 0; };
      out.is_only_point[first + lane] = is(only_point);
      out.side[first + lane] = static_cast<std::int8_t>(!is(outside) ? 0 : is(below) ? -1 : 1);
    }
  }
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(filter_balls);
HWY_EXPORT(test_contacts);

void filter_ball_cells(const view::LightArrays& lights, const RowPlanes& planes, BallCells& cells) {
  if (cells.count == 0) return;
  // A whole vector reads past the end: fill that part with valid indices.
  for (std::vector<std::int32_t>* list : {&cells.light, &cells.slice, &cells.row, &cells.column})
    std::fill_n(list->begin() + cells.count, k_most_lanes, 0);
  HWY_DYNAMIC_DISPATCH(filter_balls)(lights, planes, cells);
}

void SpotContacts::test(const view::LightArrays& lights, const RowPlanes& planes) {
  if (runs.count == 0) return;
  runs.pad();
  for (std::vector<double>* list : {&x, &x_error, &depth, &depth_error}) list->resize(runs.spot.size());
  is_only_point.resize(runs.spot.size());
  side.resize(runs.spot.size());
  HWY_DYNAMIC_DISPATCH(test_contacts)(lights, planes, *this);
}

grid::IndexRange SpotContacts::only_touched_columns(std::uint32_t index, const RowPlanes& planes) const {
  using geom::Bounded;
  const grid::IndexRange none{},
      columns{static_cast<int>(runs.column[index]), static_cast<int>(runs.end_column[index]) - 1};
  const Bounded at_x(x[index], x_error[index]), at_depth(depth[index], depth_error[index]);
  // At the eye all columns meet.
  if (is_only_point[index] == 0 || (!planes.orthographic && !at_depth.is_surely_above(0.0))) return none;
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
  const auto is_zero = [](const Bounded& number) { return number.value == 0.0 && number.error == 0.0; };
  if (is_zero(beyond_left))
    touched.first = std::max(columns.first, middle - 1);
  else if (!beyond_left.is_surely_above(0.0))
    return none;
  if (is_zero(before_right))
    touched.last = std::min(columns.last, middle + 1);
  else if (!before_right.is_surely_above(0.0))
    return none;
  return touched;
}

}  // namespace clusterbench::assign
#endif
