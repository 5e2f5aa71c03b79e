#pragma once
// Does a ball share a point with a cell? Touching counts. Always decided, in three steps: in doubles with error bounds
// (a bound is 0 where nothing is rounded, so this decides most exact contacts, too); then in pairs of doubles with
// error bounds; then in exact numbers (geom/numbers/dyadic.h), by signs of polynomials.

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

// The vector from a ball's centre to a cell's nearest point (for a shell cell: of the convex set between its outer side
// and its pyramid, or of the shell). All points that ball and cell share are within `play` of that point.
struct NearestPoint {
  Point3<Bounded> way;
  double play;
};

// One ball against many cells, for one thread.
class BallDecider {
 public:
  // radius: finite, >= 0.
  BallDecider(const Placement& center, double radius);

  bool meets(const FrustumCell& cell) const;
  bool meets(const Box& cell) const;
  bool meets(const ShellCell& cell) const { return meets(cell, view_of(cell)); }
  bool meets(const Cell& cell) const;

  PyramidView view_of(const ShellCell& cell) const;
  // view: of this cell, or of another cell with the same tile.
  bool meets(const ShellCell& cell, const PyramidView& view) const;

  const Point3<Bounded>& center() const { return center_; }
  // Empty if doubles are not precise enough.
  std::optional<NearestPoint> nearest_point(const FrustumCell& cell) const;
  std::optional<NearestPoint> nearest_point(const Box& cell) const;
  std::optional<NearestPoint> nearest_point(const ShellCell& cell) const;

  // Is normal·(p - center) >= 0 for all points p of the cell? Exact; also false if the numbers are too wide for exact
  // arithmetic.
  bool has_in_front(const Point3<double>& normal, const FrustumCell& cell) const;
  bool has_in_front(const Point3<double>& normal, const Box& cell) const;
  bool has_in_front(const Point3<double>& normal, const ShellCell& cell) const;

  // The number of cells that doubles left uncertain.
  std::uint64_t exact_decisions() const { return exact_decisions_; }

 private:
  struct In106Bits {
    Enclosure106 x, y, depth, squared_radius;
  };
  struct InDyadics {
    Dyadic x, y, depth, squared_radius;
  };
  const In106Bits& in_106_bits() const;
  const InDyadics& in_dyadics() const;
  std::optional<NearestPoint> nearest_ray(const PyramidView& view, const ShellCell& cell) const;
  bool has_corners_in_front(const Point3<double>& normal, const Corners& corners) const;
  // close(ball): the result in pairs of doubles; exact(ball): in exact numbers, or TooWide.
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
