#pragma once
// A light's volume and cells in any number type, and the search for common points and for distances from the eye that
// the closed forms of candidates.h allow. Everything here is a find: what it proves is said where it is used.

#include <algorithm>
#include <limits>

#include "geom/candidates.h"
#include "geom/light_volume.h"
#include "geom/placement.h"
#include "geom/shapes.h"

namespace clusterbench::geom {

// What a number type can tell apart, relative to the size of the numbers involved.
template <class Real>
struct Precision;
template <>
struct Precision<double> {
  static constexpr int k_tolerance_bits = 38, k_place_bits = 53;
  static double tolerance() { return 0x1p-38; }
};

template <class Real>
Point3<Real> placed(const Placement& place) {
  Real t[3], local[3];
  for (int i = 0; i < 3; ++i) t[i] = Real(place.position[i]) - Real(place.origin[i]);
  for (int row = 0; row < 3; ++row) {
    local[row] = Real(0);
    for (int column = 0; column < 3; ++column) local[row] += Real(place.rotation[column][row]) * t[column];
  }
  return {local[0], local[1], local[2]};
}

// An infinite range stays infinite.
template <class Real>
Volume<Real> volume_of(const LightVolume& light) {
  using std::cos;
  using std::sin;
  Volume<Real> volume;
  volume.apex = placed<Real>(light.apex);
  volume.range = Real(light.range);
  volume.is_cone = light.is_cone;
  const Point3<Real> axis = placed<Real>({light.direction, Vec3d(0.0), light.apex.rotation});
  volume.axis = (Real(1) / length(axis)) * axis;
  volume.cos_angle = cos(Real(light.half_angle_rad));
  volume.sin_angle = sin(Real(light.half_angle_rad));
  return volume;
}

// Without the range beyond what matters: `reach` is the largest distance from the origin that does.
template <class Real>
Volume<Real> within(Volume<Real> volume, const Real& reach) {
  const Real enough = Real(2) * (length(volume.apex) + reach);
  if (volume.range > enough) volume.range = enough;
  return volume;
}

template <class Real>
HalfSpace<Real> half_space(const Real& x, const Real& y, const Real& z, const Real& offset) {
  const Real size = length(Point3<Real>{x, y, z});
  return {{x / size, y / size, z / size}, offset / size};
}

template <class Real>
Polytope<Real> polytope_of(const Box& box) {
  Polytope<Real> cell;
  const Real zero(0), one(1);
  cell.faces = {HalfSpace<Real>{{-one, zero, zero}, -Real(box.lo.x)},
                {{one, zero, zero}, Real(box.hi.x)},
                {{zero, -one, zero}, -Real(box.lo.y)},
                {{zero, one, zero}, Real(box.hi.y)},
                {{zero, zero, -one}, -Real(box.lo.z)},
                {{zero, zero, one}, Real(box.hi.z)}};
  for (unsigned i = 0; i < 8; ++i)
    cell.corners[i] = {Real((i & 1) != 0 ? box.hi.x : box.lo.x), Real((i & 2) != 0 ? box.hi.y : box.lo.y),
                       Real((i & 4) != 0 ? box.hi.z : box.lo.z)};
  return cell;
}

// depth = -z: x <= x1 * depth is x + x1 * z <= 0.
template <class Real>
std::array<HalfSpace<Real>, 4> slope_planes(float x0, float x1, float y0, float y1) {
  const Real zero(0), one(1);
  return {half_space<Real>(-one, zero, -Real(x0), zero), half_space<Real>(one, zero, Real(x1), zero),
          half_space<Real>(zero, -one, -Real(y0), zero), half_space<Real>(zero, one, Real(y1), zero)};
}

template <class Real>
Polytope<Real> polytope_of(const FrustumPiece& piece) {
  if (piece.orthographic)
    return polytope_of<Real>(Box{{piece.x0, piece.y0, -piece.depth1}, {piece.x1, piece.y1, -piece.depth0}});
  Polytope<Real> cell;
  const auto sides = slope_planes<Real>(piece.x0, piece.x1, piece.y0, piece.y1);
  const Real zero(0), one(1);
  cell.faces = {sides[0],
                sides[1],
                sides[2],
                sides[3],
                HalfSpace<Real>{{zero, zero, one}, -Real(piece.depth0)},
                {{zero, zero, -one}, Real(piece.depth1)}};
  for (unsigned i = 0; i < 8; ++i) {
    const Real depth((i & 4) != 0 ? piece.depth1 : piece.depth0);
    cell.corners[i] = {Real((i & 1) != 0 ? piece.x1 : piece.x0) * depth,
                       Real((i & 2) != 0 ? piece.y1 : piece.y0) * depth, -depth};
  }
  return cell;
}

template <class Real>
Pyramid<Real> pyramid_of(float x0, float x1, float y0, float y1) {
  Pyramid<Real> pyramid;
  pyramid.faces = slope_planes<Real>(x0, x1, y0, y1);
  for (unsigned i = 0; i < 4; ++i) {
    const Point3<Real> ray{Real((i & 1) != 0 ? x1 : x0), Real((i & 2) != 0 ? y1 : y0), Real(-1)};
    pyramid.rays[i] = (Real(1) / length(ray)) * ray;
  }
  return pyramid;
}

// The part of a cell's faces and of the volume that every point has to satisfy, as how far inside it is.
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

// A point of cell ∩ volume and how far inside all of their surfaces it is.
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

// Sum of the inward normals of the surfaces that p lies on.
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

// The mean of points of a convex set lies in it. Where they all lie on the same surfaces, so does their mean: then the
// search goes on from there, inward. How far inside a point is, is a concave function of the step: of range / 2^k, the
// best is found by halving the k that may be it.
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
  int least = 1, most = Precision<Real>::k_tolerance_bits;  // then a step is no more than the tolerance
  while (least < most && !(best.margin > tolerance)) {
    const int k = (least + most) / 2;
    if (margin_after(k) < margin_after(k + 1))
      least = k + 1;
    else
      most = k;
  }
  return best;
}

// Does less than all of a number's digits show that p is before a face, by far more than the tolerance? That spares the
// rest.
template <class Real>
struct Glance {
  static bool is_before(const HalfSpace<Real>&, const Point3<Real>&) { return false; }
};

// Is p in the volume and behind all faces, give or take the tolerance?
template <class Real, std::size_t N>
bool is_within(const Volume<Real>& volume, const std::array<HalfSpace<Real>, N>& faces, const Point3<Real>& p,
               const Real& tolerance) {
  for (const HalfSpace<Real>& face : faces)
    if (Glance<Real>::is_before(face, p)) return false;
  const Point3<Real> v = p - volume.apex;
  const Real reach = volume.range + tolerance;
  if (dot(v, v) > reach * reach) return false;
  for (const HalfSpace<Real>& face : faces)
    if (face.margin(p) < -tolerance) return false;
  return !volume.is_cone || volume.side_margin(p) >= -tolerance;
}

// Which faces the volume reaches; whether it lies beyond one of them for certain.
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

// A cell (which has to outlive this) and a volume, with the tolerance that their size asks for.
template <class Real>
struct Setting {
  Volume<Real> volume;
  const Polytope<Real>& cell;
  Real tolerance;

  Setting(const Volume<Real>& unlimited, const Polytope<Real>& polytope) : cell(polytope) {
    Real size(0);
    for (const Point3<Real>& corner : cell.corners) size = std::max(size, length(corner));
    volume = within(unlimited, size);
    tolerance = Precision<Real>::tolerance() * (size + length(volume.apex) + volume.range);
  }

  // A point of both, if its margin is above the tolerance; without a margin if there is not even one close to both.
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

// pyramid ∩ volume as seen from the eye.
template <class Real>
struct PyramidReach {
  bool is_empty = true;    // no candidate lies in both
  bool is_beyond = false;  // a plane of the pyramid lies between
  Point3<Real> nearest, farthest;
  Real lo, hi;           // distances of these, up to tolerance
  Witness<Real> inside;  // margin <= tolerance: nothing is certain
  Real tolerance;
};

template <class Real>
PyramidReach<Real> pyramid_reach(const Volume<Real>& volume, const Pyramid<Real>& pyramid) {
  PyramidReach<Real> reach;
  reach.tolerance = Precision<Real>::tolerance() * (length(volume.apex) + volume.range);
  const Reached<4> reached = reached_faces(volume, pyramid.faces, reach.tolerance);
  reach.is_beyond = reached.is_beyond;
  if (reach.is_beyond) return reach;
  Mean<Real> mean;
  pyramid_candidates(volume, pyramid, reached.faces, Precision<Real>::k_place_bits, [&](const Point3<Real>& p) {
    if (!is_within(volume, pyramid.faces, p, reach.tolerance)) return;
    const Real distance = length(p);
    if (reach.is_empty || distance < reach.lo) {
      reach.lo = distance;
      reach.nearest = p;
    }
    if (reach.is_empty || distance > reach.hi) {
      reach.hi = distance;
      reach.farthest = p;
    }
    reach.is_empty = false;
    mean.add(p);
  });
  if (reach.is_empty) return reach;
  reach.inside = find_witness(volume, pyramid.faces, mean.at(), reach.tolerance);
  return reach;
}

// A point of the set is sure to lie within this distance of an extreme candidate that may itself be outside by the
// tolerance: pulled towards a point well inside, it enters the convex set.
template <class Real>
Real pull(const PyramidReach<Real>& reach, const Point3<Real>& extreme) {
  return reach.tolerance * (Real(2) + Real(2) * length(reach.inside.at - extreme) / reach.inside.margin);
}

}  // namespace clusterbench::geom
