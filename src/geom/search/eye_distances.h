#pragma once
// Search for the least and the greatest distance from the eye over a light's volume in a tile's pyramid, in any number
// type. The results are not proofs.

#include "geom/numbers/point3.h"
#include "geom/numbers/precision.h"
#include "geom/search/common_point.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/polytope.h"

namespace clusterbench::geom {

// pyramid ∩ volume, relative to the eye.
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
  pyramid_candidates(volume, pyramid, reached.faces, Precision<Real>::k_root_bits, [&](const Point3<Real>& p) {
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

// A point of the set certainly lies within this distance of an extreme candidate that may itself be outside by the
// tolerance: moved towards a point well inside, the candidate enters the convex set.
template <class Real>
Real pull(const PyramidReach<Real>& reach, const Point3<Real>& extreme) {
  return reach.tolerance * (Real(2) + Real(2) * length(reach.inside.at - extreme) / reach.inside.margin);
}

}  // namespace clusterbench::geom
