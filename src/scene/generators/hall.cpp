// DaveH355's rig: point lights of one radius, anywhere in XZ ±100 and Y 0..55.

#include "scene/generators/scenes.h"

namespace clusterbench::scene {

void build_hall(Stage& stage, int lights, double range_m) {
  for (int i = 0; i < lights; ++i)
    stage.point("light " + std::to_string(i), stage.position_in({-100.0, 0.0, -100.0}, {100.0, 55.0, 100.0}), range_m);
  constexpr double k_eye = 4.0;
  stage.camera("walk",
               walk({{70, k_eye, 90},
                     {70, k_eye, -20},
                     {20, k_eye, -70},
                     {-60, 12.0, -60},
                     {-80, 20.0, 10},
                     {-30, 12.0, 60},
                     {40, k_eye, 40},
                     {60, k_eye, 0}},
                    16.0),
               400.0);
}

}  // namespace clusterbench::scene
