#pragma once
// A box's faces clipped by planes, over numbers whose sign may be unknown.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geom/box/box_decider.h"
#include "geom/numbers/bounded_double.h"
#include "geom/numbers/point3.h"
#include "geom/numbers/rational.h"
#include "geom/shapes/polytope.h"

namespace clusterbench::geom {

enum class Sign { negative, zero, positive, unknown };

inline Sign sign_of(const Bounded& number) {
  if (number.is_surely_above(0.0)) return Sign::positive;
  if ((-number).is_surely_above(0.0)) return Sign::negative;
  return number.error == 0.0 ? Sign::zero : Sign::unknown;
}
inline Sign sign_of(const Rational& number) {
  return number.sign() > 0 ? Sign::positive : number.sign() < 0 ? Sign::negative : Sign::zero;
}

// Bounds of a number that is certainly not negative. They are two roundings away from value ± error.
inline double lower_bound(const Bounded& number) {
  if (number.error == 0.0) return number.value;
  return std::max(0.0, number.value - number.error - 0x1p-50 * (std::abs(number.value) + number.error));
}
inline double upper_bound(const Bounded& number) {
  if (number.error == 0.0) return number.value;
  return number.value + number.error + 0x1p-50 * (std::abs(number.value) + number.error);
}
inline const Rational& lower_bound(const Rational& number) {
  return number;
}
inline const Rational& upper_bound(const Rational& number) {
  return number;
}
template <class Real>
struct BoundOf;
template <>
struct BoundOf<Bounded> {
  using Type = double;
};
template <>
struct BoundOf<Rational> {
  using Type = Rational;
};

// A list of up to `most` elements, without heap memory.
template <class T, std::size_t most>
class Few {
 public:
  void push_back(const T& value) { all_[count_++] = value; }
  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  const T& operator[](std::size_t i) const { return all_[i]; }
  const T* begin() const { return all_.data(); }
  const T* end() const { return all_.data() + count_; }

 private:
  std::array<T, most> all_{};
  std::size_t count_ = 0;
};

// The planes of a cell; for a cell between shells, of its pyramid. The numbers are the cell's own, so normals are not
// of unit length. `inside` is a point of the cell, for a pyramid its apex.
struct CellPlanes {
  static constexpr std::size_t k_most = 6;
  Few<HalfSpace<double>, k_most> all;
  Point3<double> inside;
};

template <class Real>
Point3<Real> converted(const Point3<double>& p) {
  return {Real(p.x), Real(p.y), Real(p.z)};
}

// Rotates position - origin (or a direction).
template <class Real>
Point3<Real> turned(const Mat3d& rotation, const Vec3d& position, const Vec3d& origin) {
  const Real x = Real(position.x) - Real(origin.x), y = Real(position.y) - Real(origin.y),
             z = Real(position.z) - Real(origin.z);
  const auto row = [&](int i) {
    return Real(rotation[0][i]) * x + Real(rotation[1][i]) * y + Real(rotation[2][i]) * z;
  };
  return {row(0), row(1), row(2)};
}

// Every result holds only if no sign was unknown on the way: is_certain().
template <class Real>
class ClippedBox {
 public:
  using Point = Point3<Real>;
  using Bound = typename BoundOf<Real>::Type;

  ClippedBox(const BoxVolume& box, const CellPlanes& planes)
      : middle_(turned<Real>(box.center.rotation, box.center.position, box.center.origin)) {
    for (std::size_t i = 0; i < 3; ++i) axes_[i] = turned<Real>(box.center.rotation, box.half_axes[i], Vec3d(0.0));
    for (unsigned i = 0; i < 8; ++i) corners_[i] = corner(i);
    find_cutting(planes);
    inside_ = converted<Real>(planes.inside);
  }

  bool is_certain() const { return is_certain_; }

  // Yes as soon as one part certainly shares a point, even if other parts are uncertain.
  bool shares_a_point() {
    if (is_beside_) return false;
    bool is_all_certain = true;
    const auto surely = [&](bool shares) {
      if (shares && is_certain_) return true;
      is_all_certain = is_all_certain && is_certain_;
      is_certain_ = true;
      return false;
    };
    for (unsigned face = 0; face < 6; ++face)
      if (!is_second(face) && surely(!clipped(face).empty())) return true;
    if (surely(holds(inside_))) return true;
    is_certain_ = is_all_certain;
    return false;
  }

  SquaredReach<Bound> squared_reach() {
    SquaredReach<Bound> reach;
    if (is_beside_) return reach;
    for (unsigned face = 0; face < 6; ++face)
      if (!is_second(face)) add_reach(clipped(face), face / 2, reach);
    if (!reach.is_empty && holds(inside_)) reach.near_lo = reach.near_hi = Bound(0);
    return reach;
  }

 private:
  static constexpr std::size_t k_most_corners = 4 + CellPlanes::k_most;  // each plane adds at most one
  using Polygon = Few<Point, k_most_corners>;
  struct Plane {
    Point normal;
    Real offset;
  };

  Point corner(unsigned bits) const {
    Point at = middle_;
    for (unsigned i = 0; i < 3; ++i) at = (bits >> i & 1) != 0 ? at + axes_[i] : at - axes_[i];
    return at;
  }

  Sign sign(const Real& number) {
    const Sign found = sign_of(number);
    if (found == Sign::unknown) is_certain_ = false;
    return found;
  }

  // Keeps the planes that cut the box. A plane with the whole box outside leaves nothing.
  void find_cutting(const CellPlanes& planes) {
    for (const HalfSpace<double>& given : planes.all) {
      const Plane plane{converted<Real>(given.normal), Real(given.offset)};
      int inside = 0, outside = 0;
      for (const Point& at : corners_) {
        const Sign side = sign_of(plane.offset - dot(plane.normal, at));
        outside += side == Sign::negative ? 1 : 0;
        inside += side == Sign::positive || side == Sign::zero ? 1 : 0;
      }
      if (outside == 8) is_beside_ = true;
      if (inside < 8) cutting_.push_back(plane);
    }
  }

  bool has_length(std::size_t axis) const {
    const auto is_zero = [](const Real& number) { return sign_of(number) == Sign::zero; };
    const Point& along = axes_[axis];
    return !is_zero(along.x) || !is_zero(along.y) || !is_zero(along.z);
  }
  // Is the face equal to its opposite face, which comes first?
  bool is_second(unsigned face) const { return face % 2 == 1 && !has_length(face / 2); }

  // The part of a face that all planes leave, as corners in order. A face without area becomes a segment or a point,
  // without repeated corners.
  Polygon clipped(unsigned face) {
    const unsigned axis = face / 2, side = (face % 2) << axis;
    const unsigned next = has_length((axis + 1) % 3) ? 1u << (axis + 1) % 3 : 0,
                   other = has_length((axis + 2) % 3) ? 1u << (axis + 2) % 3 : 0;
    Polygon polygon;
    polygon.push_back(corners_[side]);
    if (next != 0) polygon.push_back(corners_[side | next]);
    if (next != 0 && other != 0) polygon.push_back(corners_[side | next | other]);
    if (other != 0) polygon.push_back(corners_[side | other]);
    for (const Plane& plane : cutting_) {
      if (polygon.empty()) break;
      polygon = clipped(polygon, plane);
    }
    return polygon;
  }

  Polygon clipped(const Polygon& polygon, const Plane& plane) {
    Polygon out;
    Few<Real, k_most_corners> margins;
    Few<Sign, k_most_corners> sides;
    for (const Point& at : polygon) {
      margins.push_back(plane.offset - dot(plane.normal, at));
      sides.push_back(sign(margins[margins.size() - 1]));
    }
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::size_t next = (i + 1) % polygon.size();
      if (sides[i] != Sign::negative) out.push_back(polygon[i]);
      const bool crosses = (sides[i] == Sign::negative && sides[next] == Sign::positive) ||
                           (sides[i] == Sign::positive && sides[next] == Sign::negative);
      if (!crosses) continue;
      const Real share = margins[i] / (margins[i] - margins[next]);
      out.push_back(polygon[i] + share * (polygon[next] - polygon[i]));
    }
    return out;
  }

  // Is the point in the box? Always false for a box without volume, because it consists of its faces.
  bool holds(const Point& p) {
    const Point from_middle = p - middle_;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point normal = cross(axes_[(i + 1) % 3], axes_[(i + 2) % 3]);
      Real half = dot(normal, axes_[i]);
      const Sign side = sign(half);
      if (side == Sign::zero || side == Sign::unknown) return false;
      if (side == Sign::negative) half = -half;
      const Real along = dot(normal, from_middle);
      if (sign(half - along) == Sign::negative || sign(half + along) == Sign::negative) return false;
    }
    return true;
  }

  void add_reach(const Polygon& polygon, std::size_t axis, SquaredReach<Bound>& reach) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
      const Real square = dot(from, from);
      add_near(square, reach);
      reach.far_lo = std::max<Bound>(reach.far_lo, lower_bound(square));
      reach.far_hi = std::max<Bound>(reach.far_hi, upper_bound(square));
      if (polygon.size() > 1) add_edge(from, to - from, reach);
    }
    if (polygon.size() > 2) add_face(polygon, axis, reach);
  }

  void add_near(const Real& square, SquaredReach<Bound>& reach) {
    const bool is_first = reach.is_empty;
    reach.is_empty = false;
    reach.near_lo = is_first ? Bound(lower_bound(square)) : std::min<Bound>(reach.near_lo, lower_bound(square));
    reach.near_hi = is_first ? Bound(upper_bound(square)) : std::min<Bound>(reach.near_hi, upper_bound(square));
  }

  // The foot of the eye's perpendicular on an edge, if it lies between the ends.
  void add_edge(const Point& from, const Point& edge, SquaredReach<Bound>& reach) {
    const Real towards = -dot(from, edge), whole = dot(edge, edge);
    if (sign(towards) != Sign::positive || sign(whole - towards) != Sign::positive) return;
    add_near(dot(from, from) - towards * towards / whole, reach);
  }

  // The foot of the eye's perpendicular on a face's plane, if it lies in the remaining part of the face: on the same
  // side of all edges.
  void add_face(const Polygon& polygon, std::size_t axis, SquaredReach<Bound>& reach) {
    const Point normal = cross(axes_[(axis + 1) % 3], axes_[(axis + 2) % 3]);
    int before = 0, behind = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Sign side = sign(dot(normal, cross(polygon[i], polygon[(i + 1) % polygon.size()])));
      before += side == Sign::positive ? 1 : 0;
      behind += side == Sign::negative ? 1 : 0;
    }
    if ((before == 0) == (behind == 0)) return;
    const Real height = dot(normal, polygon[0]);
    add_near(height * height / dot(normal, normal), reach);
  }

  Point middle_;
  std::array<Point, 3> axes_;
  std::array<Point, 8> corners_;  // by the bits 1, 2 and 4 of the index: the positive side of each axis
  Few<Plane, CellPlanes::k_most> cutting_;
  Point inside_;
  bool is_beside_ = false, is_certain_ = true;
};

}  // namespace clusterbench::geom
