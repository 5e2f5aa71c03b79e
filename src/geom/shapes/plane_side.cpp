#include "geom/shapes/plane_side.h"

#include <cmath>

#include "geom/numbers/dyadic.h"
#include "geom/numbers/point3.h"

namespace clusterbench::geom {
namespace {

Point3<Dyadic> difference(const Vec3d& a, const Vec3d& b) {
  return {Dyadic(a.x) - Dyadic(b.x), Dyadic(a.y) - Dyadic(b.y), Dyadic(a.z) - Dyadic(b.z)};
}

}  // namespace

int side_of_plane(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& p) {
  const Vec3d u = b - a, v = c - a, w = p - a;
  const double volume = glm::dot(glm::cross(u, v), w);
  // Twice Shewchuk's bound, (7 + 56 u) u times the sum of the products' magnitudes, u = 2^-53; the constant is for
  // products that underflow.
  const Vec3d up = glm::abs(u), vp = glm::abs(v), wp = glm::abs(w);
  const double size =
      wp.x * (up.y * vp.z + up.z * vp.y) + wp.y * (up.z * vp.x + up.x * vp.z) + wp.z * (up.x * vp.y + up.y * vp.x);
  if (std::abs(volume) > 0x1p-49 * size + 0x1p-900) return volume > 0.0 ? 1 : -1;
  return dot(cross(difference(b, a), difference(c, a)), difference(p, a)).sign();
}

}  // namespace clusterbench::geom
