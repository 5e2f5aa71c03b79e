#pragma once
// Does a spot (ball ∩ solid cone) share a point with a cell? First the filter (geom/filter/light_filter.h), then what
// its ball and its apex tell, then points of the cell that lie in the cone and planes that touch the cone at most at
// its apex, in doubles with a bound of their error, which is 0 where nothing was rounded: that decides nearly all ties
// of lattices. The rest: geom/spot/proof_by_search.h.

#include <optional>

#include "geom/ball/ball_decider.h"
#include "geom/certificate/spot_106.h"
#include "geom/filter/light_filter.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {

// One spot for many cells, and one thread.
class SpotDecider {
 public:
  explicit SpotDecider(const SpotVolume& light);

  // Proven, or uncertain: by the filter, then by meets_quickly, then by meets_after_all. is_close: known to be touched
  // or missed by a hair, which the filter seldom tells; then by meets_nearly first and the filter second.
  Verdict meets(const Cell& cell, bool is_close = false) const;
  // What half a microsecond tells, mostly.
  Verdict meets_quickly(const Cell& cell) const;
  // The same for cells that are known to be touched or missed by a hair: tells of some more.
  Verdict meets_nearly(const Cell& cell) const;
  // Of a cell that these leave uncertain, without the filter.
  Verdict meets_after_all(const Cell& cell) const;

  const LightFilter& filter() const;

  // How many steps of more than doubles were taken: those of meets_after_all, and of the balls'. A cell can take
  // several, so only whether the count has changed says something of it.
  std::uint64_t exact_decisions() const { return ball_.exact_decisions() + apex_.exact_decisions() + exact_decisions_; }

 private:
  // Is a direction from the apex, whatever it is within its bounds, in the cone?
  Verdict leans(const Point3<Bounded>& way) const;
  // Does a plane with this normal (from the volume to the cell, any length) lie between, `least` being the least that
  // normal·(p - apex) is over the cell? A plane through the apex may touch the cone there, as the cell does not.
  template <class AnyCell>
  bool separates(const AnyCell& cell, const Point3<double>& normal, const Bounded& least) const;
  // Does a direction lean more than 90° from all of the cone's? Its parts along the axis and, squared, across it.
  bool leans_away(const Point3<double>& normal, const Bounded& along, const Bounded& square_across) const;

  const Spot106& spot_106() const;  // without its range
  // Is one of the points, given from the apex, certainly in the volume?
  bool holds_one_of(const std::array<Point3<Bounded>, 8>& ways) const;
  // Is there a plane between? Its corners, and where these are, about, from the apex.
  template <class AnyCell>
  bool is_separated(const AnyCell& cell, const std::array<Point3<Bounded>, 8>& corners,
                    const std::array<Point3<double>, 8>& ways) const;
  template <class AnyCell>
  Verdict by_evidence(const AnyCell& cell) const;
  // Is the plane of a face, at which the volume ends but for roundoffs, certainly between?
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
