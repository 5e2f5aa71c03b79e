// Where what spots have in rows leans most, in single precision and without proof. For files that are compiled once per
// target; included after hwy/highway.h; defines its names anew for each target.

#if defined(CLUSTERBENCH_SPOT_GUESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_SPOT_GUESS_INL_H
#undef CLUSTERBENCH_SPOT_GUESS_INL_H
#else
#define CLUSTERBENCH_SPOT_GUESS_INL_H
#endif

#include "assign/simd/spot_cells-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {

HWY_INLINE V square_of(V x) {
  return hn::Mul(x, x);
}
HWY_INLINE V inverse(V x) {
  return hn::Div(all(1.0f), x);
}

// The two places found so far that lean most.
struct Extremes {
  Point low, high;

  HWY_INLINE Extremes() : low{all(k_none), all(0.0f), all(1.0f)}, high{all(-k_none), all(0.0f), all(1.0f)} {}

  HWY_INLINE void take_low(M where, const Point& p) {
    low = chosen(hn::And(where, hn::Lt(hn::Mul(p.x, low.depth), hn::Mul(low.x, p.depth))), p, low);
  }
  HWY_INLINE void take_high(M where, const Point& p) {
    high = chosen(hn::And(where, hn::Gt(hn::Mul(p.x, high.depth), hn::Mul(high.x, p.depth))), p, high);
  }
  HWY_INLINE void take(M where, const Point& p) {
    take_low(where, p);
    take_high(where, p);
  }
  HWY_INLINE void take(M where, const Extremes& others) {
    take_low(where, others.low);
    take_high(where, others.high);
  }
  HWY_INLINE M exist() const { return hn::Lt(low.x, all(k_none)); }

  // One lane on.
  HWY_INLINE Extremes carried(const Carried& carry, Extremes& turned) const {
    const auto one_on = [&](const Point& p, Point& before) {
      return Point{carry(p.x, before.x), carry(p.y, before.y), carry(p.depth, before.depth)};
    };
    Extremes next;
    next.low = one_on(low, turned.low);
    next.high = one_on(high, turned.high);
    return next;
  }

 private:
  static constexpr float k_none = 1e15f;
};

// Where what spots have in their rows leans most: of all places where it can (spot_rows.h), those that are in spot and
// row, by and large. The row's faces are y = slope * depth and depths.
class Guess {
 public:
  // `left`, `right`: sides of the columns that may be touched.
  HWY_INLINE Guess(const SpotsInRows& rows, V left, V right)
      : cone_(rows.cone),
        y0_(rows.y0),
        y1_(rows.y1),
        depth0_(rows.depth0),
        depth1_(rows.depth1),
        slack_(rows.tolerance(left, right)) {
    longest_square_ = square_of(hn::Add(cone_.range, slack_));
    range_square_ = hn::Mul(cone_.range, cone_.range);
    cosine_square_ = square_of(cone_.cosine);
    const Point toward = Point{all(0.3f), all(0.5f), all(0.8f)}, aside = Point{all(0.8f), all(-0.5f), all(0.1f)};
    const V along = dot(toward, cone_.axis);
    const M is_good = hn::Lt(hn::Abs(along), all(0.9f));
    const Point from = chosen(is_good, toward, aside);
    const Point part = from - dot(from, cone_.axis) * cone_.axis;
    m1_ = inverse(length(part)) * part;
    m2_ = cross(cone_.axis, m1_);
    rim_ = cone_.apex + hn::Mul(cone_.range, cone_.cosine) * cone_.axis;
    rim1_ = hn::Mul(cone_.range, cone_.sine) * m1_;
    rim2_ = hn::Mul(cone_.range, cone_.sine) * m2_;
  }

  // In one of the row's two tile planes.
  HWY_INLINE Extremes in_tile_plane(V slope) const {
    Extremes found;
    take_tangents_in_tile_plane(slope, found);
    take_generators_in_tile_plane(slope, found);
    for (const V depth : {depth0_, depth1_}) {
      const V up = hn::Sub(hn::Mul(slope, depth), cone_.apex.y), ahead = hn::Sub(depth, cone_.apex.depth);
      take_side_on_edge(up, ahead, found);
      const V square = hn::Sub(range_square_, hn::Add(square_of(up), square_of(ahead)));
      take_sphere_at(hn::Ge(square, hn::Zero(D())), root(square), up, ahead, found);
    }
    return found;
  }

  // Between them.
  HWY_INLINE Extremes between_tile_planes() const {
    Extremes found;
    const Point& a = cone_.apex;
    found.take(hn::And(is_between_slices(a.depth), is_between_tiles(a.y, a.depth)), a);
    take_free(found);
    take_generators_in_slice_planes(found);
    for (const V depth : {depth0_, depth1_}) take_in_slice_plane(depth, found);
    return found;
  }

 private:
  HWY_INLINE M is_between_slices(V depth) const {
    return is_between(hn::Sub(depth0_, slack_), depth, hn::Add(depth1_, slack_));
  }
  HWY_INLINE M is_between_tiles(V y, V depth) const {
    return is_between(hn::Sub(hn::Mul(y0_, depth), slack_), y, hn::Add(hn::Mul(y1_, depth), slack_));
  }
  // A place so far along the axis from the apex, and so far from the apex, squared.
  HWY_INLINE M is_in_cone(V along, V square) const {
    const V side = hn::Add(hn::Mul(cone_.sine, along), slack_), across = hn::Sub(square, square_of(along));
    return hn::And(hn::Ge(side, hn::Zero(D())), hn::Ge(square_of(side), hn::Mul(cosine_square_, across)));
  }
  HWY_INLINE M is_sphere_in_cone(const Point& p) const {
    return is_in_cone(dot(p - cone_.apex, cone_.axis), range_square_);
  }

  // Angles phi with a cos phi + b sin phi = c, as places of the rim.
  template <class Take>
  HWY_INLINE void each_rim_place(V a, V b, V c, Take&& take) const {
    const V square = hn::Add(square_of(a), square_of(b)), rest = hn::Sub(square, square_of(c));
    const M exists = hn::And(hn::Ge(rest, hn::Zero(D())), hn::Gt(square, hn::Zero(D())));
    const V w = root(rest), scale = inverse(square);
    for (const V sign : {all(1.0f), all(-1.0f)}) {
      const V turned = hn::Mul(sign, w);
      const V cosine = hn::Mul(scale, hn::Sub(hn::Mul(a, c), hn::Mul(b, turned)));
      const V sine = hn::Mul(scale, hn::Add(hn::Mul(b, c), hn::Mul(a, turned)));
      take(exists, rim_ + cosine * rim1_ + sine * rim2_);
    }
  }

  // The tangents from the eye to a circle around (across, ahead) with this radius, squared, as (across, ahead).
  template <class TakeLow, class TakeHigh>
  HWY_INLINE static void both_tangents(V across, V ahead, V rho_square, TakeLow&& take_low, TakeHigh&& take_high) {
    const V square = hn::Add(square_of(across), square_of(ahead)), tangent_square = hn::Sub(square, rho_square);
    const M exists = hn::And(hn::Ge(rho_square, hn::Zero(D())), hn::Gt(tangent_square, hn::Zero(D())));
    const V scale = inverse(square), turn = hn::Mul(scale, root(hn::Mul(rho_square, tangent_square)));
    const V shrink = hn::Mul(scale, tangent_square);
    const V middle = hn::Mul(shrink, across), aside = hn::Mul(turn, ahead);
    const V middle_ahead = hn::Mul(shrink, ahead), farther = hn::Mul(turn, across);
    take_low(exists, hn::Sub(middle, aside), hn::Add(middle_ahead, farther));
    take_high(exists, hn::Add(middle, aside), hn::Sub(middle_ahead, farther));
  }

  // Where sphere and rim lean most.
  HWY_INLINE void take_free(Extremes& found) const {
    const Point& a = cone_.apex;
    const auto is_in = [&](const Point& p) {
      return hn::And(hn::And(is_between_slices(p.depth), is_between_tiles(p.y, p.depth)), is_sphere_in_cone(p));
    };
    both_tangents(
        a.x, a.depth, range_square_,
        [&](M exists, V x, V depth) {
          const Point p = {x, a.y, depth};
          found.take_low(hn::And(exists, is_in(p)), p);
        },
        [&](M exists, V x, V depth) {
          const Point p = {x, a.y, depth};
          found.take_high(hn::And(exists, is_in(p)), p);
        });
    const auto wedge = [](V a1, V b1, V a2, V b2) { return hn::Sub(hn::Mul(a1, b2), hn::Mul(a2, b1)); };
    each_rim_place(wedge(rim2_.x, rim2_.depth, rim_.x, rim_.depth), wedge(rim_.x, rim_.depth, rim1_.x, rim1_.depth),
                   wedge(rim1_.x, rim1_.depth, rim2_.x, rim2_.depth), [&](M exists, const Point& p) {
                     const M is_in_row = hn::And(is_between_slices(p.depth), is_between_tiles(p.y, p.depth));
                     found.take(hn::And(exists, is_in_row), p);
                   });
  }

  // Where sphere and rim lean most in a tile plane.
  HWY_INLINE void take_tangents_in_tile_plane(V slope, Extremes& found) const {
    const Point& a = cone_.apex;
    const V shrink = inverse(hn::Add(all(1.0f), square_of(slope)));  // of squares
    const V away = hn::Sub(a.y, hn::Mul(slope, a.depth));
    const V ahead = hn::Mul(shrink, hn::Add(hn::Mul(slope, a.y), a.depth));  // in depth
    const V tilt = hn::Sqrt(hn::Add(all(1.0f), square_of(slope)));
    const V rho_square = hn::Sub(range_square_, hn::Mul(shrink, square_of(away)));
    const auto place = [&](V x, V along) {
      const V depth = hn::Mul(along, hn::Mul(tilt, shrink));
      return Point{x, hn::Mul(slope, depth), depth};
    };
    const auto is_in = [&](const Point& p) { return hn::And(is_between_slices(p.depth), is_sphere_in_cone(p)); };
    both_tangents(
        a.x, hn::Mul(tilt, ahead), rho_square,
        [&](M exists, V x, V along) {
          const Point p = place(x, along);
          found.take_low(hn::And(exists, is_in(p)), p);
        },
        [&](M exists, V x, V along) {
          const Point p = place(x, along);
          found.take_high(hn::And(exists, is_in(p)), p);
        });
    const auto part = [&](const Point& p) { return hn::Sub(p.y, hn::Mul(slope, p.depth)); };
    each_rim_place(part(rim1_), part(rim2_), hn::Neg(part(rim_)),
                   [&](M exists, const Point& p) { found.take(hn::And(exists, is_between_slices(p.depth)), p); });
  }

  HWY_INLINE void take_in_slice_plane(V depth, Extremes& found) const {
    const Point& a = cone_.apex;
    const V ahead = hn::Sub(depth, a.depth), square = hn::Sub(range_square_, square_of(ahead));
    take_sphere_at(hn::And(hn::Ge(square, hn::Zero(D())), is_between_tiles(a.y, depth)), root(square), hn::Zero(D()),
                   ahead, found);
    each_rim_place(rim1_.depth, rim2_.depth, hn::Sub(depth, rim_.depth),
                   [&](M on_rim, const Point& p) { found.take(hn::And(on_rim, is_between_tiles(p.y, p.depth)), p); });
  }

  // The generators in which planes through the apex that hold a direction touch the cone.
  template <class Take>
  HWY_INLINE void each_generator(const Point& direction, Take&& take) const {
    const V along = dot(direction, cone_.axis), a = dot(direction, m1_), b = dot(direction, m2_);
    const V square = hn::Add(square_of(a), square_of(b));
    const V c = hn::Mul(hn::Div(cone_.sine, hn::Max(cone_.cosine, all(1e-6f))), along);
    const V rest = hn::Sub(square, square_of(c));
    const M exists = hn::And(hn::Ge(rest, hn::Zero(D())), hn::Gt(square, hn::Zero(D())));
    const V w = root(rest), scale = hn::Mul(cone_.sine, inverse(square));
    for (const V sign : {all(1.0f), all(-1.0f)}) {
      const V turned = hn::Mul(sign, w);
      const V to1 = hn::Mul(scale, hn::Sub(hn::Mul(a, c), hn::Mul(b, turned)));
      const V to2 = hn::Mul(scale, hn::Add(hn::Mul(b, c), hn::Mul(a, turned)));
      take(exists, cone_.cosine * cone_.axis + to1 * m1_ + to2 * m2_);
    }
  }

  HWY_INLINE M is_on_generator(V t) const { return is_between(hn::Zero(D()), t, hn::Add(cone_.range, slack_)); }

  // Where the cone's side leans most in a tile plane: tangent planes through the eye.
  HWY_INLINE void take_generators_in_tile_plane(V slope, Extremes& found) const {
    const Point& a = cone_.apex;
    each_generator(a, [&](M exists, const Point& g) {
      const V t = hn::Div(hn::Sub(hn::Mul(slope, a.depth), a.y), hn::Sub(g.y, hn::Mul(slope, g.depth)));
      const Point p = a + t * g;
      found.take(hn::And(exists, hn::And(is_on_generator(t), is_between_slices(p.depth))), p);
    });
  }
  // The same in slice planes: upright ones.
  HWY_INLINE void take_generators_in_slice_planes(Extremes& found) const {
    const Point& a = cone_.apex;
    each_generator({hn::Zero(D()), all(1.0f), hn::Zero(D())}, [&](M exists, const Point& g) {
      const V scale = inverse(g.depth);
      for (const V depth : {depth0_, depth1_}) {
        const V t = hn::Mul(hn::Sub(depth, a.depth), scale);
        const Point p = a + t * g;
        found.take(hn::And(exists, hn::And(is_on_generator(t), is_between_tiles(p.y, p.depth))), p);
      }
    });
  }

  // Places of the sphere as far to the right and to the left of the apex.
  HWY_INLINE void take_sphere_at(M where, V half, V up, V ahead, Extremes& found) const {
    const V k = hn::Add(hn::Mul(up, cone_.axis.y), hn::Mul(ahead, cone_.axis.depth)),
            lean = hn::Mul(half, cone_.axis.x);
    const auto is_in = [&](V along) { return hn::And(where, is_in_cone(along, range_square_)); };
    found.take_low(is_in(hn::Sub(k, lean)), cone_.apex + Point{hn::Neg(half), up, ahead});
    found.take_high(is_in(hn::Add(k, lean)), cone_.apex + Point{half, up, ahead});
  }

  // along² = cosine² (x² + rest), along = x axis.x + k.
  HWY_INLINE void take_side_on_edge(V up, V ahead, Extremes& found) const {
    const V rest = hn::Add(square_of(up), square_of(ahead));
    const V k = hn::Add(hn::Mul(up, cone_.axis.y), hn::Mul(ahead, cone_.axis.depth));
    const V qa = hn::Sub(square_of(cone_.axis.x), cosine_square_), qb = hn::Mul(k, cone_.axis.x);
    const V qc = hn::Sub(square_of(k), hn::Mul(cosine_square_, rest));
    const V inside = hn::Sub(square_of(qb), hn::Mul(qa, qc));
    const M exist = hn::Ge(inside, hn::Zero(D()));
    const V q = hn::Neg(hn::Add(qb, hn::CopySign(root(inside), qb)));
    for (const V x : {hn::Div(q, qa), hn::Div(qc, q)}) {
      const M is_in = hn::And(hn::Ge(hn::Add(hn::Mul(x, cone_.axis.x), k), hn::Neg(slack_)),
                              hn::Le(hn::Add(square_of(x), rest), longest_square_));
      found.take(hn::And(exist, is_in), cone_.apex + Point{x, up, ahead});
    }
  }

  Cone cone_;
  V y0_, y1_, depth0_, depth1_, slack_, longest_square_, range_square_, cosine_square_;
  Point m1_, m2_;            // across the axis
  Point rim_, rim1_, rim2_;  // its middle, and from there to two of its places
};

// What is guessed of rows, vector by vector. Rows of a spot in a slice follow each other from the top, and share the
// tile planes between them.
class Guesses {
 public:
  HWY_INLINE Guesses() : spot_(all_int(-1)), slice_(spot_), row_(spot_) {}

  // `left`, `right`: sides of the columns that may be touched.
  HWY_INLINE Extremes next(const SpotsInRows& rows, VI spot, VI slice, VI row, V left, V right) {
    const Guess guess(rows, left, right);
    const Extremes below = guess.in_tile_plane(rows.y0);
    const Extremes above = below.carried(carry_, below_);
    const MI is_next = hn::And(hn::And(hn::Eq(carry_(spot, spot_), spot), hn::Eq(carry_(slice, slice_), slice)),
                               hn::Eq(carry_(row, row_), hn::Sub(row, all_int(1))));
    Extremes found = guess.between_tile_planes();
    found.take(hn::FirstN(D(), hn::Lanes(D())), below);
    found.take(hn::RebindMask(D(), is_next), above);
    // Above the first row of a spot there is nothing of it, but for the picture's end.
    const M is_top = hn::RebindMask(D(), hn::Eq(row, hn::Zero(DI())));
    if (!hn::AllFalse(D(), is_top)) found.take(is_top, guess.in_tile_plane(rows.y1));
    return found;
  }

 private:
  Carried carry_;
  // Of the rows before, one lane on.
  Extremes below_;
  VI spot_, slice_, row_;
};

}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#endif
