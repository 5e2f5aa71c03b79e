#pragma once
// The shortest vector between two convex sets, in doubles, after Gilbert, Johnson and Keerthi 1988, "A fast procedure
// for computing the distance between complex objects in three-dimensional space". The result is a proposal, not a
// proof.

#include <array>
#include <limits>

#include "geom/numbers/point3.h"

namespace clusterbench::geom {

// Up to four points of the sets' difference, and the point of their hull that is nearest to the origin.
class GjkSimplex {
 public:
  using Point = Point3<double>;

  const Point& nearest() const { return nearest_; }

  // Adds a point, then keeps only the points whose weighted mean is the nearest point. False if the new point does not
  // come nearer.
  bool add(const Point& p) {
    points_[count_++] = p;
    const double before = least_;
    least_ = std::numeric_limits<double>::infinity();
    unsigned best = 0;
    for (unsigned subset = 1; subset < (1u << count_); ++subset) {
      Point q;
      if (!nearest_of(subset, q) || !(dot(q, q) < least_)) continue;
      least_ = dot(q, q);
      best = subset;
      nearest_ = q;
    }
    unsigned kept = 0;
    for (unsigned i = 0; i < count_; ++i)
      if ((best >> i & 1) != 0) points_[kept++] = points_[i];
    count_ = kept;
    return count_ < 4 && least_ < before;
  }

 private:
  // The foot of the origin on the span of these points, if it lies between them.
  bool nearest_of(unsigned subset, Point& foot) const {
    std::array<Point, 4> p{};
    unsigned n = 0;
    for (unsigned i = 0; i < count_; ++i)
      if ((subset >> i & 1) != 0) p[n++] = points_[i];
    foot = p[0];
    if (n == 1) return true;
    const Point a = p[1] - p[0];
    if (n == 2) {
      const double t = -dot(p[0], a) / dot(a, a);
      foot = p[0] + t * a;
      return t > 0.0 && t < 1.0;
    }
    const Point b = p[2] - p[0], normal = cross(a, b);
    if (n == 3) {
      const double square = dot(normal, normal);
      const double s = -dot(cross(p[0], b), normal) / square, t = -dot(cross(a, p[0]), normal) / square;
      foot = p[0] + s * a + t * b;
      return s > 0.0 && t > 0.0 && s + t < 1.0;
    }
    const Point c = p[3] - p[0];
    const double volume = dot(normal, c);
    const double r = -dot(cross(p[0], b), c) / volume, s = -dot(cross(a, p[0]), c) / volume,
                 t = -dot(normal, p[0]) / volume;
    foot = {0.0, 0.0, 0.0};
    return r > 0.0 && s > 0.0 && t > 0.0 && r + s + t < 1.0;
  }

  std::array<Point, 4> points_{};
  unsigned count_ = 0;
  double least_ = std::numeric_limits<double>::infinity();  // squared, of the nearest
  Point nearest_{0.0, 0.0, 0.0};
};

// Calls accept(direction) for directions with a gap, from the first set to the second, until it returns true. least(n):
// the point p - q of the sets' difference, q of the first and p of the second, where n·(p - q) is least.
template <class Least, class Accept>
bool try_separating_directions(const Point3<double>& start, Least&& least, Accept&& accept) {
  GjkSimplex simplex;
  Point3<double> n = start;
  constexpr int k_most_steps = 24;
  for (int i = 0; i < k_most_steps; ++i) {
    const Point3<double> p = least(n);
    if (dot(n, p) > 0.0 && accept(n)) return true;
    if (!simplex.add(p)) return false;
    n = simplex.nearest();
  }
  return false;
}

}  // namespace clusterbench::geom
