#pragma once
// Boxes against cells by other ways than the decider's, in rational numbers: slow, and short enough to be read.

#include <array>
#include <optional>
#include <vector>

#include "geom/numbers/rational.h"
#include "geom/shapes/light_volume.h"
#include "geom/shapes/placement.h"
#include "geom/shapes/rational_cell.h"

namespace clusterbench::geom {

struct RationalBox {
  RationalPoint middle;
  std::array<RationalPoint, 3> axes;

  explicit RationalBox(const BoxVolume& box) : middle(local_point_in<Rational>(box.center)) {
    for (std::size_t i = 0; i < 3; ++i)
      axes[i] = local_point_in<Rational>({box.half_axes[i], Vec3d(0.0), box.center.rotation});
  }
};

// The point where three planes meet, if they do in one.
inline std::optional<RationalPoint> common_point(const HalfSpace<Rational>& a, const HalfSpace<Rational>& b,
                                                 const HalfSpace<Rational>& c) {
  const RationalPoint bc = cross(b.normal, c.normal), ca = cross(c.normal, a.normal), ab = cross(a.normal, b.normal);
  const Rational all = dot(a.normal, bc);
  if (all.sign() == 0) return std::nullopt;
  return (1 / all) * (a.offset * bc + b.offset * ca + c.offset * ab);
}

// All corners of what the planes bound. A bounded set that is not empty has one.
inline std::vector<RationalPoint> corners_between(const Planes& planes) {
  std::vector<RationalPoint> corners;
  for (std::size_t a = 0; a < planes.size(); ++a)
    for (std::size_t b = a + 1; b < planes.size(); ++b)
      for (std::size_t c = b + 1; c < planes.size(); ++c) {
        const auto p = common_point(planes[a], planes[b], planes[c]);
        if (p && all_hold(planes, *p)) corners.push_back(*p);
      }
  return corners;
}

// The cell's planes in the box's own coordinates, from -1 to 1, which are bounded by planes of their own: whatever the
// half axes are, flat ones too.
inline Planes planes_in_box(const RationalBox& box, const Cell& cell) {
  Planes planes;
  for (const HalfSpace<Rational>& plane : planes_of(cell))
    planes.push_back({{dot(plane.normal, box.axes[0]), dot(plane.normal, box.axes[1]), dot(plane.normal, box.axes[2])},
                      plane.margin(box.middle)});
  for (const int sign : {-1, 1}) {
    planes.push_back({{sign, 0, 0}, 1});
    planes.push_back({{0, sign, 0}, 1});
    planes.push_back({{0, 0, sign}, 1});
  }
  return planes;
}

inline bool oracle_meets_planes(const BoxVolume& box, const Cell& cell) {
  return !corners_between(planes_in_box(RationalBox(box), cell)).empty();
}

// The box's own planes. It must have a volume.
inline void add_box_planes(const RationalBox& box, Planes& planes) {
  for (std::size_t i = 0; i < 3; ++i) {
    RationalPoint normal = cross(box.axes[(i + 1) % 3], box.axes[(i + 2) % 3]);
    if (dot(normal, box.axes[i]).sign() < 0) normal = Rational(-1) * normal;
    const Rational middle = dot(normal, box.middle), half = dot(normal, box.axes[i]);
    planes.push_back({normal, middle + half});
    planes.push_back({Rational(-1) * normal, half - middle});
  }
}

// Against a cell between shells: the nearest point to the eye of what all planes bound is the eye, the eye's foot on a
// plane or on a line of two, or a corner; the farthest one a corner.
inline bool oracle_meets_shells(const BoxVolume& volume, const ShellCell& cell) {
  Planes planes = planes_of(cell);
  add_box_planes(RationalBox(volume), planes);
  std::vector<RationalPoint> near = corners_between(planes);
  if (near.empty()) return false;
  Rational far = 0;
  for (const RationalPoint& corner : near) far = std::max(far, dot(corner, corner));
  near.push_back({0, 0, 0});
  for (std::size_t a = 0; a < planes.size(); ++a) {
    const RationalPoint& n = planes[a].normal;
    near.push_back((planes[a].offset / dot(n, n)) * n);
    for (std::size_t b = a + 1; b < planes.size(); ++b) {
      const RationalPoint along = cross(n, planes[b].normal);
      if (const auto foot = common_point(planes[a], planes[b], {along, 0})) near.push_back(*foot);
    }
  }
  std::optional<Rational> nearest;
  for (const RationalPoint& p : near)
    if (all_hold(planes, p) && (!nearest || dot(p, p) < *nearest)) nearest = dot(p, p);
  return *nearest <= squared(exact(cell.distance1)) && far >= squared(exact(cell.distance0));
}

inline bool oracle_meets(const BoxVolume& box, const Cell& cell) {
  if (const auto* shell = std::get_if<ShellCell>(&cell)) return oracle_meets_shells(box, *shell);
  return oracle_meets_planes(box, cell);
}

}  // namespace clusterbench::geom
