#pragma once
// The content of `scene info`.

#include <string>
#include <vector>

#include "scene/scene.h"

namespace clusterbench::scene {

struct Summary {
  int points = 0, spots = 0, directionals = 0, boxes = 0;
  int ranges_given = 0, ranges_from_intensity = 0, ranges_clamped = 0;
  double range_min_m = 0.0, range_median_m = 0.0, range_max_m = 0.0;  // of all assigned lights
  double made_range_min_m = 0.0, made_range_max_m = 0.0;              // of the lights whose range comes from the rule
  Vec3d bounds_lo{0.0}, bounds_hi{0.0};                               // of the bounded lights' balls over the animation
  std::vector<std::string> cameras;                                   // a line each: name, projection, path
  // the loader's, and: light without range, range so large that clustering is useless, black or zero-range light, light
  // that no camera reaches
  std::vector<std::string> warnings;
};

// Call after resolve_ranges().
Summary summarise(const Scene& scene);

}  // namespace clusterbench::scene
