#include "geom/light_meets_cell.h"

#include <cmath>

#include "geom/ball/ball_decider.h"
#include "geom/box/box_decider.h"
#include "geom/spot/spot_decider.h"

namespace clusterbench::geom {
namespace {

Verdict decided(const BallVolume& ball, const Cell& cell) {
  return std::isinf(ball.range) || BallDecider(ball.center, ball.range).meets(cell) ? Verdict::yes : Verdict::no;
}

Verdict decided(const SpotVolume& spot, const Cell& cell) {
  return SpotDecider(spot).meets(cell);
}

Verdict decided(const BoxVolume& box, const Cell& cell) {
  return BoxDecider(box).meets(cell) ? Verdict::yes : Verdict::no;
}

Verdict proven(const BoxVolume& box, const Cell& cell) {
  return BoxDecider(box).meets_exactly(cell) ? Verdict::yes : Verdict::no;
}

Verdict proven(const BallVolume& ball, const Cell& cell) {
  return decided(ball, cell);
}

Verdict proven(const SpotVolume& light, const Cell& cell) {
  const SpotDecider spot(light);
  const Verdict verdict = spot.meets_quickly(cell);
  return verdict == Verdict::uncertain ? spot.meets_by_proof(cell) : verdict;
}

}  // namespace

Verdict decide_meets(const LightVolume& light, const Cell& cell) {
  return std::visit([&](const auto& volume) { return decided(volume, cell); }, light);
}

Verdict prove_meets(const LightVolume& light, const Cell& cell) {
  return std::visit([&](const auto& volume) { return proven(volume, cell); }, light);
}

}  // namespace clusterbench::geom
