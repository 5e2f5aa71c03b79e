#include <algorithm>
#include <cmath>

#include "geom/shapes/domain.h"
#include "scene/scene.h"

namespace clusterbench::scene {
namespace {

// Warns of ranges that the domain changes, in one line for all of a kind.
void warn_of_ranges_beyond_the_domain(Scene& scene) {
  const auto warn = [&](const std::string& problem, auto&& is_meant) {
    std::size_t count = 0;
    std::string first;
    for (const Light& light : scene.lights)
      if (light.type != LightType::box && std::isfinite(light.range_m) && light.range_m > 0.0 &&
          is_meant(geom::range_in_domain(light.range_m)) && count++ == 0)
        first = light.name;
    if (count > 0)
      scene.warnings.push_back(std::to_string(count) + (count == 1 ? " light" : " lights") + problem +
                               (count == 1 ? ": '" : ": first '") + first + "'");
  };
  warn(" with a range above 1e15 m, taken as endless", [](double range) { return std::isinf(range); });
  warn(" with a range below 1e-15 m, taken as none", [](double range) { return range == 0.0; });
}

}  // namespace

void resolve_range(Light& light, const RangeRule& rule) {
  if (light.type == LightType::directional || light.type == LightType::box) return;
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
  warn_of_ranges_beyond_the_domain(scene);
}

}  // namespace clusterbench::scene
