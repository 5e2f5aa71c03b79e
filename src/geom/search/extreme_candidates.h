#pragma once
// Candidates for the nearest and the farthest points of a light's volume and a cell, in closed form, over any number
// type: double for the filter, 256 bits and more for the pairs that it leaves uncertain. The volume is a ball, or ball
// ∩ solid cone (a spot); cells are bounded by planes, or are a pyramid through the eye cut by two shells.
//
// Every list of candidates is complete for its purpose; extra candidates do no harm, because a candidate counts only if
// it lies in volume and cell up to a tolerance.

#include <array>

#include "geom/numbers/polynomial.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/polytope.h"

namespace clusterbench::geom {

// Real roots of a t² + 2 b t + c, and its minimum: near a double root, rounding may hide the roots themselves.
template <class Real, class Visit>
void quadratic_roots(const Real& a, const Real& b, const Real& c, Visit&& visit) {
  const Real zero(0);
  const Real discriminant = b * b - a * c;
  if (a != zero) visit(-b / a);
  if (discriminant < zero) return;
  const Real root = SquareRoot<Real>::of(discriminant);
  const Real q = b < zero ? root - b : -root - b;
  if (a != zero) visit(q / a);
  if (q != zero) visit(c / q);
}

// The generators in the plane of axis and n, on both sides.
template <class Real, class Visit>
void generators_towards(const Volume<Real>& volume, const Point3<Real>& n, Visit&& visit) {
  const Point3<Real> m = unit_across(volume.axis, n);
  visit(volume.cos_angle * volume.axis + volume.sin_angle * m);
  visit(volume.cos_angle * volume.axis - volume.sin_angle * m);
}

// The parameter of the point of the line start + t * step that is nearest to the apex. Quadratics relative to this
// point keep digits that they would lose if the start is far away.
template <class Real>
Real foot_of(const Point3<Real>& apex, const Point3<Real>& start, const Point3<Real>& step) {
  const Real square = dot(step, step);
  return square == Real(0) ? Real(0) : dot(apex - start, step) / square;
}

// Where the line start + t * step meets the cone's surface.
template <class Real, class Visit>
void line_on_cone(const Volume<Real>& volume, const Point3<Real>& start, const Point3<Real>& step, Visit&& visit) {
  const Real foot = foot_of(volume.apex, start, step);
  const Point3<Real> v = start + foot * step - volume.apex;
  const Real v_along = dot(v, volume.axis), step_along = dot(step, volume.axis);
  const Point3<Real> v_across = v - v_along * volume.axis, step_across = step - step_along * volume.axis;
  const Real s2 = volume.sin_angle * volume.sin_angle, c2 = volume.cos_angle * volume.cos_angle;
  // sin² along² = cos² across²: keeps its digits for narrow cones, where along² = cos² |v|² loses them.
  quadratic_roots<Real>(s2 * step_along * step_along - c2 * dot(step_across, step_across),
                        s2 * v_along * step_along - c2 * dot(v_across, step_across),
                        s2 * v_along * v_along - c2 * dot(v_across, v_across), [&](const Real& t) { visit(foot + t); });
}

template <class Real, class Visit>
void line_on_sphere(const Volume<Real>& volume, const Point3<Real>& start, const Point3<Real>& step, Visit&& visit) {
  const Real foot = foot_of(volume.apex, start, step);
  const Point3<Real> v = start + foot * step - volume.apex;
  quadratic_roots<Real>(dot(step, step), dot(v, step), dot(v, v) - volume.range * volume.range,
                        [&](const Real& t) { visit(foot + t); });
}

// Where a plane meets the rim: sphere, cone and plane at once.
template <class Real, class Visit>
void plane_on_rim(const Volume<Real>& volume, const HalfSpace<Real>& plane, Visit&& visit) {
  const Point3<Real> m = unit_across(volume.axis, plane.normal), m2 = cross(volume.axis, m);
  const Real along = volume.range * volume.cos_angle, across = volume.range * volume.sin_angle;
  const Real lean = across * dot(plane.normal, m);
  if (lean == Real(0)) return;
  const Real cosine = (plane.margin(volume.apex) - along * dot(plane.normal, volume.axis)) / lean;
  const Real square = Real(1) - cosine * cosine;
  // Rounding may make a plane tangent to the rim just miss it; the caller's tolerance decides.
  const Real sine = square < Real(0) ? Real(0) : SquareRoot<Real>::of(square);
  const Point3<Real> middle = volume.apex + along * volume.axis + (across * cosine) * m;
  visit(middle + (across * sine) * m2);
  visit(middle - (across * sine) * m2);
}

// Calls visit(point) for all points where cell ∩ infinite cone can be nearest to the apex (for a ball: where the cell
// can be nearest to the centre), and for extreme points of cell ∩ volume, whose mean lies inside it. Faces that the
// volume does not reach (`reached`) have no such point on them.
template <class Real, class Visit>
void polytope_candidates(const Volume<Real>& volume, const Polytope<Real>& cell, const std::array<bool, 6>& reached,
                         Visit&& visit) {
  visit(volume.apex);
  for (std::size_t i = 0; i < 6; ++i) {
    const HalfSpace<Real>& face = cell.faces[i];
    visit(volume.apex - volume.range * face.normal);
    if (!reached[i]) continue;
    visit(volume.apex + face.margin(volume.apex) * face.normal);
    if (!volume.is_cone) continue;
    generators_towards(volume, face.normal, [&](const Point3<Real>& g) {
      const Real lean = dot(face.normal, g);
      if (lean != Real(0)) visit(volume.apex + (face.margin(volume.apex) / lean) * g);
      visit(volume.apex + volume.range * g);
    });
    plane_on_rim(volume, face, visit);
  }
  if (volume.is_cone) visit(volume.apex + volume.range * volume.axis);
  const auto face_of = [](unsigned corner, unsigned axis) { return 2 * axis + ((corner >> axis) & 1); };
  for (unsigned corner = 0; corner < 8; ++corner) {
    const std::array<bool, 3> sides{reached[face_of(corner, 0)], reached[face_of(corner, 1)],
                                    reached[face_of(corner, 2)]};
    if (sides[0] && sides[1] && sides[2]) visit(cell.corners[corner]);
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned bit = 1u << axis;
      if ((corner & bit) != 0 || !sides[(axis + 1) % 3] || !sides[(axis + 2) % 3]) continue;
      const Point3<Real>& start = cell.corners[corner];
      const Point3<Real> step = cell.corners[corner | bit] - start;
      const auto visit_at = [&](const Real& t) { visit(start + t * step); };
      const Real square = dot(step, step);
      if (square != Real(0)) visit_at(dot(volume.apex - start, step) / square);
      line_on_sphere(volume, start, step, visit_at);
      if (volume.is_cone) line_on_cone(volume, start, step, visit_at);
    }
  }
}

// Extremes of the distance from the eye (the origin, which lies in the plane) along the conic of plane and cone. With
// phi around the axis from m, a generator g meets the plane at distance s = h / lean from the apex, lean = alpha + beta
// cos phi; setting the derivative of the squared distance to zero,
//   lean' (apex·g lean + h) = apex·g' lean²,
// and tau = tan(phi / 2) gives a quartic without square term. The same equation gives s = apex·g' lean / lean' -
// apex·g, which keeps digits that h / lean loses: for an apex near the plane, whose generators in the plane have lean
// 0.
template <class Real, class Visit>
void conic_extremes(const Volume<Real>& volume, const HalfSpace<Real>& plane, int bits, Visit&& visit) {
  const Point3<Real> m = unit_across(volume.axis, plane.normal), m2 = cross(volume.axis, m);
  const Real h = plane.margin(volume.apex);
  const Real alpha = volume.cos_angle * dot(plane.normal, volume.axis);
  const Real beta = volume.sin_angle * dot(plane.normal, m);
  const Real gamma = volume.cos_angle * dot(volume.apex, volume.axis);
  const Real delta = volume.sin_angle * dot(volume.apex, m), epsilon = volume.sin_angle * dot(volume.apex, m2);
  const Real kappa = beta * gamma - alpha * delta, sum = alpha + beta, difference = alpha - beta;
  const Real two(2);
  const Polynomial<Real> quartic{{sum * sum * epsilon, two * (sum * kappa + h * beta), Real(0),
                                  two * (difference * kappa + h * beta), -difference * difference * epsilon},
                                 4};
  const Polynomial<Real> reversed{{quartic.c[4], quartic.c[3], quartic.c[2], quartic.c[1], quartic.c[0]}, 4};
  const auto visit_generator = [&](const Real& cosine, const Real& sine) {
    const Real lean = alpha + beta * cosine, slope = -beta * sine;
    const Point3<Real> g =
        volume.cos_angle * volume.axis + (volume.sin_angle * cosine) * m + (volume.sin_angle * sine) * m2;
    if (lean * lean < slope * slope) {
      const Real turned = epsilon * cosine - delta * sine;  // apex·g'
      visit(volume.apex + (turned * lean / slope - dot(volume.apex, g)) * g);
    } else if (lean != Real(0)) {
      visit(volume.apex + (h / lean) * g);
    }
  };
  for (const Real& tau : roots_of(quartic, bits)) {
    const Real square = tau * tau;
    visit_generator((Real(1) - square) / (Real(1) + square), two * tau / (Real(1) + square));
  }
  for (const Real& inverse : roots_of(reversed, bits)) {
    const Real square = inverse * inverse;
    visit_generator((square - Real(1)) / (square + Real(1)), two * inverse / (square + Real(1)));
  }
  visit_generator(Real(-1), Real(0));
}

// Calls visit(point) for all points where pyramid ∩ volume can be nearest to or farthest from the eye. Faces that the
// volume does not reach have no such point on them.
template <class Real, class Visit>
void pyramid_candidates(const Volume<Real>& volume, const Pyramid<Real>& pyramid, const std::array<bool, 4>& reached,
                        int bits, Visit&& visit) {
  const Real zero(0);
  visit(Point3<Real>{zero, zero, zero});
  visit(volume.apex);
  // Along a direction from the origin to a centre: the near and far end of a ball, or of its section by a plane.
  const auto visit_ends = [&](const Point3<Real>& center, const Real& radius) {
    const Real size = length(center);
    if (size == zero) return;
    visit(center - (radius / size) * center);
    visit(center + (radius / size) * center);
  };
  visit_ends(volume.apex, volume.range);
  if (volume.is_cone) {
    generators_towards(volume, volume.apex, [&](const Point3<Real>& g) {
      visit(volume.apex - dot(volume.apex, g) * g);
      visit(volume.apex + volume.range * g);
    });
    visit(volume.apex + volume.range * volume.axis);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const HalfSpace<Real>& face = pyramid.faces[i];
    visit(volume.apex - volume.range * face.normal);
    if (!reached[i]) continue;
    const Real height = face.margin(volume.apex);
    const Real square = volume.range * volume.range - height * height;
    // Rounding may make a tangent plane just miss the ball; the caller's tolerance decides.
    visit_ends(volume.apex + height * face.normal, square < zero ? zero : SquareRoot<Real>::of(square));
    if (!volume.is_cone) continue;
    conic_extremes(volume, face, bits, visit);
    plane_on_rim(volume, face, visit);
  }
  for (unsigned corner = 0; corner < 4; ++corner) {
    if (!reached[corner & 1] || !reached[2 + (corner >> 1)]) continue;
    const Point3<Real>& ray = pyramid.rays[corner];
    const auto visit_at = [&](const Real& t) {
      if (!(t < zero)) visit(t * ray);
    };
    line_on_sphere(volume, {zero, zero, zero}, ray, visit_at);
    if (volume.is_cone) line_on_cone(volume, {zero, zero, zero}, ray, visit_at);
  }
}

}  // namespace clusterbench::geom
