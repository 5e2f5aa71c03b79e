#include "assign/distance/shell_rows.h"

#include "assign/distance/shells.h"

#define HWY_TARGET_INCLUDE "assign/distance/shell_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target

#include "assign/bounds/bounds_rows-inl.h"
#include "assign/rows/disks-inl.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {
namespace {

// --- The shells that balls reach ---

// More than the error of the reference's caps, sections and slopes: positions by some 20 roundoffs.
constexpr float k_slack_roundoffs = 64.0f;
// Between these limits, squares of a reach are normal numbers; outside of them no ball is left out.
constexpr float k_least_reach = 1e-15f, k_most_reach = 1e18f;

HWY_INLINE V outside(const TilePlane& plane, V coordinate, V depth) {
  return all(plane.across) * coordinate + all(plane.along) * depth;
}

// The distance outside of one of the view's sides.
HWY_INLINE V side_gap(const ShellPlanes& planes, const Balls& balls) {
  const V x = balls.x, y = balls.y, depth = balls.depth;
  const V beside = Max(Neg(outside(planes.left, x, depth)), outside(planes.right, x, depth));
  return Max(beside, Max(outside(planes.top, y, depth), Neg(outside(planes.bottom, y, depth))));
}

// Enlarged balls; of infinite radius if squares may not be normal numbers.
HWY_INLINE V with_slack(const Balls& balls) {
  const V reach = Abs(balls.x) + Abs(balls.y) + Abs(balls.depth) + balls.radius;
  const M is_plain = is_between(all(k_least_reach), reach, all(k_most_reach));
  return IfThenElse(is_plain, balls.radius + all(k_slack_roundoffs * 0x1p-24f) * reach, infinity());
}

// The shells that balls may reach, and all rows.
HWY_INLINE CellRanges cells_of(const ShellPlanes& planes, const Balls& balls) {
  const V length = Sqrt(balls.x * balls.x + balls.y * balls.y + balls.depth * balls.depth), radius = with_slack(balls);
  const std::vector<float>& distances = planes.boundaries.depths;
  const VI none = Zero(DI());
  VI first = none, last = all(-1);
  for (std::size_t shell = 0; shell + 1 < distances.size(); ++shell) {
    first = first - VecFromMask(DI(), RebindMask(DI(), all(distances[shell + 1]) < length - radius));
    last = last - VecFromMask(DI(), RebindMask(DI(), all(distances[shell]) <= length + radius));
  }
  return {{none, none}, {none, all(planes.rows() - 1)}, {first, last}};
}

void shells(const ShellPlanes& planes, const GivenBalls& given, float roundoffs, BoundedBalls& bounded) {
  // A ball around the eye, which the reference may list in all directions of a shell, is outside of no side, because
  // all sides pass through the eye.
  const auto is_in_view = [&](const Balls& balls) { return Not(side_gap(planes, balls) > with_slack(balls)); };
  append_given(given, roundoffs, bounded, is_in_view, [&](const Balls& balls) { return cells_of(planes, balls); });
}

// --- Rows of one shell ---

// Caps: balls around the lights' centres that cover the same directions from the eye.
class Caps {
 public:
  Caps() = default;
  HWY_INLINE Caps(VD x, VD y, VD depth, VD r, double distance0, double distance1) : x_(x), y_(y), depth_(depth) {
    const VD length = Sqrt(x * x + y * y + depth * depth);
    misses_ = Or(length - r > all(distance1), length + r < all(distance0));
    radius_ = radius_in_shell(length, r, distance0, distance1);
    is_endless_ = radius_ == infinite();
    const VD squared = Max(Zero(DD()), x * x + depth * depth - radius_ * radius_);
    const Hull slopes = disks(depth, radius_).slope_range(x);
    const auto tangent = [&](VD slope) {
      const VD touch = Sqrt(squared / (all(1.0) + slope * slope));
      const VD tolerance = all(k_touch_tolerance) * (touch + Abs(y_));
      return Tangent{slope, touch, tolerance, Abs(slope) < infinite()};
    };
    low_ = tangent(slopes.low);
    high_ = tangent(slopes.high);
  }

  // The range of y / depth of the caps that reach the shell.
  HWY_INLINE Hull upright() const {
    const Hull slopes = disks(depth_, radius_).slope_range(y_);
    return {IfThenElse(misses_, infinite(), slopes.low), IfThenElse(misses_, Neg(infinite()), slopes.high)};
  }

  // Starts with the planes y = slope * depth above the first rows.
  HWY_INLINE void start_rows(VD slope) { top_ = cut_at(slope); }
  // The range of x / depth in the rows between the previous planes and these; the next call continues below.
  HWY_INLINE Hull slopes_above(VD slope) {
    const RowCut bottom = cut_at(slope);
    Hull slopes{Min(top_.cut.low, bottom.cut.low), Max(top_.cut.high, bottom.cut.high)};
    for (const Tangent* tangent : {&low_, &high_}) {
      const MD from = y_ >= bottom.slope * tangent->touch - tangent->tolerance;
      const MD to = y_ <= top_.slope * tangent->touch + tangent->tolerance;
      slopes.add(And(tangent->exists, And(from, to)), tangent->slope, Zero(DD()));
    }
    top_.slope = bottom.slope;  // g++ 12 copies a whole struct of vectors through memory
    top_.cut.low = bottom.cut.low;
    top_.cut.high = bottom.cut.high;
    return slopes;
  }

 private:
  struct Tangent {
    VD slope, touch, tolerance;  // touch: a depth
    MD exists;
  };
  // The sections of the caps in planes, as slopes x / depth.
  struct RowCut {
    VD slope;
    Hull cut;
  };

  static HWY_INLINE Disks disks(VD depth, VD radius) {
    return {depth, radius, 0.0, std::numeric_limits<double>::infinity()};
  }

  HWY_INLINE RowCut cut_at(VD slope) const {
    const VD inf = infinite();
    const VD stretch = Sqrt(all(1.0) + slope * slope);
    const VD away = (y_ - slope * depth_) / stretch;
    const VD along = (depth_ + slope * y_) / stretch;
    const VD squared = (radius_ - away) * (radius_ + away);
    const MD is_cut = Not(squared < Zero(DD()));
    const VD chord = in_single(Sqrt(IfThenElseZero(is_cut, squared)));
    const Hull cut = disks(in_single(along), chord).slope_range(x_);
    const auto stretched = [&](VD value, VD if_endless, VD if_missed) {
      return IfThenElse(is_endless_, if_endless, in_single(IfThenElse(is_cut, value * stretch, if_missed)));
    };
    return {slope, {stretched(cut.low, Neg(inf), inf), stretched(cut.high, inf, Neg(inf))}};
  }

  static HWY_INLINE VD radius_in_shell(VD length, VD r, double distance0, double distance1) {
    const VD none = Zero(DD());
    const VD reach = (length - r) * (length + r);
    const VD touch = Sqrt(IfThenElseZero(length > r, reach));
    const VD distance = Min(Max(touch, all(distance0)), all(distance1));
    const VD twice = all(2.0) * distance * length;
    const VD cosine = (distance * distance + reach) / twice;
    const VD apart = Abs(distance - length);
    const VD cap = (r - apart) * (r + apart) / twice;
    const VD squared_sine = cap * (all(1.0) + cosine);
    const VD sine = Sqrt(IfThenElseZero(squared_sine > none, squared_sine));
    const VD lost = all(0x1p-24 * static_cast<double>(k_shell_roundoffs)) * length;
    return IfThenElse(cosine > none, in_single(length * sine + lost), infinite());
  }

  VD x_, y_, depth_, radius_;
  MD misses_, is_endless_;
  Tangent low_, high_;
  RowCut top_;
};

void shell_rows(const ShellPlanes& planes, const BallBatch& batch, BatchRows& out) {
  const auto shell = static_cast<std::size_t>(batch.slice);
  const double distance0 = planes.boundaries.depths[shell], distance1 = planes.boundaries.depths[shell + 1];
  Boxes boxes(batch);
  const auto of_balls = [&](const AlignedVector<float>& list) { return Parts(gathered(list, boxes.indices)); };
  const BoundedBalls& balls = batch.bounded;
  const Parts x = of_balls(balls.x), y = of_balls(balls.y), depth = of_balls(balls.depth), r = of_balls(balls.radius);
  Caps caps[Parts::k_count];
  Parts low, high;
  for (std::size_t part = 0; part < Parts::k_count; ++part) {
    caps[part] = Caps(x.wide(part), y.wide(part), depth.wide(part), r.wide(part), distance0, distance1);
    const Hull upright = caps[part].upright();
    low.set(part, upright.low);
    high.set(part, upright.high);
  }
  boxes.limit_rows(low.whole() <= high.whole(), touched(planes.boundaries.rows, Neg(high.whole()), Neg(low.whole())));
  if (!boxes.start(planes.rows(), batch.count, out)) return;
  const auto slopes_at = [&](VI row) { return Parts(gathered(planes.slope, Min(row, all(planes.rows())))); };
  const Parts top = slopes_at(boxes.first_row);
  for (std::size_t part = 0; part < Parts::k_count; ++part) caps[part].start_rows(top.wide(part));
  walk_rows(boxes, planes.rows(), out, [&](VI row, MI) {
    const Parts bottom = slopes_at(row + all(1));
    for (std::size_t part = 0; part < Parts::k_count; ++part) {
      const Hull slopes = caps[part].slopes_above(bottom.wide(part));
      low.set(part, slopes.low);
      high.set(part, slopes.high);
    }
    const Indices columns = touched(planes.boundaries.columns, low.whole(), high.whole());
    const MI has_slopes = RebindMask(DI(), low.whole() <= high.whole());
    return boxes.entry(AndNot(columns.last < columns.first, has_slopes), columns.first, columns.last);
  });
}

}  // namespace
}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(shells);
HWY_EXPORT(shell_rows);

ShellPlanes::ShellPlanes(const grid::ScreenGrid& grid) : boundaries(grid), slope(grid.tiles.y) {
  left = tile_plane(grid.tiles.x.front(), false);
  right = tile_plane(grid.tiles.x.back(), false);
  top = tile_plane(slope.front(), false);
  bottom = tile_plane(slope.back(), false);
}

std::size_t ShellPlanes::capacity_bytes() const {
  return bytes_of(boundaries.columns.boundaries, boundaries.rows.boundaries, boundaries.depths, slope);
}

void find_shells(const ShellPlanes& planes, const GivenBalls& balls, float roundoffs, BoundedBalls& bounded) {
  HWY_DYNAMIC_DISPATCH(shells)(planes, balls, roundoffs, bounded);
}

void find_shell_rows(const ShellPlanes& planes, const BallBatch& batch, BatchRows& out) {
  HWY_DYNAMIC_DISPATCH(shell_rows)(planes, batch, out);
}

}  // namespace clusterbench::assign
#endif
