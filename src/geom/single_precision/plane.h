#pragma once
// A plane in single precision.

#include <cmath>

#include "geom/shapes/vec.h"

namespace clusterbench::geom {

// A plane n·p = offset with unit normal n.
struct Plane {
  Vec3f normal;
  float offset;
};

// |x| + |y| + |z|: the size to which roundoffs of a point's coordinates are relative.
inline float size_of(const Vec3f& p) {
  return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z);
}

}  // namespace clusterbench::geom
