// The massive worst case: many large lights jammed in front of the player, as when everything explodes at once. What a
// list allocation has to survive.

#include "scene/generators/scenes.h"

namespace clusterbench::scene {

void build_jam(Stage& stage, int lights) {
  SplitMix64& random = stage.random();
  for (int i = 0; stage.light_count() < lights; ++i) {
    const Vec3d place = stage.place_in({-30.0, 0.5, -70.0}, {30.0, 20.0, -6.0});
    const double range = 15.0 + 45.0 * random.unit() * random.unit();
    if (i % 6 == 5)
      stage.spot("beam " + std::to_string(i), place,
                 {random.between(-1.0, 1.0), random.between(-1.0, 0.2), random.between(-1.0, 1.0)}, range,
                 random.between(15.0, 70.0));
    else
      stage.point("blast " + std::to_string(i), place, range);
  }
  stage.camera(
      "strafe",
      walk({{-8.0, 1.7, 12.0}, {-8.0, 1.7, 4.0}, {-2.0, 1.7, -2.0}, {3.0, 1.7, -14.0}, {0.0, 1.7, -30.0}}, 10.0),
      300.0);
}

}  // namespace clusterbench::scene
