// A deep, narrow street: two rows of lamps, lit shop windows, signs. Long lists along few columns of cells. Some of the
// signs have no range, as artists' lights often do.

#include "scene/generators/scenes.h"

namespace clusterbench::scene {

void build_street(Stage& stage, int lights) {
  constexpr double k_half_width = 7.0, k_length = 320.0;
  SplitMix64& random = stage.random();
  for (int i = 0; i < 54; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const Vec3d lamp{side * 4.5, 6.0, -k_length * i / 54.0};
    const std::string name = "lamp " + std::to_string(i);
    if (i % 4 < 2)
      stage.spot(name, lamp, {-0.15 * side, -1.0, 0.0}, 13.0, 65.0);
    else
      stage.point(name, lamp, 9.5);
  }
  for (int i = 0; i < 12; ++i)
    stage.point("sign " + std::to_string(i), stage.position_in({-6.5, 3.0, -k_length}, {6.5, 9.0, 0.0}), 0.0);
  for (int i = 0; i < 16; ++i)
    stage.spot("traffic " + std::to_string(i), {i % 2 == 0 ? 1.8 : -1.8, 0.7, -20.0 * i - 5.0},
               {0.0, -0.05, i % 2 == 0 ? 1.0 : -1.0}, 32.0, 12.0);
  for (int i = 0; i < 8; ++i)
    stage.spot("facade " + std::to_string(i), {i % 2 == 0 ? 6.8 : -6.8, 0.3, -40.0 * i - 12.0}, {0.0, 1.0, 0.0}, 22.0,
               i % 4 == 0 ? 90.0 : 20.0);
  for (int i = 0; stage.light_count() < lights; ++i) {
    const double x = (random.below(2) == 0 ? 1.0 : -1.0) * (k_half_width - 0.3);
    const Vec3d position = stage.position_in({x, 1.0, -k_length}, {x, 14.0, 0.0});
    stage.point("window " + std::to_string(i), position, random.between(2.0, 5.0));
  }
  stage.camera(
      "walk",
      walk({{2.0, 1.7, 6.0}, {2.0, 1.7, -90.0}, {-2.0, 1.7, -140.0}, {-2.0, 2.5, -220.0}, {0.0, 1.7, -300.0}}, 15.0),
      400.0);
}

}  // namespace clusterbench::scene
