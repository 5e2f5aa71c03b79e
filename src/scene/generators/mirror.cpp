// Lights all around a camera that turns: as many behind it as in front of it. Reflections need those too, so methods
// that cover only the view frustum do not help them.

#include "scene/generators/scenes.h"

namespace clusterbench::scene {

void build_mirror(Stage& stage, int lights) {
  SplitMix64& random = stage.random();
  for (int i = 0; stage.light_count() < lights; ++i) {
    const Vec3d position = stage.position_in({-80.0, 0.5, -80.0}, {80.0, 18.0, 80.0});
    const Vec3d direction = stage.position_in({-1.0, -1.0, -1.0}, {1.0, 0.3, 1.0});
    const double beam_m = random.between(8.0, 30.0), beam_deg = random.between(15.0, 60.0);
    if (i % 4 == 3)
      stage.spot("beam " + std::to_string(i), position, direction, beam_m, beam_deg);
    else
      stage.point("lamp " + std::to_string(i), position, random.between(4.0, 20.0));
  }
  constexpr double k_eighth_turn = 0.78539816339744831;
  std::vector<PathKey> keys;
  for (int i = 0; i <= 8; ++i) keys.push_back({2.0 * i, {0.5 * i, 1.7, -0.5 * i}, k_eighth_turn * i});
  stage.camera("turn", keys, 250.0);
}

}  // namespace clusterbench::scene
