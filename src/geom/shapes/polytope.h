#pragma once
// Cells bounded by planes, and pyramids through the eye, over any number type.

#include <array>

#include "geom/numbers/point3.h"
#include "geom/shapes/cell.h"

namespace clusterbench::geom {

// normal·p <= offset, unit normal.
template <class Real>
struct HalfSpace {
  Point3<Real> normal;
  Real offset;

  Real margin(const Point3<Real>& p) const { return offset - dot(normal, p); }
};

// Bits of a corner's index select the low or high side: 1 for x, 2 for y, 4 for depth.
template <class Real>
struct Polytope {
  std::array<HalfSpace<Real>, 6> faces;
  std::array<Point3<Real>, 8> corners;
};

// Four planes through the eye, and the rays in which neighbouring planes meet; all depths are at least 0.
template <class Real>
struct Pyramid {
  std::array<HalfSpace<Real>, 4> faces;
  std::array<Point3<Real>, 4> rays;  // unit
};

template <class Real>
HalfSpace<Real> half_space(const Real& x, const Real& y, const Real& z, const Real& offset) {
  const Real size = length(Point3<Real>{x, y, z});
  return {{x / size, y / size, z / size}, offset / size};
}

template <class Real>
Polytope<Real> polytope_of(const Box& box) {
  Polytope<Real> cell;
  const auto along = [](int x, int y, int z) { return Point3<Real>{Real(x), Real(y), Real(z)}; };
  cell.faces = {HalfSpace<Real>{along(-1, 0, 0), -Real(box.lo.x)},
                {along(1, 0, 0), Real(box.hi.x)},
                {along(0, -1, 0), -Real(box.lo.y)},
                {along(0, 1, 0), Real(box.hi.y)},
                {along(0, 0, -1), -Real(box.lo.z)},
                {along(0, 0, 1), Real(box.hi.z)}};
  for (unsigned i = 0; i < 8; ++i)
    cell.corners[i] = {Real((i & 1) != 0 ? box.hi.x : box.lo.x), Real((i & 2) != 0 ? box.hi.y : box.lo.y),
                       Real((i & 4) != 0 ? box.hi.z : box.lo.z)};
  return cell;
}

// depth = -z: x <= x1 * depth is x + x1 * z <= 0.
template <class Real>
std::array<HalfSpace<Real>, 4> slope_planes(float x0, float x1, float y0, float y1) {
  const Real zero(0), plus(1), minus(-1);
  return {half_space<Real>(minus, zero, -Real(x0), zero), half_space<Real>(plus, zero, Real(x1), zero),
          half_space<Real>(zero, minus, -Real(y0), zero), half_space<Real>(zero, plus, Real(y1), zero)};
}

template <class Real>
Polytope<Real> polytope_of(const FrustumCell& frustum) {
  if (frustum.orthographic)
    return polytope_of<Real>(Box{{frustum.x0, frustum.y0, -frustum.depth1}, {frustum.x1, frustum.y1, -frustum.depth0}});
  Polytope<Real> cell;
  const auto sides = slope_planes<Real>(frustum.x0, frustum.x1, frustum.y0, frustum.y1);
  const Real zero(0);
  cell.faces = {sides[0],
                sides[1],
                sides[2],
                sides[3],
                HalfSpace<Real>{{zero, zero, Real(1)}, -Real(frustum.depth0)},
                {{zero, zero, Real(-1)}, Real(frustum.depth1)}};
  for (unsigned i = 0; i < 8; ++i) {
    const Real depth((i & 4) != 0 ? frustum.depth1 : frustum.depth0);
    cell.corners[i] = {Real((i & 1) != 0 ? frustum.x1 : frustum.x0) * depth,
                       Real((i & 2) != 0 ? frustum.y1 : frustum.y0) * depth, -depth};
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

}  // namespace clusterbench::geom
