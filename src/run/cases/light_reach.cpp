#include "run/cases/light_reach.h"

#include <algorithm>
#include <cmath>

namespace clusterbench::run {

void LightReach::add(const view::Frame& frame, const std::vector<bool>& in_view) {
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    const scene::WorldLight& light = frame.lights[i];
    if (!std::isfinite(light.range_m) || !(light.range_m > 0.0)) continue;
    add_box(light.position - light.range_m, light.position + light.range_m);
    if (in_view[i]) far_m_ = std::max(far_m_, glm::length(light.position - frame.view_space.origin) + light.range_m);
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
