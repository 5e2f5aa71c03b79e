#pragma once
// An oriented box in double precision: a filter that decides most cells and points.

#include <array>

#include "geom/shapes/light_volume.h"
#include "geom/shapes/vec.h"

namespace clusterbench::geom {

// The normals of its faces, and its extent along each.
class QuickBox {
 public:
  // middle_at: the middle in the cells' space.
  QuickBox(const BoxVolume& box, const Vec3d& middle_at);

  // Is a ball beyond a face? The proof holds for any direction, however it was computed.
  bool surely_misses(const Vec3d& center, double radius) const;
  bool surely_holds(const Vec3d& p) const;

 private:
  double rounding(const Vec3d& from_middle) const { return 0x1p-30 * glm::length(from_middle) + slack_; }

  Vec3d middle_;
  std::array<Vec3d, 3> across_{};  // unit length, or 0 where the direction is not usable
  std::array<double, 3> extent_{};
  bool has_volume_ = true;  // more than rounding errors
  double slack_;
};

}  // namespace clusterbench::geom
