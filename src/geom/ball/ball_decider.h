#pragma once
// Does a ball share a point with a cell? Touching counts. Always decided: in doubles with a bound of their error, which
// is 0 where nothing is rounded, so that it decides most exact touches, too; what that leaves uncertain in pairs of
// doubles with a bound of their error; what even these do by exact numbers (geom/numbers/dyadic.h), in signs of
// polynomials.

#include <cstdint>
#include <optional>

#include "geom/ball/pyramid_view.h"
#include "geom/numbers/bounded_double.h"
#include "geom/numbers/dyadic.h"
#include "geom/numbers/enclosure_106.h"
#include "geom/shapes/cell.h"
#include "geom/shapes/corners.h"
#include "geom/shapes/placement.h"

namespace clusterbench::geom {

// The way from a ball's centre to a cell's nearest point (of the convex set that a shell cell's outer side and its
// pyramid bound, or of the shell). No point that ball and cell share is farther from it than `play`.
struct NearestPoint {
  Point3<Bounded> way;
  double play;
};

// One ball for many cells, and one thread.
class BallDecider {
 public:
  // radius: finite, >= 0.
  BallDecider(const Placement& center, double radius);

  bool meets(const FrustumCell& cell) const;
  bool meets(const Box& cell) const;
  bool meets(const ShellCell& cell) const { return meets(cell, view_of(cell)); }
  bool meets(const Cell& cell) const;

  PyramidView view_of(const ShellCell& cell) const;
  // view: that of this cell, or of another one with the same tile.
  bool meets(const ShellCell& cell, const PyramidView& view) const;

  const Point3<Bounded>& center() const { return center_; }
  // Nothing where doubles tell too little.
  std::optional<NearestPoint> nearest_point(const FrustumCell& cell) const;
  std::optional<NearestPoint> nearest_point(const Box& cell) const;
  std::optional<NearestPoint> nearest_point(const ShellCell& cell) const;

  // Is normal·(p - center) >= 0 for all points p of the cell? Exactly; false also for numbers that are too wide for
  // it.
  bool has_in_front(const Point3<double>& normal, const FrustumCell& cell) const;
  bool has_in_front(const Point3<double>& normal, const Box& cell) const;
  bool has_in_front(const Point3<double>& normal, const ShellCell& cell) const;

  // How many cells doubles left uncertain.
  std::uint64_t exact_decisions() const { return exact_decisions_; }

 private:
  struct In106Bits {
    Enclosure106 x, y, depth, squared_radius;
  };
  struct InDyadics {
    Dyadic x, y, depth, squared_radius;
  };
  const In106Bits& closely() const;
  const InDyadics& in_dyadics() const;
  std::optional<NearestPoint> nearest_ray(const PyramidView& view, const ShellCell& cell) const;
  bool has_corners_in_front(const Point3<double>& normal, const Corners& corners) const;
  // close(ball): the answer in pairs of doubles; exact(ball): in exact numbers, or TooWide.
  template <class AnyCell, class Close, class Exact>
  bool decided(const AnyCell& cell, Close&& close, Exact&& exact) const;

  Placement placement_;
  double radius_;
  Bounded x_, y_, depth_, squared_radius_;
  Point3<Bounded> center_;
  mutable std::optional<In106Bits> in_106_bits_;
  mutable std::optional<InDyadics> in_dyadics_;
  mutable std::uint64_t exact_decisions_ = 0;
};

}  // namespace clusterbench::geom
