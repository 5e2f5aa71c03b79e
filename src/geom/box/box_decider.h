#pragma once
// Does an oriented box share a point with a cell? Touching counts. Always decided: in doubles with error bounds, which
// are 0 where nothing is rounded, so this decides boxes on lattices, too; pairs that stay uncertain are decided in
// rational numbers.
//
// The box's six faces are clipped by the cell's planes (Sutherland and Hodgman 1974). Box and cell share a point if a
// part of a face remains, or if the cell lies within the box; then one of the cell's corners does. For a cell between
// shells the faces are clipped by its pyramid's planes. The distances from the eye over box ∩ pyramid are one interval,
// because that set is convex. Its far end is at a corner of a clipped face, its near end is the eye itself or a clipped
// face's nearest point. Boxes without volume consist of their faces.

#include <cstdint>
#include <optional>

#include "geom/numbers/rational.h"
#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {

// The squared distances from the eye at which box ∩ pyramid begins and ends, each between bounds.
template <class Bound>
struct SquaredReach {
  bool is_empty = true;
  Bound near_lo{}, near_hi{}, far_lo{}, far_hi{};
};

// The part of a box in a tile; empty if doubles are not precise enough.
struct BoxView {
  std::optional<SquaredReach<double>> reach;
  // Computed when it is first needed.
  mutable std::optional<SquaredReach<Rational>> exact_reach;
};

// One box against many cells, for one thread.
class BoxDecider {
 public:
  explicit BoxDecider(const BoxVolume& box) : box_(box) {}

  bool meets(const FrustumCell& cell) const { return meets_between_planes(cell); }
  bool meets(const Box& cell) const { return meets_between_planes(cell); }
  bool meets(const ShellCell& cell) const { return meets(cell, view_of(cell)); }
  bool meets(const Cell& cell) const;
  bool holds(const Vec3d& p) const;
  // The result of the first step alone.
  Verdict meets_quickly(const Cell& cell) const;
  // The result of the last step alone.
  bool meets_exactly(const Cell& cell) const;

  BoxView view_of(const ShellCell& tile) const;
  // view: of this cell, or of another cell with the same tile.
  bool meets(const ShellCell& cell, const BoxView& view) const;

  // The number of cells that doubles left uncertain.
  std::uint64_t exact_decisions() const { return exact_decisions_; }

 private:
  template <class AnyCell>
  bool meets_between_planes(const AnyCell& cell) const;

  BoxVolume box_;
  mutable std::uint64_t exact_decisions_ = 0;
};

}  // namespace clusterbench::geom
