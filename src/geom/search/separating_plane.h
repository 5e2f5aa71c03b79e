#pragma once
// A plane between a light's volume and a cell bounded by planes, in any number type. The tested normals are the
// possible directions of the shortest vector between two convex sets. The width of the gap is measured from the cell's
// corners and the volume's extent alone. So a wrong candidate can only miss a plane, and never gives a wrong answer.

#include <algorithm>
#include <array>
#include <optional>

#include "geom/numbers/point3.h"
#include "geom/numbers/precision.h"
#include "geom/search/common_point.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/polytope.h"

namespace clusterbench::geom {

// normal·(p - apex) <= extent for all p of the volume, >= extent + gap for all p of the cell. Unit normal. A negative
// gap means: not separated.
template <class Real>
struct Separation {
  Point3<Real> normal;
  Real gap;
};

// Calls visit(start, end) for the twelve edges.
template <class Real, class Visit>
void each_edge(const std::array<Point3<Real>, 8>& corners, Visit&& visit) {
  for (unsigned corner = 0; corner < 8; ++corner)
    for (const unsigned bit : {1u, 2u, 4u})
      if ((corner & bit) == 0) visit(corners[corner], corners[corner | bit]);
}

// The widest gap over the normals tried so far.
template <class Real>
class Separator {
 public:
  Separator(const Volume<Real>& volume, const Polytope<Real>& cell) : volume_(volume) {
    for (std::size_t i = 0; i < 8; ++i) corners_[i] = cell.corners[i] - volume.apex;
  }

  const Separation<Real>& best() const { return best_; }

  // A direction of any length, from the volume to the cell.
  void try_normal(const Point3<Real>& direction) {
    const Real size = length(direction);
    if (size > Real(0)) try_unit((Real(1) / size) * direction);
  }

  // Planes along the cone's side, where the cell's least margin to them is largest: towards a corner, or equally far
  // from both ends of an edge. (Equally far from three corners: a face's normal.)
  void try_tangents() {
    for (const Point3<Real>& corner : corners_) try_tangent(unit_across(volume_.axis, corner));
    each_edge(corners_, [&](const Point3<Real>& start, const Point3<Real>& end) { try_between(start, end); });
  }

  // The tangents that most often have the widest gap: towards the corner that is lowest over the plane towards the
  // cell's middle, and equally far from this corner and the one that is lowest over the plane towards it.
  void try_likely_tangents() {
    Point3<Real> sum = corners_[0];
    for (std::size_t i = 1; i < 8; ++i) sum = sum + corners_[i];
    const Point3<Real>& first = lowest_over(tangent(unit_across(volume_.axis, sum)));
    const Point3<Real> towards_first = tangent(unit_across(volume_.axis, first));
    try_unit(towards_first);
    const Point3<Real>& second = lowest_over(towards_first);
    if (&first != &second) try_between(first, second);
  }

  // `nearest`: the point of cell ∩ infinite cone nearest to the apex, on the cone's side and beyond the range. A plane
  // through it can separate the volume if its normal leans outwards from the generator there. An edge through the point
  // determines the angle.
  void try_leaning(const Point3<Real>& nearest) {
    const Point3<Real> along = nearest - volume_.apex;
    const Real size = length(along);
    if (!(size > Real(0))) return;
    const Point3<Real> generator = (Real(1) / size) * along;
    const Point3<Real> outward = tangent(unit_across(volume_.axis, generator));
    try_normal(generator);
    each_edge(corners_, [&](const Point3<Real>& start, const Point3<Real>& end) {
      const Real lean = dot(outward, end - start), rise = -dot(generator, end - start);
      if (lean == Real(0) || (lean > Real(0)) != (rise > Real(0))) return;
      try_normal(generator + (rise / lean) * outward);
    });
  }

 private:
  // The outward normal of the plane along the cone's side in a unit direction across the axis.
  Point3<Real> tangent(const Point3<Real>& across) const {
    return volume_.cos_angle * across - volume_.sin_angle * volume_.axis;
  }
  void try_tangent(const Point3<Real>& across) { try_unit(tangent(across)); }

  // The tangents that are equally far from two points.
  void try_between(const Point3<Real>& start, const Point3<Real>& end) {
    const Point3<Real> step = end - start, m = unit_across(volume_.axis, start), m2 = cross(volume_.axis, m);
    // x cos phi + y sin phi = z, phi around the axis from m.
    const Real x = volume_.cos_angle * dot(step, m), y = volume_.cos_angle * dot(step, m2);
    const Real z = volume_.sin_angle * dot(step, volume_.axis), square = x * x + y * y;
    if (!(square > Real(0)) || square < z * z) return;
    const Real root = SquareRoot<Real>::of(square - z * z);
    for (const Real& w : {root, -root}) try_tangent(((z * x - w * y) / square) * m + ((z * y + w * x) / square) * m2);
  }

  const Point3<Real>& lowest_over(const Point3<Real>& normal) const {
    return *std::min_element(corners_.begin(), corners_.end(), [&](const Point3<Real>& a, const Point3<Real>& b) {
      return dot(normal, a) < dot(normal, b);
    });
  }

  void try_unit(const Point3<Real>& normal) {
    Real least = dot(normal, corners_[0]);
    for (std::size_t i = 1; i < 8 && least > best_.gap; ++i) least = std::min(least, dot(normal, corners_[i]));
    if (!(least > best_.gap)) return;  // the volume's extent from its apex is at least 0
    const Real gap = least - volume_.extent(normal);
    if (gap > best_.gap) best_ = {normal, gap};
  }

  const Volume<Real>& volume_;
  std::array<Point3<Real>, 8> corners_;
  Separation<Real> best_{{Real(0), Real(0), Real(0)}, Real(0)};
};

// The cell's point nearest to p: the foot on a face, or the nearest of an edge.
template <class Real>
Point3<Real> nearest_in(const Polytope<Real>& cell, const Point3<Real>& p, const Real& tolerance) {
  Point3<Real> best = cell.corners[0];
  Real least = dot(best - p, best - p);
  const auto visit = [&](const Point3<Real>& q) {
    const Real square = dot(q - p, q - p);
    if (!(square < least)) return;
    least = square;
    best = q;
  };
  each_edge(cell.corners, [&](const Point3<Real>& start, const Point3<Real>& end) {
    const Point3<Real> step = end - start;
    const Real square = dot(step, step);
    if (!(square > Real(0))) return;
    const Real t = dot(p - start, step) / square;
    visit(t < Real(0) ? start : t > Real(1) ? end : start + t * step);
  });
  for (const HalfSpace<Real>& face : cell.faces) {
    const Real height = face.margin(p);
    if (!(height < Real(0)) || !(height * height < least)) continue;
    const Point3<Real> foot = p + height * face.normal;
    const bool is_in = std::all_of(cell.faces.begin(), cell.faces.end(),
                                   [&](const HalfSpace<Real>& other) { return !(other.margin(foot) < -tolerance); });
    if (is_in) visit(foot);
  }
  return best;
}

// The point of cell ∩ infinite cone that is nearest to the apex, if the cone meets the cell. With `on_faces`, only
// candidates inside and on these faces.
template <class Real>
std::optional<Point3<Real>> nearest_in_cone(const Setting<Real>& setting, const std::array<bool, 6>& on_faces = {
                                                                              true, true, true, true, true, true}) {
  Volume<Real> endless = setting.volume;
  Real farthest(0);
  for (const Point3<Real>& corner : setting.cell.corners) farthest = std::max(farthest, length(corner - endless.apex));
  endless.range = Real(2) * farthest + endless.range;
  std::optional<Point3<Real>> nearest;
  polytope_candidates(endless, setting.cell, on_faces, [&](const Point3<Real>& p) {
    if (!is_within(endless, setting.cell.faces, p, setting.tolerance)) return;
    if (!nearest || length(p - endless.apex) < length(*nearest - endless.apex)) nearest = p;
  });
  return nearest;
}

// A plane with a gap above the tolerance, or else the one with the widest gap found.
template <class Real>
Separation<Real> find_separation(const Setting<Real>& setting) {
  const Volume<Real>& volume = setting.volume;
  Separator<Real> separator(volume, setting.cell);
  const auto is_found = [&] { return separator.best().gap > setting.tolerance; };
  separator.try_normal(nearest_in(setting.cell, volume.apex, setting.tolerance) - volume.apex);
  if (!volume.is_cone || is_found()) return separator.best();
  separator.try_likely_tangents();
  if (is_found()) return separator.best();
  separator.try_tangents();
  if (is_found()) return separator.best();
  const std::optional<Point3<Real>> nearest = nearest_in_cone(setting);
  if (nearest) separator.try_leaning(*nearest);
  if (is_found()) return separator.best();
  for (const HalfSpace<Real>& face : setting.cell.faces) separator.try_normal(Real(-1) * face.normal);
  return separator.best();
}

}  // namespace clusterbench::geom
