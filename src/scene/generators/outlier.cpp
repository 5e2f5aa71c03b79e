// A small village and two outliers: a light a thousand kilometres away, and one with a range of a hundred kilometres. A
// world grid around all lights has no resolution left for the village.

#include "scene/generators/scenes.h"

namespace clusterbench::scene {

void build_outlier(Stage& stage, int lights) {
  SplitMix64& random = stage.random();
  stage.point("forgotten at the horizon", {1.0e6, 20.0, -3.0e5}, 25.0);
  stage.point("a sun made as a point", {0.0, 900.0, -2000.0}, 1.0e5);
  for (int i = 0; stage.light_count() < lights; ++i) {
    const Vec3d position = stage.position_in({-30.0, 1.0, -60.0}, {30.0, 6.0, 0.0});
    const double yard_m = random.between(8.0, 16.0), yard_deg = random.between(25.0, 60.0);
    if (i % 5 == 4)
      stage.spot("yard " + std::to_string(i), position, {0.1, -1.0, 0.2}, yard_m, yard_deg);
    else
      stage.point("lamp " + std::to_string(i), position, random.between(3.0, 9.0));
  }
  stage.camera("walk", walk({{0.0, 1.7, 12.0}, {4.0, 1.7, -20.0}, {-6.0, 1.7, -45.0}, {-20.0, 1.7, -50.0}}, 12.0),
               300.0);
}

}  // namespace clusterbench::scene
