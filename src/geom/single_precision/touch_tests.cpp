#include "geom/single_precision/touch_tests.h"

#include <cmath>

namespace clusterbench::geom {

bool ball_touches_box(const Ball& ball, const Box& box) {
  const Vec3f gap = glm::max(Vec3f(0.0f), glm::max(box.lo - ball.center, ball.center - box.hi));
  return gap.x * gap.x + gap.y * gap.y + gap.z * gap.z <= ball.radius * ball.radius;
}

bool ball_touches_planes(const Ball& ball, const Plane* planes, int count) {
  for (int i = 0; i < count; ++i)
    if (glm::dot(planes[i].normal, ball.center) - planes[i].offset > ball.radius) return false;
  return true;
}

bool cone_touches_ball(const SphericalCone& cone, const Ball& ball) {
  if (std::isinf(ball.radius)) return true;
  const Vec3f to_center = ball.center - cone.apex;
  const float along = glm::dot(to_center, cone.axis);
  // The part across the axis, as a vector: |V|² - along² would lose half of the digits.
  const float across = glm::length(to_center - along * cone.axis);
  // In unit roundoffs of |V|: the difference V is off by 1, a rounded axis by 1, the sum of products by 3, so `along`
  // by 5; `across` by these, two more steps and a root: 10. cos a * across - sin a * along is then off by at most
  // sqrt(10² + 5²) + 4 = 16.
  constexpr float k_slack = 0x1p-20f;
  const float reach = ball.radius + k_slack * (size_of(cone.apex) + size_of(ball.center));
  const bool beside = cone.cos_angle * across - cone.sin_angle * along > reach;
  const bool beyond = along > cone.range + reach || glm::length(to_center) > cone.range + reach;
  const bool behind = along < -reach;
  return !beside && !beyond && !behind;
}

}  // namespace clusterbench::geom
