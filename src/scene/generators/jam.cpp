// The worst case: many large lights close together in front of the player, as when everything explodes at once.
// Allocations of lists must be large enough for it.

#include "scene/generators/scenes.h"

namespace clusterbench::scene {

void build_jam(Stage& stage, int lights) {
  SplitMix64& random = stage.random();
  for (int i = 0; stage.light_count() < lights; ++i) {
    const Vec3d position = stage.position_in({-30.0, 0.5, -70.0}, {30.0, 20.0, -6.0});
    const Vec3d direction = stage.position_in({-1.0, -1.0, -1.0}, {1.0, 0.2, 1.0});
    const double share = random.unit(), range_m = 15.0 + 45.0 * share * share;
    if (i % 6 == 5)
      stage.spot("beam " + std::to_string(i), position, direction, range_m, random.between(15.0, 70.0));
    else
      stage.point("blast " + std::to_string(i), position, range_m);
  }
  stage.camera(
      "strafe",
      walk({{-8.0, 1.7, 12.0}, {-8.0, 1.7, 4.0}, {-2.0, 1.7, -2.0}, {3.0, 1.7, -14.0}, {0.0, 1.7, -30.0}}, 10.0),
      300.0);
}

}  // namespace clusterbench::scene
