#pragma once
// Does a spot (ball ∩ solid cone) share a point with a cell? The steps: the filter (geom/filter/light_filter.h); the
// results of its ball and its apex; then points of the cell that lie in the cone, and planes that touch the cone at
// most at its apex, in doubles with error bounds, which are 0 where nothing was rounded: this decides nearly all exact
// contacts on lattices. All other pairs: geom/spot/proof_by_search.h.

#include <optional>

#include "geom/ball/ball_decider.h"
#include "geom/certificate/spot_106.h"
#include "geom/filter/light_filter.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {

// One spot against many cells, for one thread.
class SpotDecider {
 public:
  explicit SpotDecider(const SpotVolume& light);

  // Proven, or uncertain: by the filter, then by meets_quickly, then by meets_by_proof. is_close: the caller knows that
  // contact or gap is tiny, which the filter can rarely decide; then meets_when_close comes first and the filter
  // second.
  Verdict meets(const Cell& cell, bool is_close = false) const;
  // The result of the cheap steps, which mostly take half a microsecond.
  Verdict meets_quickly(const Cell& cell) const;
  // The same with one more step, for cells whose contact or gap is known to be tiny.
  Verdict meets_when_close(const Cell& cell) const;
  // For a cell that these leave uncertain, without the filter.
  Verdict meets_by_proof(const Cell& cell) const;

  const LightFilter& filter() const;

  // The number of steps beyond doubles: those of meets_by_proof, and of the balls. A cell can need several, so only a
  // change of this number is meaningful.
  std::uint64_t exact_decisions() const { return ball_.exact_decisions() + apex_.exact_decisions() + exact_decisions_; }

 private:
  // Is a direction from the apex certainly in the cone, for all values within its bounds?
  Verdict leans(const Point3<Bounded>& way) const;
  // Is a plane with this normal (from the volume to the cell, any length) certainly between the two? `least` is the
  // least value of normal·(p - apex) over the cell. A plane through the apex may touch the cone there, because the cell
  // does not contain the apex.
  template <class AnyCell>
  bool separates(const AnyCell& cell, const Point3<double>& normal, const Bounded& least) const;
  // Is the angle between a direction and all directions of the cone more than 90°? Its parts along the axis and,
  // squared, across it.
  bool leans_away(const Point3<double>& normal, const Bounded& along, const Bounded& square_across) const;

  const Spot106& spot_106() const;  // without its range
  // Is one of the points, given relative to the apex, certainly in the volume?
  bool holds_one_of(const std::array<Point3<Bounded>, 8>& ways) const;
  // Is there a plane between? Takes the cell's corners, and their approximate positions relative to the apex.
  template <class AnyCell>
  bool is_separated(const AnyCell& cell, const std::array<Point3<Bounded>, 8>& corners,
                    const std::array<Point3<double>, 8>& ways) const;
  template <class AnyCell>
  Verdict by_evidence(const AnyCell& cell) const;
  // Is the plane of a face, at which the volume ends up to roundoffs, certainly between?
  bool ends_at_face(const ShellCell& cell) const;
  template <class PlaneCell>
  bool ends_at_face(const PlaneCell& cell) const;

  SpotVolume light_;
  BallDecider ball_, apex_;  // of the range (if it is finite), and of radius 0
  Point3<Bounded> axis_;     // any length
  Bounded axis_square_, cosine_, sine_;
  mutable std::optional<LightFilter> filter_;
  mutable std::optional<Spot106> spot_106_;
  mutable std::uint64_t exact_decisions_ = 0;
};

}  // namespace clusterbench::geom
