#include "run/cases/light_reach.h"

#include <algorithm>
#include <cmath>

#include "grid/lights_in_view.h"

namespace clusterbench::run {

void LightReach::add(const view::Frame& frame) {
  for (const scene::WorldLight& light : frame.lights) {
    if (!std::isfinite(light.range_m) || !(light.range_m > 0.0)) continue;
    add_box(light.position - light.range_m, light.position + light.range_m);
    if (grid::is_in_view(frame, light))
      far_m_ = std::max(far_m_, glm::length(light.position - frame.view_space.origin) + light.range_m);
  }
}

void LightReach::add(const LightReach& other) {
  if (!other.is_empty_) add_box(other.lo_, other.hi_);
  far_m_ = std::max(far_m_, other.far_m_);
}

void LightReach::add_box(const Vec3d& lo, const Vec3d& hi) {
  lo_ = is_empty_ ? lo : glm::min(lo_, lo);
  hi_ = is_empty_ ? hi : glm::max(hi_, hi);
  is_empty_ = false;
}

}  // namespace clusterbench::run
