#include "geom/light_meets_cell.h"

#include <cmath>

#include "geom/ball/ball_decider.h"
#include "geom/spot/spot_decider.h"

namespace clusterbench::geom {

Verdict decide_meets(const LightVolume& light, const Cell& cell) {
  return light.is_cone ? SpotDecider(light).meets(cell) : prove_meets(light, cell);
}

Verdict prove_meets(const LightVolume& light, const Cell& cell) {
  if (light.is_cone) {
    const SpotDecider spot(light);
    const Verdict verdict = spot.meets_quickly(cell);
    return verdict == Verdict::uncertain ? spot.meets_after_all(cell) : verdict;
  }
  return std::isinf(light.range) || BallDecider(light.apex, light.range).meets(cell) ? Verdict::yes : Verdict::no;
}

}  // namespace clusterbench::geom
