#include <algorithm>
#include <cmath>

#include "scene/scene.h"

namespace clusterbench::scene {

void resolve_range(Light& light, const RangeRule& rule) {
  if (light.type == LightType::directional) return;
  if (light.range_given_m) {
    light.range_m = *light.range_given_m;
    light.range_source = RangeSource::given;
    return;
  }
  // Illuminance of a punctual light at distance d is intensity / d².
  const double brightest = std::max({light.color.x, light.color.y, light.color.z, 0.0});
  const double reach_m = std::sqrt(light.intensity * brightest / rule.cutoff_lux);
  light.range_source = reach_m > rule.max_range_m ? RangeSource::clamped_to_max : RangeSource::from_intensity;
  light.range_m = std::min(reach_m, rule.max_range_m);
}

void resolve_ranges(Scene& scene, const RangeRule& rule) {
  scene.range_rule = rule;
  for (Light& light : scene.lights) resolve_range(light, rule);
}

}  // namespace clusterbench::scene
