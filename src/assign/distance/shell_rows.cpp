#include "assign/distance/shell_rows.h"

#include <cmath>

#include "assign/distance/shells.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/distance/shell_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/bounds/bounds_rows-inl.h"
#include "assign/rows/disks-inl.h"
#include "assign/simd/boundaries-inl.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

// --- Which shells ---

// More than what the reference's caps, cuts and slopes lose: positions by some 20 roundoffs.
constexpr float k_slack_roundoffs = 64.0f;
// Within these squares of a reach are normal numbers; elsewhere nothing is left out.
constexpr float k_least_reach = 1e-15f, k_most_reach = 1e18f;

HWY_INLINE V outside(const TilePlane& plane, V coordinate, V depth) {
  return all(plane.across) * coordinate + all(plane.along) * depth;
}

// How far outside of one of the view's sides.
HWY_INLINE V side_gap(const ShellPlanes& planes, const Balls& balls) {
  const V x = balls.x, y = balls.y, depth = balls.depth;
  const V beside = Max(Neg(outside(planes.left, x, depth)), outside(planes.right, x, depth));
  return Max(beside, Max(outside(planes.top, y, depth), Neg(outside(planes.bottom, y, depth))));
}

// Larger balls; of infinite radius where squares may not be normal numbers.
HWY_INLINE V with_slack(const Balls& balls) {
  const V reach = Abs(balls.x) + Abs(balls.y) + Abs(balls.depth) + balls.radius;
  const M is_plain = is_between(all(k_least_reach), reach, all(k_most_reach));
  return IfThenElse(is_plain, balls.radius + all(k_slack_roundoffs * 0x1p-24f) * reach, infinity());
}

// The shells that balls may reach, and all rows.
HWY_INLINE CellRanges cells_of(const ShellPlanes& planes, const Balls& balls) {
  const V length = Sqrt(balls.x * balls.x + balls.y * balls.y + balls.depth * balls.depth), radius = with_slack(balls);
  const std::vector<float>& shells = planes.boundaries.depths;
  const VI none = Zero(DI());
  return {{none, none},
          {none, all_int(planes.rows() - 1)},
          {first_touched(shells, none, length - radius), last_touched(shells, none, length + radius)}};
}

void shells(const ShellPlanes& planes, const GivenBalls& given, float roundoffs, BoundedBalls& bounded) {
  // A ball that holds the eye, which the reference may list in all directions of a shell, is outside of no side: they
  // all pass through the eye.
  const auto is_in_view = [&](const Balls& balls) { return side_gap(planes, balls) <= with_slack(balls); };
  append_given(given, roundoffs, bounded, is_in_view, [&](const Balls& balls) { return cells_of(planes, balls); });
}

// --- Rows of one shell ---

// As many balls as there are doubles in a vector.
constexpr std::size_t k_half = MaxLanes(DD()), k_halves = MaxLanes(D()) / k_half;

struct Cut {
  VF low, high;
};

// Caps: balls around the lights' centres that look the same from the eye.
class Caps {
 public:
  Caps() = default;
  HWY_INLINE Caps(VD x, VD y, VD depth, VD length, VD r, double distance0, double distance1)
      : x_(x), y_(y), depth_(depth), radius_(radius_in_shell(length, r, distance0, distance1)) {
    const VD none = Zero(DD());
    is_endless_ = radius_ == infinite();
    const VD squared = x * x + depth * depth - radius_ * radius_;
    const Disks disks(depth, radius_, 0.0, std::numeric_limits<double>::infinity());
    VF low, high;
    disks.slope_range(x, low, high);
    const auto tangent = [&](VF slope) {
      const VD s = PromoteTo(DD(), slope);
      const VD touch = Sqrt(Max(none, squared) / (all(1.0) + s * s));
      const VD tolerance = all(k_touch_tolerance) * (touch + Abs(y_));
      return Tangent{s, touch, tolerance, Abs(s) < infinite()};
    };
    low_ = tangent(low);
    high_ = tangent(high);
    disks.slope_range(y, upright_.low, upright_.high);
  }

  const Cut& upright() const { return upright_; }

  // What the planes y = slope * depth cut out of the caps, as slopes x / depth.
  HWY_INLINE Cut cut_by_planes(VD slope, VD stretch) const {
    const VD inf = infinite();
    const VD away = (y_ - slope * depth_) / stretch;
    const VD along = (depth_ + slope * y_) / stretch;
    const VD squared = (radius_ - away) * (radius_ + away);
    const MD is_cut = Not(squared < Zero(DD()));
    const VD chord = in_single(Sqrt(IfThenElseZero(is_cut, squared)));
    Cut cut;
    Disks(in_single(along), chord, 0.0, std::numeric_limits<double>::infinity()).slope_range(x_, cut.low, cut.high);
    const auto stretched = [&](VF value, VD if_endless, VD if_missed) {
      const VD of_cut = IfThenElse(is_cut, PromoteTo(DD(), value) * stretch, if_missed);
      return DemoteTo(DF(), IfThenElse(is_endless_, if_endless, of_cut));
    };
    return {stretched(cut.low, Neg(inf), inf), stretched(cut.high, inf, Neg(inf))};
  }

  // The caps' slopes x / depth in rows between two planes.
  HWY_INLINE Cut slopes_in_rows(const Cut& top, const Cut& bottom, VD top_slope, VD bottom_slope) const {
    VD low = infinite(), high = Neg(infinite());
    for (const Tangent* tangent : {&low_, &high_}) {
      const MD from = y_ >= bottom_slope * tangent->touch - tangent->tolerance;
      const MD to = y_ <= top_slope * tangent->touch + tangent->tolerance;
      const MD touches = And(tangent->exists, And(from, to));
      low = Min(low, IfThenElse(touches, tangent->slope, infinite()));
      high = Max(high, IfThenElse(touches, tangent->slope, Neg(infinite())));
    }
    return {Min(Min(top.low, bottom.low), DemoteTo(DF(), low)), Max(Max(top.high, bottom.high), DemoteTo(DF(), high))};
  }

 private:
  struct Tangent {
    VD slope, touch, tolerance;  // touch: depth
    MD exists;
  };

  static HWY_INLINE VD in_single(VD value) { return PromoteTo(DD(), DemoteTo(DF(), value)); }

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
  MD is_endless_;
  Tangent low_, high_;
  Cut upright_;
};

// A batch in one shell.
class Shell {
 public:
  HWY_INLINE Shell(const ShellPlanes& planes, const BallBatch& batch, VI indices) : planes_(planes) {
    const auto shell = static_cast<std::size_t>(batch.slice);
    const double distance0 = planes.boundaries.depths[shell], distance1 = planes.boundaries.depths[shell + 1];
    const Lanes x(gathered(batch.bounded.x, indices)), y(gathered(batch.bounded.y, indices));
    const Lanes depth(gathered(batch.bounded.depth, indices)), radius(gathered(batch.bounded.radius, indices));
    Lanes low, high;
    for (std::size_t half = 0; half < k_halves; ++half) {
      const VD wide_x = x.wide(half), wide_y = y.wide(half), wide_depth = depth.wide(half), r = radius.wide(half);
      const VD squares = wide_x * wide_x + wide_y * wide_y + wide_depth * wide_depth;
      const VD length = Sqrt(squares);
      halves_[half] = Caps(wide_x, wide_y, wide_depth, length, r, distance0, distance1);
      const MD misses = Or(length - r > all(distance1), length + r < all(distance0));
      low.set(half, halves_[half].upright().low);
      high.set(half, halves_[half].upright().high);
      missed_.set(half, DemoteTo(DF(), IfThenElseZero(misses, all(1.0))));
    }
    low_ = low.whole();
    high_ = high.whole();
  }

  // Of the balls that reach the shell, the rows that they may touch.
  HWY_INLINE void find_rows(Boxes& boxes) const {
    const Indices rows = touched(planes_.boundaries.rows, Neg(high_), Neg(low_));
    const M reaches = And(missed_.whole() == Zero(D()), low_ <= high_);
    const MI wanted = And(RebindMask(DI(), reaches), boxes.rows > Zero(DI()));
    boxes.first_row = rows.first;
    const VI count = rows.last - (rows.first - all_int(1));
    boxes.rows = IfThenElseZero(wanted, Max(count, Zero(DI())));
  }

  // The cuts by the planes above rows are kept for the call with the rows below them.
  HWY_INLINE void start_rows(VI row) { cut(row, above_); }
  // The columns of the rows above these planes.
  HWY_INLINE VU columns_above(VI plane, const Boxes& boxes) {
    Plane below[k_halves];
    cut(plane, below);
    Lanes low, high;
    for (std::size_t half = 0; half < k_halves; ++half) {
      const Cut slopes =
          halves_[half].slopes_in_rows(above_[half].cut, below[half].cut, above_[half].slope, below[half].slope);
      low.set(half, slopes.low);
      high.set(half, slopes.high);
      above_[half] = below[half];
    }
    const Indices columns = touched(planes_.boundaries.columns, low.whole(), high.whole());
    const M has_slopes = low.whole() <= high.whole();
    const MI has_columns = AndNot(columns.last < columns.first, RebindMask(DI(), has_slopes));
    return IfThenElse(RebindMask(DU(), has_columns), boxes.entry(columns.first, columns.last),
                      Set(DU(), BatchRows::k_none));
  }

 private:
  // Single precision in halves that are as wide as doubles.
  class Lanes {
   public:
    Lanes() = default;
    HWY_INLINE explicit Lanes(V value) { Store(value, D(), lanes_); }
    HWY_INLINE VD wide(std::size_t half) const { return PromoteTo(DD(), LoadU(DF(), lanes_ + half * k_half)); }
    HWY_INLINE void set(std::size_t half, VF value) { StoreU(value, DF(), lanes_ + half * k_half); }
    HWY_INLINE V whole() const { return Load(D(), lanes_); }

   private:
    HWY_ALIGN float lanes_[MaxLanes(D())];
  };

  struct Plane {
    VD slope;
    Cut cut;
  };

  HWY_INLINE void cut(VI plane, Plane (&planes)[k_halves]) const {
    const hn::RebindToSigned<DF> dh;
    const hn::RebindToSigned<DD> dl;
    HWY_ALIGN std::int32_t indices[MaxLanes(D())];
    Store(Min(plane, all_int(planes_.rows())), DI(), indices);
    for (std::size_t half = 0; half < k_halves; ++half) {
      const auto index = LoadU(dh, indices + half * k_half);
      planes[half].slope = PromoteTo(DD(), GatherIndex(DF(), planes_.slope.data(), index));
      const VD stretch = GatherIndex(DD(), planes_.stretch.data(), PromoteTo(dl, index));
      planes[half].cut = halves_[half].cut_by_planes(planes[half].slope, stretch);
    }
  }

  const ShellPlanes& planes_;
  Caps halves_[k_halves];
  Plane above_[k_halves];
  Lanes missed_;
  V low_, high_;  // slopes y / depth
};

void shell_rows(const ShellPlanes& planes, const BallBatch& batch, BatchRows& out) {
  Boxes boxes(batch);
  Shell shell(planes, batch, boxes.indices);
  shell.find_rows(boxes);
  if (!boxes.start(planes.rows(), batch.count, out)) return;
  shell.start_rows(boxes.first_row);
  walk_rows(boxes, planes.rows(), out, [&](VI row, MI) { return shell.columns_above(row + all_int(1), boxes); });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(shells);
HWY_EXPORT(shell_rows);

ShellPlanes::ShellPlanes(const grid::ScreenGrid& grid) : boundaries(grid), slope(grid.tiles.y) {
  for (const float each : slope)
    stretch.push_back(std::sqrt(1.0 + static_cast<double>(each) * static_cast<double>(each)));
  left = tile_plane(grid.tiles.x.front(), false);
  right = tile_plane(grid.tiles.x.back(), false);
  top = tile_plane(slope.front(), false);
  bottom = tile_plane(slope.back(), false);
}

std::size_t ShellPlanes::capacity_bytes() const {
  return bytes_of(boundaries.columns.boundaries, boundaries.rows.boundaries, boundaries.depths, slope, stretch);
}

void find_shells(const ShellPlanes& planes, const GivenBalls& balls, float roundoffs, BoundedBalls& bounded) {
  HWY_DYNAMIC_DISPATCH(shells)(planes, balls, roundoffs, bounded);
}

void find_shell_rows(const ShellPlanes& planes, const BallBatch& batch, BatchRows& out) {
  HWY_DYNAMIC_DISPATCH(shell_rows)(planes, batch, out);
}

}  // namespace clusterbench::assign
#endif
