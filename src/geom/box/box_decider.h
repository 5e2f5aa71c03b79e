#pragma once
// Does an oriented box share a point with a cell? Touching counts. Always decided: in doubles with a bound of their
// error, which is 0 where nothing is rounded, so that boxes on lattices are decided there, too; what that leaves
// uncertain in rational numbers.
//
// The box's six faces are clipped by the cell's planes (Sutherland and Hodgman 1974). Box and cell share a point if a
// part of a face is left, or if the cell lies within the box, which one of its corners then does. Of a cell between
// shells the faces are clipped by its pyramid's planes: the distances of what is left from the eye are one interval,
// since what box and pyramid share is convex; its far end is at a corner of a clipped face, and its near end the eye
// itself or a clipped face's nearest point. Boxes without volume are their faces.

#include <cstdint>
#include <optional>

#include "geom/numbers/rational.h"
#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {

// How near to and far from the eye what a box and a tile's pyramid share begins and ends, as squared distances, each
// end between bounds.
template <class Bound>
struct SquaredReach {
  bool is_empty = true;
  Bound near_lo{}, near_hi{}, far_lo{}, far_hi{};
};

// A tile as one box reaches into it: nothing where doubles cannot tell.
struct BoxView {
  std::optional<SquaredReach<double>> reach;
  // Found when it is first needed.
  mutable std::optional<SquaredReach<Rational>> exact_reach;
};

// One box for many cells, and one thread.
class BoxDecider {
 public:
  explicit BoxDecider(const BoxVolume& box) : box_(box) {}

  bool meets(const FrustumCell& cell) const { return meets_between_planes(cell); }
  bool meets(const Box& cell) const { return meets_between_planes(cell); }
  bool meets(const ShellCell& cell) const { return meets(cell, view_of(cell)); }
  bool meets(const Cell& cell) const;
  bool holds(const Vec3d& p) const;
  // Of a cell by the first step alone.
  Verdict meets_quickly(const Cell& cell) const;
  // And by the last step alone.
  bool meets_exactly(const Cell& cell) const;

  BoxView view_of(const ShellCell& tile) const;
  // view: that of this cell, or of another one with the same tile.
  bool meets(const ShellCell& cell, const BoxView& view) const;

  // How many cells doubles left uncertain.
  std::uint64_t exact_decisions() const { return exact_decisions_; }

 private:
  template <class AnyCell>
  bool meets_between_planes(const AnyCell& cell) const;

  BoxVolume box_;
  mutable std::uint64_t exact_decisions_ = 0;
};

}  // namespace clusterbench::geom
