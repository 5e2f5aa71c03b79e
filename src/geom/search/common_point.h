#pragma once
// Search for a point that a light's volume and a cell share, in any number type. It may miss an existing point. A found
// point counts only if its margin is large enough or a certificate (geom/certificate) proves it.

#include <algorithm>
#include <array>
#include <limits>

#include "geom/numbers/double_double.h"
#include "geom/numbers/point3.h"
#include "geom/numbers/precision.h"
#include "geom/search/extreme_candidates.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/polytope.h"

namespace clusterbench::geom {

// How far a point is inside of the cell's faces and of the conditions of the volume that every point has to satisfy.
template <class Real, std::size_t N>
Real margin_of(const Volume<Real>& volume, const std::array<HalfSpace<Real>, N>& faces, const Point3<Real>& p) {
  Real margin = faces[0].margin(p);
  for (std::size_t i = 1; i < N; ++i) margin = std::min(margin, faces[i].margin(p));
  if (volume.is_cone) margin = std::min(margin, volume.side_margin(p));
  return margin;
}

// A running mean of points.
template <class Real>
struct Mean {
  Point3<Real> sum{Real(0), Real(0), Real(0)};
  int count = 0;

  void add(const Point3<Real>& p) {
    sum = sum + p;
    ++count;
  }
  Point3<Real> at() const { return (Real(1) / Real(count)) * sum; }
};

// A point of cell ∩ volume, and how far it is inside all of their surfaces.
template <class Real>
struct Witness {
  Point3<Real> at;
  Real margin;
};

template <class Real, std::size_t N>
Witness<Real> witness_at(const Volume<Real>& volume, const std::array<HalfSpace<Real>, N>& faces,
                         const Point3<Real>& p) {
  return {p, std::min(margin_of(volume, faces, p), volume.range - length(p - volume.apex))};
}

// Sum of the inward normals of the surfaces on which p lies.
template <class Real, std::size_t N>
Point3<Real> inward_of(const Volume<Real>& volume, const std::array<HalfSpace<Real>, N>& faces, const Point3<Real>& p,
                       const Real& tolerance) {
  Point3<Real> inward{Real(0), Real(0), Real(0)};
  for (const HalfSpace<Real>& face : faces)
    if (face.margin(p) <= tolerance) inward = inward - face.normal;
  if (volume.is_cone && volume.side_margin(p) <= tolerance)
    inward = inward + volume.sin_angle * volume.axis - volume.cos_angle * unit_across(volume.axis, p - volume.apex);
  const Real distance = length(p - volume.apex);
  if (distance > Real(0) && volume.range - distance <= tolerance)
    inward = inward + (Real(1) / distance) * (volume.apex - p);
  return inward;
}

// The mean of points of a convex set lies in it. If all points lie on the same surfaces, so does their mean: then the
// search continues inward from there. The distance inside is a concave function of the step. Of the steps range / 2^k
// the best one is found by bisection over k.
template <class Real, std::size_t N>
Witness<Real> find_witness(const Volume<Real>& volume, const std::array<HalfSpace<Real>, N>& faces,
                           const Point3<Real>& mean, const Real& tolerance) {
  using std::ldexp;
  Witness<Real> best = witness_at(volume, faces, mean);
  if (best.margin > tolerance) return best;
  const Point3<Real> inward = inward_of(volume, faces, mean, tolerance);
  const auto margin_after = [&](int k) -> Real {
    const Witness<Real> next = witness_at(volume, faces, mean + ldexp(volume.range, -k) * inward);
    if (next.margin > best.margin) best = next;
    return next.margin;
  };
  int least = 1, most = Precision<Real>::k_tolerance_bits;  // then a step is no larger than the tolerance
  while (least < most && !(best.margin > tolerance)) {
    const int k = (least + most) / 2;
    if (margin_after(k) < margin_after(k + 1))
      least = k + 1;
    else
      most = k;
  }
  return best;
}

// A cheaper test with fewer digits: yes only if p lies beyond a face by far more than the tolerance.
template <class Real>
struct QuickReject {
  static bool is_beyond_face(const HalfSpace<Real>&, const Point3<Real>&) { return false; }
};

template <>
struct QuickReject<DoubleDouble> {
  static bool is_beyond_face(const HalfSpace<DoubleDouble>& face, const Point3<DoubleDouble>& p) {
    const double x = face.normal.x.hi * p.x.hi, y = face.normal.y.hi * p.y.hi, z = face.normal.z.hi * p.z.hi;
    const double size = std::abs(face.offset.hi) + std::abs(x) + std::abs(y) + std::abs(z);
    return face.offset.hi - (x + y + z) < -0x1p-30 * size;
  }
};

// Is p in the volume and behind all faces, up to the tolerance?
template <class Real, std::size_t N>
bool is_within(const Volume<Real>& volume, const std::array<HalfSpace<Real>, N>& faces, const Point3<Real>& p,
               const Real& tolerance) {
  for (const HalfSpace<Real>& face : faces)
    if (QuickReject<Real>::is_beyond_face(face, p)) return false;
  const Point3<Real> v = p - volume.apex;
  const Real reach = volume.range + tolerance;
  if (dot(v, v) > reach * reach) return false;
  for (const HalfSpace<Real>& face : faces)
    if (face.margin(p) < -tolerance) return false;
  return !volume.is_cone || volume.side_margin(p) >= -tolerance;
}

// The faces that the volume reaches, and whether the volume certainly lies beyond one of them.
template <std::size_t N>
struct Reached {
  std::array<bool, N> faces;
  bool is_beyond = false;
};
template <class Real, std::size_t N>
Reached<N> reached_faces(const Volume<Real>& volume, const std::array<HalfSpace<Real>, N>& faces,
                         const Real& tolerance) {
  Reached<N> reached;
  for (std::size_t i = 0; i < N; ++i) {
    const Real margin = faces[i].margin(volume.apex);
    if (margin < -tolerance && margin + volume.extent(Real(-1) * faces[i].normal) < -tolerance)
      reached.is_beyond = true;
    reached.faces[i] = margin < tolerance || margin - volume.extent(faces[i].normal) <= tolerance;
  }
  return reached;
}

// A cell (which has to outlive this) and a volume, with the tolerance for their size.
template <class Real>
struct Setting {
  Volume<Real> volume;
  const Polytope<Real>& cell;
  Real tolerance;

  Setting(const Volume<Real>& unlimited, const Polytope<Real>& polytope) : cell(polytope) {
    Real square(0);
    for (const Point3<Real>& corner : cell.corners) square = std::max(square, dot(corner, corner));
    const Real size = SquareRoot<Real>::of(square);
    volume = within(unlimited, size);
    tolerance = Precision<Real>::tolerance() * (size + length(volume.apex) + volume.range);
  }

  // A point of both, if its margin is above the tolerance; without a margin if no candidate is close to both.
  Witness<Real> common_point(const std::array<bool, 6>& reached) const {
    Mean<Real> mean;
    Witness<Real> early{volume.apex, Real(-1)};
    polytope_candidates(volume, cell, reached, [&](const Point3<Real>& p) {
      if (early.margin > tolerance || !is_within(volume, cell.faces, p, tolerance)) return;
      mean.add(p);
      if (mean.count == 2 || mean.count == 4) early = witness_at(volume, cell.faces, mean.at());
    });
    if (mean.count == 0 || early.margin > tolerance) return early;
    return find_witness(volume, cell.faces, mean.at(), tolerance);
  }
};

}  // namespace clusterbench::geom
