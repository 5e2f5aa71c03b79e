#include "geom/box/quick_box.h"

#include <cmath>

namespace clusterbench::geom {

QuickBox::QuickBox(const BoxVolume& box, const Vec3d& middle_at)
    : middle_(middle_at),
      slack_(0x1p-30 * (std::abs(middle_.x) + std::abs(middle_.y) + std::abs(middle_.z) + box.range)) {
  std::array<Vec3d, 3> axes;
  for (std::size_t i = 0; i < 3; ++i) axes[i] = box.center.rotation * box.half_axes[i];
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d &next = axes[(i + 1) % 3], &other = axes[(i + 2) % 3];
    const Vec3d normal = glm::cross(next, other);
    const double size = glm::length(normal), most = glm::length(next) * glm::length(other);
    // For half axes that are nearly parallel, double precision loses too many digits.
    if (!(size > 0x1p-10 * most) || !std::isnormal(size)) {
      has_volume_ = false;
      continue;
    }
    across_[i] = normal / size;
    for (const Vec3d& axis : axes) extent_[i] += std::abs(glm::dot(across_[i], axis));
  }
}

bool QuickBox::surely_misses(const Vec3d& center, double radius) const {
  const Vec3d v = center - middle_;
  const double reach = radius * (1.0 + 0x1p-30) + rounding(v);
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(glm::dot(across_[i], v)) > extent_[i] + reach) return true;
  return false;
}

bool QuickBox::surely_holds(const Vec3d& p) const {
  if (!has_volume_) return false;
  const Vec3d v = p - middle_;
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::abs(glm::dot(across_[i], v)) < extent_[i] - rounding(v))) return false;
  return true;
}

}  // namespace clusterbench::geom
