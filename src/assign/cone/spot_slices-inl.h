// Stage 1, bounds, once per spot and slice: the proven range of rows, and the candidate points that all its rows share.
// For files that are compiled once per target.

#if defined(CLUSTERBENCH_SPOT_SLICES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_SPOT_SLICES_INL_H
#undef CLUSTERBENCH_SPOT_SLICES_INL_H
#else
#define CLUSTERBENCH_SPOT_SLICES_INL_H
#endif

#include "assign/cone/spot_extremes-inl.h"
#include "assign/cone/spot_rows.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign::HWY_NAMESPACE {

// The outward normal (any length) of a plane that touches spots in a point of their surface. At a point of the rim: the
// plane that contains the direction `edge`, between the tangent planes of the sphere and of the cone's side. At the
// apex, and where both tangent planes contain the edge: `fallback`.
HWY_INLINE Point touching_plane(const SpotShapes& spots, const Point& point, const Point& edge, const Point& fallback) {
  const Cone& cone = spots.cone;
  const Point v = point - cone.apex;
  const V square = dot(v, v), range_square = square_of(cone.range), along = dot(v, cone.axis);
  const Point part = v - along * cone.axis;
  const V across = length(part);
  const Point side = cone.cosine * part - (cone.sine * across) * cone.axis;
  const V off = Max(spots.slack, all(0x1p-12f) * cone.range);  // the largest error of the point
  const M on_sphere = square >= square_of(cone.range - off);
  const V inwards = cone.sine * along - cone.cosine * across;
  const M on_rim = And(on_sphere, inwards <= off);
  const V of_sphere = Abs(dot(side, edge)), of_side = Abs(dot(v, edge)), sum = of_sphere + of_side;
  const M is_held = square_of(sum) < all(0x1p-20f) * (range_square * dot(edge, edge));
  const M at_apex = square < square_of(spots.slack);
  const Point between = of_sphere * v + of_side * side;
  return chosen(Or(at_apex, And(on_rim, is_held)), fallback, chosen(on_rim, between, chosen(on_sphere, v, side)));
}

// The region whose slope x / w is beyond a boundary to one side (1 or -1), between two slice planes and two tile
// planes.
template <bool orthographic>
struct RegionBeyond {
  V boundary, side;
  V up0, up1;
  const SlicePlanes& planes;

  // Does a plane, given by its outward normal of any length, separate the region from the spots? The x of the normal
  // must be 0 or point outward: then the corners at the boundary are the nearest points.
  HWY_INLINE M is_apart(const Cone& cone, const Point& normal, V tolerance) const {
    const auto corner = [&](V up, V depth) {
      const V w = w_of<orthographic>(depth);
      return dot(normal, Point{boundary * w, up * w, depth} - cone.apex);
    };
    const V least = Min(Min(corner(up0, planes.near), corner(up1, planes.near)),
                        Min(corner(up0, planes.far), corner(up1, planes.far)));
    const V size = length(normal);
    const M is_apart = least - extent_of(cone, normal, size) > tolerance * size;
    // For shorter normals the squares of the part across the cone's axis lose digits: at this length already 1 u of the
    // extent.
    const M is_measured = size > all(1e-15f);
    return And(And(is_apart, is_measured), normal.x * side >= Zero(D()));
  }
};

// Rows that spots in slices may touch.
struct RowRange {
  VI first, count;
  MI with_top;  // the extreme point of the first row may be in the picture's top plane
};

// A vector of spots in slices, and the rows that they touch.
template <bool orthographic>
class RowBounds {
 public:
  HWY_INLINE RowBounds(const RowPlanes& planes, const Table& slopes, const SpotShapes& spots,
                       const SlicePlanes& between, V light)
      : planes_(planes),
        slopes_(slopes),
        spots_(exchanged(spots.cone), spots.slack),
        between_(between),
        light_(light) {}

  // `in_range`: the spots whose size single precision can handle.
  HWY_INLINE RowRange rows(M in_range) const {
    Extremes<orthographic> found;
    each_point_in_slice<orthographic>(spots_, between_,
                                      [&](M where, const Projected& p, Side side) { found.add(where, p, side); });
    const V high = found.high.across + spots_.slack / w_of<orthographic>(found.high.depth);
    const V low = found.low.across - spots_.slack / w_of<orthographic>(found.low.depth);
    const Range guess = rows_between(low, high);
    const M exist = found.exist();
    const M none_above = And(And(in_range, exist), is_apart(found.high, slopes_.at(guess.first), all(1.0f)));
    const M none_below = And(And(in_range, exist), is_apart(found.low, slopes_.at(guess.end), all(-1.0f)));
    const VI none = Zero(DI()), rows = all(planes_.rows);
    Range touched = {none, rows};
    if (!AllTrue(D(), Or(And(none_above, none_below), Not(in_range)))) touched = rows_of_extents(in_range);
    // Lane by lane, independent of the other lanes: otherwise counters would differ from machine to machine.
    touched.first = IfThenElse(RebindMask(DI(), none_above), guess.first, touched.first);
    touched.end = IfThenElse(RebindMask(DI(), none_below), guess.end, touched.end);
    const V top = all(planes_.slope.front());
    const VI end = IfThenZeroElse(RebindMask(DI(), And(in_range, misses_slice())), touched.end);
    return {touched.first, Max(end - touched.first, none),
            And(touched.first == none, RebindMask(DI(), Not(high < top)))};
  }

 private:
  using Projected = ProjectedPoint<orthographic>;
  struct Range {
    VI first, end;
  };

  // The rows that contain the slopes from `low` to `high`.
  HWY_INLINE Range rows_between(V low, V high) const {
    const V top = all(planes_.slope.front()), bottom = all(planes_.slope[static_cast<std::size_t>(planes_.rows)]);
    const V scale = all(planes_.rows_per_slope), tolerance = all(planes_.row_tolerance), zero = Zero(D());
    const VI none = Zero(DI()), rows = all(planes_.rows), last_row = rows - all(1);
    const V from = (top - Min(high, top)) * scale - tolerance;
    const V to = (top - Max(low, bottom)) * scale + tolerance;
    const MI is_below = RebindMask(DI(), high < bottom), is_above = RebindMask(DI(), low > top);
    return {IfThenElse(is_below, rows, Min(whole(Floor(Max(from, zero))), last_row)),
            IfThenElse(is_above, none, Min(whole(Floor(Max(to, zero))) + all(1), rows))};
  }

  // Proven rows: for spots in range the rows of their bounding box in the slice, enlarged by twice the tolerance, which
  // also covers the rounding of a quotient; for all others, all rows.
  HWY_INLINE Range rows_of_extents(M in_range) const {
    const V room = all(2.0f) * tolerance(Zero(D())), zero = Zero(D());
    const V up = spots_.cone.apex.x;  // x and y are swapped
    const V high = up + extent_of(spots_.cone, x_axis(), all(1.0f)) + room;
    const V low = up - extent_of(spots_.cone, x_axis(-1.0f), all(1.0f)) - room;
    const V near = w_of<orthographic>(Max(Max(between_.near, nearest() - room), all(1e-30f)));
    const V far = w_of<orthographic>(Max(Min(between_.far, farthest() + room), all(1e-30f)));
    const Range rows = rows_between(low / IfThenElse(low < zero, near, far), high / IfThenElse(high > zero, near, far));
    const MI is_in_range = RebindMask(DI(), in_range);
    return {IfThenElseZero(is_in_range, rows.first), IfThenElse(is_in_range, rows.end, all(planes_.rows))};
  }

  // The least and the greatest depth of the whole spot.
  HWY_INLINE V nearest() const { return spots_.cone.apex.depth - extent_of(spots_.cone, depth_axis(-1.0f), all(1.0f)); }
  HWY_INLINE V farthest() const { return spots_.cone.apex.depth + extent_of(spots_.cone, depth_axis(), all(1.0f)); }

  // With x and y swapped, the extremes up and down become extremes across.
  static HWY_INLINE Cone exchanged(const Cone& cone) {
    const auto turned = [](const Point& p) { return Point{p.y, p.x, p.depth}; };
    return {turned(cone.apex), turned(cone.axis), cone.range, cone.cosine, cone.sine};
  }

  HWY_INLINE M is_apart(const Projected& extreme, V boundary, V side) const {
    const V zero = Zero(D()), along_w = w_along<orthographic>(side * extreme.across);
    Point normal = touching_plane(spots_, extreme.point(), y_axis(), {side, zero, Neg(along_w)});
    normal.y = zero;  // rows have no ends to the left and right
    return RegionBeyond<orthographic>{boundary, side, zero, zero, between_}.is_apart(spots_.cone, normal,
                                                                                     tolerance(Abs(boundary)));
  }

  HWY_INLINE V tolerance(V across) const {
    return tolerance_of<orthographic>(light_, between_.template farthest<orthographic>(), across, Zero(D()));
  }

  HWY_INLINE M misses_slice() const {
    const V tolerance = this->tolerance(Zero(D()));
    return Or(between_.near - farthest() > tolerance, nearest() - between_.far > tolerance);
  }

  const RowPlanes& planes_;
  const Table& slopes_;  // of the tile planes between rows
  SpotShapes spots_;     // x and y swapped
  const SlicePlanes& between_;
  V light_;
};

// Spots in slices, one array per field.
template <bool orthographic>
class Slices {
 public:
  static constexpr std::uint32_t k_most = 64;

  HWY_INLINE Slices(const view::LightArrays& lights, const RowPlanes& planes, const Table& slopes,
                    const SpotSlices& slices, std::uint32_t begin, std::uint32_t end) {
    const float widest = std::max(std::abs(planes.left), std::abs(planes.right));
    const float highest =
        std::max(std::abs(planes.slope.front()), std::abs(planes.slope[static_cast<std::size_t>(planes.rows)]));
    for (std::uint32_t i = begin; i < end; i += lane_count()) {
      const VI spot = loaded_indices(slices.spot, i), slice = loaded_indices(slices.slice, i);
      const GivenSpots given(lights, spot);
      const auto inverse_w = [&](const float* of) { return orthographic ? all(1.0f) : gathered(of, slice); };
      const SlicePlanes between = {gathered(planes.depth, slice), gathered(planes.depth.data() + 1, slice),
                                   inverse_w(planes.inverse_depth.data()), inverse_w(planes.inverse_depth.data() + 1)};
      const V farthest = between.template farthest<orthographic>();
      const SpotShapes shapes(given.cone, tolerance_of<orthographic>(given.light, farthest, all(widest), all(highest)));
      const RowBounds<orthographic> bounds(planes, slopes, shapes, between, given.light);
      const RowRange rows = bounds.rows(fit_single_precision(planes, given.light));
      SpotsInSlices<orthographic> in_slices(shapes, between, given.light);
      const MI wanted = And(rows.count > Zero(DI()), FirstN(DI(), end - i));
      int field = 0;
      const auto put = [&](V value) { store_wanted(value, wanted, values_[field++] + count_); };
      in_slices.each(put);
      // NaN for points that do not exist: neither above nor below anything.
      each_point_in_slice<orthographic>(shapes, between, [&](M where, const Projected& p, Side) {
        put(p.across);
        put(IfThenElse(where, p.up, all(std::numeric_limits<float>::quiet_NaN())));
        put(p.depth);
      });
      store_wanted(spot, wanted, spot_ + count_);
      store_wanted(slice, wanted, slice_ + count_);
      const VI lead = IfThenElseZero(rows.with_top, all(1));
      store_wanted(rows.first - lead, wanted, first_row_ + count_);
      store_wanted(rows.count + lead, wanted, row_count_ + count_);
      count_ += static_cast<std::int32_t>(CountTrue(DI(), wanted));
    }
  }

  // Lists the rows. The first row of a slice may be the one above the picture (-1). Returns the number of rows.
  HWY_INLINE std::int32_t list_rows(SpotRows& out) const {
    const auto n = static_cast<std::int32_t>(Lanes(DI()));
    std::int32_t count = 0;
    for (std::int32_t i = 0; i < count_; ++i) {
      // The next slice overwrites the values written past this one's end.
      for (std::int32_t at = 0; at < row_count_[i]; at += n) {
        StoreU(all(i), DI(), out.listed_slice.data() + count + at);
        StoreU(from_on(first_row_[i] + at), DI(), out.listed_row.data() + count + at);
      }
      count += row_count_[i];
    }
    StoreU(all(std::max(count_ - 1, 0)), DI(), out.listed_slice.data() + count);
    StoreU(Zero(DI()), DI(), out.listed_row.data() + count);
    return count;
  }

  // Looks up values of slices for rows: row lane i belongs to slice first + which[i].
  struct Lookup {
    const Slices& slices;
    std::int32_t first;
    Which which;

    HWY_INLINE V operator()(int field) const { return taken(LoadU(D(), slices.values_[field] + first), which); }
    HWY_INLINE SpotsInSlices<orthographic> spots() const {
      SpotsInSlices<orthographic> spots;
      int field = 0;
      spots.each([&](V& value) { value = (*this)(field++); });
      return spots;
    }
    HWY_INLINE VI spot() const { return taken(LoadU(DI(), slices.spot_ + first), which); }
    HWY_INLINE VI slice() const { return taken(LoadU(DI(), slices.slice_ + first), which); }

    // Of the candidate points, those between two tile planes, up to `room`.
    HWY_INLINE Extremes<orthographic> between(V bottom, V top, V room) const {
      Extremes<orthographic> found;
      const V low = bottom - room, high = top + room;
      int field = k_vectors;
      const auto add_next = [&](Side side) {
        const Projected p = {(*this)(field), (*this)(field + 1), (*this)(field + 2)};
        found.add(is_between(low, p.up, high), p, side);
        field += 3;
      };
      for (int i = 0; i < k_one_sided_points; i += 2) {
        add_next(Side::left);
        add_next(Side::right);
      }
      for (int i = k_one_sided_points; i < k_points_in_slice; ++i) add_next(Side::either);
      return found;
    }
  };

 private:
  using Projected = ProjectedPoint<orthographic>;
  static constexpr int k_vectors = SpotsInSlices<orthographic>::k_vectors;
  static constexpr int k_fields = k_vectors + 3 * k_points_in_slice;
  static constexpr std::size_t k_pitch = k_most + k_most_lanes;

  std::int32_t count_ = 0;
  alignas(64) float values_[k_fields][k_pitch];
  std::int32_t spot_[k_pitch], slice_[k_pitch], first_row_[k_pitch], row_count_[k_pitch];
};

}  // namespace clusterbench::assign::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
