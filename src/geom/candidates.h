#pragma once
// Where a light's volume and a cell can be nearest or farthest, in closed form, over any number type: double for the
// filter, 256 bits and more for what it leaves open. The volume is a ball, or a ball ∩ solid cone (a spot); cells are
// bounded by planes, or a pyramid through the eye cut by two shells.
//
// Every list of candidates is complete for its question, and whatever else is on it does no harm: a candidate counts
// only if it lies in volume and cell up to a tolerance.

#include <algorithm>
#include <array>
#include <cmath>

namespace clusterbench::geom {

// How a number type takes square roots.
template <class Real>
struct SquareRoot {
  static Real of(const Real& square) {
    using std::sqrt;
    return sqrt(square);
  }
};

template <class Real>
struct Point3 {
  Real x, y, z;

  friend Point3 operator+(const Point3& a, const Point3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Point3 operator-(const Point3& a, const Point3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Point3 operator*(const Real& s, const Point3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend bool operator==(const Point3& a, const Point3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
  friend Real dot(const Point3& a, const Point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend Point3 cross(const Point3& a, const Point3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend Real length(const Point3& a) { return SquareRoot<Real>::of(dot(a, a)); }
};

template <class Real>
struct Volume {
  Point3<Real> apex;
  Point3<Real> axis;  // unit
  Real range, cos_angle, sin_angle;
  bool is_cone;

  // How far inside the cone's side a point is; negative outside. Never more than `along`, which only an angle of 0
  // needs said.
  Real side_margin(const Point3<Real>& p) const {
    const Point3<Real> v = p - apex;
    const Real along = dot(v, axis);
    const Real side = sin_angle * along - cos_angle * length(v - along * axis);
    return side < along ? side : along;
  }
  // How far the volume extends from its apex in a unit direction.
  Real extent(const Point3<Real>& direction) const {
    if (!is_cone) return range;
    const Real along = dot(direction, axis);
    if (!(along < cos_angle)) return range;
    const Real lean = cos_angle * along + sin_angle * length(direction - along * axis);
    return lean > Real(0) ? range * lean : Real(0);
  }
};

// normal·p <= offset, unit normal.
template <class Real>
struct HalfSpace {
  Point3<Real> normal;
  Real offset;

  Real margin(const Point3<Real>& p) const { return offset - dot(normal, p); }
};

// Corner i takes the low or high side by its bits: 1 for x, 2 for y, 4 for depth.
template <class Real>
struct Polytope {
  std::array<HalfSpace<Real>, 6> faces;
  std::array<Point3<Real>, 8> corners;
};

// Four planes through the eye and the rays in which neighbours meet; depth is not negative in it.
template <class Real>
struct Pyramid {
  std::array<HalfSpace<Real>, 4> faces;
  std::array<Point3<Real>, 4> rays;  // unit
};

// A unit vector across `axis`, towards n where n has such a part. What n loses along the axis, rounded, may be most of
// what is left of it: taken away once more, no part along the axis remains.
template <class Real>
Point3<Real> unit_across(const Point3<Real>& axis, const Point3<Real>& n) {
  const Point3<Real> part = n - dot(n, axis) * axis;
  const Real size = length(part);
  if (size * size > Real(0.01) * dot(n, n)) return (Real(1) / size) * part;
  if (size > Real(1e-110)) {
    const Point3<Real> once = (Real(1) / size) * part;
    const Point3<Real> twice = once - dot(once, axis) * axis;
    const Real left = length(twice);
    if (left > Real(0.5)) return (Real(1) / left) * twice;
  }
  const bool x_is_small = axis.x * axis.x < Real(0.5);
  const Point3<Real> other =
      x_is_small ? Point3<Real>{Real(1), Real(0), Real(0)} : Point3<Real>{Real(0), Real(1), Real(0)};
  const Point3<Real> perpendicular = cross(axis, other);
  return (Real(1) / length(perpendicular)) * perpendicular;
}

// Real roots of a t² + 2 b t + c, and where it is least: near a double root rounding may hide the roots themselves.
template <class Real, class Take>
void quadratic_places(const Real& a, const Real& b, const Real& c, Take&& take) {
  const Real zero(0);
  const Real discriminant = b * b - a * c;
  if (a != zero) take(-b / a);
  if (discriminant < zero) return;
  const Real root = SquareRoot<Real>::of(discriminant);
  const Real q = b < zero ? root - b : -root - b;
  if (a != zero) take(q / a);
  if (q != zero) take(c / q);
}

// The generators in the plane of axis and n, on both sides.
template <class Real, class Take>
void generators_towards(const Volume<Real>& volume, const Point3<Real>& n, Take&& take) {
  const Point3<Real> m = unit_across(volume.axis, n);
  take(volume.cos_angle * volume.axis + volume.sin_angle * m);
  take(volume.cos_angle * volume.axis - volume.sin_angle * m);
}

// The place of the line start + t * step that is nearest to the apex. Quadratics around it keep the digits that the
// square of a start far away takes from the range and the cone.
template <class Real>
Real foot_of(const Point3<Real>& apex, const Point3<Real>& start, const Point3<Real>& step) {
  const Real square = dot(step, step);
  return square == Real(0) ? Real(0) : dot(apex - start, step) / square;
}

// Where the line start + t * step meets the cone's surface.
template <class Real, class Take>
void line_on_cone(const Volume<Real>& volume, const Point3<Real>& start, const Point3<Real>& step, Take&& take) {
  const Real foot = foot_of(volume.apex, start, step);
  const Point3<Real> v = start + foot * step - volume.apex;
  const Real v_along = dot(v, volume.axis), step_along = dot(step, volume.axis);
  const Point3<Real> v_across = v - v_along * volume.axis, step_across = step - step_along * volume.axis;
  const Real s2 = volume.sin_angle * volume.sin_angle, c2 = volume.cos_angle * volume.cos_angle;
  // sin² along² = cos² across²: keeps its digits for narrow cones, where along² = cos² |v|² loses them.
  quadratic_places<Real>(s2 * step_along * step_along - c2 * dot(step_across, step_across),
                         s2 * v_along * step_along - c2 * dot(v_across, step_across),
                         s2 * v_along * v_along - c2 * dot(v_across, v_across), [&](const Real& t) { take(foot + t); });
}

template <class Real, class Take>
void line_on_sphere(const Volume<Real>& volume, const Point3<Real>& start, const Point3<Real>& step, Take&& take) {
  const Real foot = foot_of(volume.apex, start, step);
  const Point3<Real> v = start + foot * step - volume.apex;
  quadratic_places<Real>(dot(step, step), dot(v, step), dot(v, v) - volume.range * volume.range,
                         [&](const Real& t) { take(foot + t); });
}

// Where a plane meets the rim: sphere, cone and plane at once.
template <class Real, class Take>
void plane_on_rim(const Volume<Real>& volume, const HalfSpace<Real>& plane, Take&& take) {
  const Point3<Real> m = unit_across(volume.axis, plane.normal), m2 = cross(volume.axis, m);
  const Real along = volume.range * volume.cos_angle, across = volume.range * volume.sin_angle;
  const Real lean = across * dot(plane.normal, m);
  if (lean == Real(0)) return;
  const Real cosine = (plane.margin(volume.apex) - along * dot(plane.normal, volume.axis)) / lean;
  const Real square = Real(1) - cosine * cosine;
  // A plane tangent to the rim may be computed as just missing it: the caller's tolerance decides.
  const Real sine = square < Real(0) ? Real(0) : SquareRoot<Real>::of(square);
  const Point3<Real> middle = volume.apex + along * volume.axis + (across * cosine) * m;
  take(middle + (across * sine) * m2);
  take(middle - (across * sine) * m2);
}

// Calls take(point) for all places where cell ∩ infinite cone can be nearest to the apex (for a ball: where the cell
// can be nearest to the centre), and for extreme points of cell ∩ volume, whose mean lies inside it. Faces that the
// volume does not reach (`reached`) have no such place on them.
template <class Real, class Take>
void polytope_candidates(const Volume<Real>& volume, const Polytope<Real>& cell, const std::array<bool, 6>& reached,
                         Take&& take) {
  take(volume.apex);
  for (std::size_t i = 0; i < 6; ++i) {
    const HalfSpace<Real>& face = cell.faces[i];
    take(volume.apex - volume.range * face.normal);
    if (!reached[i]) continue;
    take(volume.apex + face.margin(volume.apex) * face.normal);
    if (!volume.is_cone) continue;
    generators_towards(volume, face.normal, [&](const Point3<Real>& g) {
      const Real lean = dot(face.normal, g);
      if (lean != Real(0)) take(volume.apex + (face.margin(volume.apex) / lean) * g);
      take(volume.apex + volume.range * g);
    });
    plane_on_rim(volume, face, take);
  }
  if (volume.is_cone) take(volume.apex + volume.range * volume.axis);
  const auto face_of = [](unsigned corner, unsigned axis) { return 2 * axis + ((corner >> axis) & 1); };
  for (unsigned corner = 0; corner < 8; ++corner) {
    const std::array<bool, 3> sides{reached[face_of(corner, 0)], reached[face_of(corner, 1)],
                                    reached[face_of(corner, 2)]};
    if (sides[0] && sides[1] && sides[2]) take(cell.corners[corner]);
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned bit = 1u << axis;
      if ((corner & bit) != 0 || !sides[(axis + 1) % 3] || !sides[(axis + 2) % 3]) continue;
      const Point3<Real>& start = cell.corners[corner];
      const Point3<Real> step = cell.corners[corner | bit] - start;
      const auto take_at = [&](const Real& t) { take(start + t * step); };
      const Real square = dot(step, step);
      if (square != Real(0)) take_at(dot(volume.apex - start, step) / square);
      line_on_sphere(volume, start, step, take_at);
      if (volume.is_cone) line_on_cone(volume, start, step, take_at);
    }
  }
}

// A polynomial c[0] + c[1] t + ... of degree `degree` <= 4.
template <class Real>
struct Polynomial {
  std::array<Real, 5> c;
  int degree;

  Real value_at(const Real& t) const {
    Real value = c[static_cast<std::size_t>(degree)];
    for (int i = degree; i-- > 0;) value = value * t + c[static_cast<std::size_t>(i)];
    return value;
  }
  Polynomial derivative() const {
    Polynomial d{{}, degree - 1};
    for (std::size_t i = 1; i <= static_cast<std::size_t>(degree); ++i)
      d.c[i - 1] = Real(static_cast<double>(i)) * c[i];
    return d;
  }
};

// A few places in [-1, 1].
template <class Real>
struct Places {
  std::array<Real, 16> at;
  std::size_t count = 0;

  void add(const Real& place) { at[count++] = place; }
  const Real* begin() const { return at.data(); }
  const Real* end() const { return at.data() + count; }
};

// The root between lo and hi, where the value's sign changes: Newton's steps where they stay inside, else halving.
template <class Real>
Real root_between(const Polynomial<Real>& polynomial, const Polynomial<Real>& derivative, Real lo, Real hi, bool rises,
                  int bits) {
  using std::abs;
  using std::ldexp;
  const Real least = ldexp(Real(1), -bits);
  Real t = (lo + hi) / Real(2), previous_step = hi - lo;
  for (int i = 0; i < 2 * bits && hi - lo > least; ++i) {
    const Real value = polynomial.value_at(t), slope = derivative.value_at(t);
    if (value == Real(0)) return t;
    ((value < Real(0)) == rises ? lo : hi) = t;
    const Real newton = slope == Real(0) ? hi - lo : -value / slope;
    if (abs(newton) <= least) return t + newton;
    const bool is_good = lo < t + newton && t + newton < hi && abs(newton) * Real(2) <= previous_step;
    Real next = is_good ? t + newton : (lo + hi) / Real(2);
    previous_step = abs(next - t);
    if (previous_step <= least) return next;
    t = next;
  }
  return t;
}

// Places of roots on [-1, 1], and of its derivatives' roots there (a double root shows as one of these). Roots of the
// derivative separate the roots, so each lies in an interval at whose ends the signs differ.
template <class Real>
Places<Real> root_places(const Polynomial<Real>& polynomial, int bits) {
  Places<Real> places;
  if (polynomial.degree < 1) return places;
  const Polynomial<Real> derivative = polynomial.derivative();
  places = root_places(derivative, bits);
  Places<Real> ends = places;
  ends.add(Real(-1));
  ends.add(Real(1));
  std::sort(ends.at.data(), ends.at.data() + ends.count);
  for (std::size_t i = 0; i + 1 < ends.count; ++i) {
    const Real &lo = ends.begin()[i], &hi = ends.begin()[i + 1];
    const bool rises = polynomial.value_at(lo) < Real(0);
    if (rises != (polynomial.value_at(hi) < Real(0)))
      places.add(root_between(polynomial, derivative, lo, hi, rises, bits));
  }
  return places;
}

// Where distance from the eye (the origin, which lies in the plane) is extreme along the conic of plane and cone. With
// phi around the axis from m, a generator g meets the plane at distance s = h / lean from the apex, lean = alpha + beta
// cos phi; setting the derivative of the squared distance to zero,
//   lean' (apex·g lean + h) = apex·g' lean²,
// and tau = tan(phi / 2) gives a quartic without square term. The same equation says s = apex·g' lean / lean' - apex·g,
// which keeps its digits where h / lean loses them: for an apex near the plane, whose generators in the plane have lean
// 0.
template <class Real, class Take>
void conic_extremes(const Volume<Real>& volume, const HalfSpace<Real>& plane, int bits, Take&& take) {
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
  const auto take_generator = [&](const Real& cosine, const Real& sine) {
    const Real lean = alpha + beta * cosine, slope = -beta * sine;
    const Point3<Real> g =
        volume.cos_angle * volume.axis + (volume.sin_angle * cosine) * m + (volume.sin_angle * sine) * m2;
    if (lean * lean < slope * slope) {
      const Real turned = epsilon * cosine - delta * sine;  // apex·g'
      take(volume.apex + (turned * lean / slope - dot(volume.apex, g)) * g);
    } else if (lean != Real(0)) {
      take(volume.apex + (h / lean) * g);
    }
  };
  for (const Real& tau : root_places(quartic, bits)) {
    const Real square = tau * tau;
    take_generator((Real(1) - square) / (Real(1) + square), two * tau / (Real(1) + square));
  }
  for (const Real& inverse : root_places(reversed, bits)) {
    const Real square = inverse * inverse;
    take_generator((square - Real(1)) / (square + Real(1)), two * inverse / (square + Real(1)));
  }
  take_generator(Real(-1), Real(0));
}

// Calls take(point) for all places where pyramid ∩ volume can be nearest to or farthest from the eye. Faces that the
// volume does not reach have no such place on them.
template <class Real, class Take>
void pyramid_candidates(const Volume<Real>& volume, const Pyramid<Real>& pyramid, const std::array<bool, 4>& reached,
                        int bits, Take&& take) {
  const Real zero(0);
  take(Point3<Real>{zero, zero, zero});
  take(volume.apex);
  // Along a direction from the origin to a centre: the near and far end of a ball or of its cut by a plane.
  const auto take_ends = [&](const Point3<Real>& center, const Real& radius) {
    const Real size = length(center);
    if (size == zero) return;
    take(center - (radius / size) * center);
    take(center + (radius / size) * center);
  };
  take_ends(volume.apex, volume.range);
  if (volume.is_cone) {
    generators_towards(volume, volume.apex, [&](const Point3<Real>& g) {
      take(volume.apex - dot(volume.apex, g) * g);
      take(volume.apex + volume.range * g);
    });
    take(volume.apex + volume.range * volume.axis);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const HalfSpace<Real>& face = pyramid.faces[i];
    take(volume.apex - volume.range * face.normal);
    if (!reached[i]) continue;
    const Real height = face.margin(volume.apex);
    const Real square = volume.range * volume.range - height * height;
    // A tangent plane may be computed as just missing the ball: the caller's tolerance decides.
    take_ends(volume.apex + height * face.normal, square < zero ? zero : SquareRoot<Real>::of(square));
    if (!volume.is_cone) continue;
    conic_extremes(volume, face, bits, take);
    plane_on_rim(volume, face, take);
  }
  for (unsigned corner = 0; corner < 4; ++corner) {
    if (!reached[corner & 1] || !reached[2 + (corner >> 1)]) continue;
    const Point3<Real>& ray = pyramid.rays[corner];
    const auto take_at = [&](const Real& t) {
      if (!(t < zero)) take(t * ray);
    };
    line_on_sphere(volume, {zero, zero, zero}, ray, take_at);
    if (volume.is_cone) line_on_cone(volume, {zero, zero, zero}, ray, take_at);
  }
}

}  // namespace clusterbench::geom
