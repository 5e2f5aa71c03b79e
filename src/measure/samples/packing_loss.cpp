#include "measure/samples/packing_loss.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/shapes/angle_between.h"

namespace clusterbench::measure {

void PackingLossMeter::Sum::add(double value) {
  sum += value;
  max = std::max(max, value);
  ++count;
}

MeanMax PackingLossMeter::Sum::result() const {
  constexpr double k_nothing = std::numeric_limits<double>::quiet_NaN();
  if (count == 0) return {k_nothing, k_nothing};
  return {sum / static_cast<double>(count), max};
}

void PackingLossMeter::add_frame(const view::PackedLights& packed) {
  auto unrepresentable = packed.unrepresentable.begin();
  for (std::uint32_t light = 0; light < packed.lights.size(); ++light) {
    const bool is_representable = unrepresentable == packed.unrepresentable.end() || *unrepresentable != light;
    if (!is_representable) ++unrepresentable;
    if (is_representable && std::isfinite(packed.lights.radius[light])) add_light(packed, light);
  }
  unrepresentable_lights_ = std::max<std::uint64_t>(unrepresentable_lights_, packed.unrepresentable.size());
  unrepresentable_frames_ += packed.unrepresentable.empty() ? 0 : 1;
}

void PackingLossMeter::add_light(const view::PackedLights& packed, std::uint32_t light) {
  const view::LightArrays& lights = packed.lights;
  const scene::WorldLight& exact = lights.source[light];
  const Vec3d position{lights.x[light], lights.y[light], lights.z[light]};
  position_.add(glm::length(position - lights.space.rotation * (exact.position - lights.space.origin)));
  range_.add(static_cast<double>(lights.radius[light]) - exact.range_m);
  inflation_.add(packed.bounds[light].inflation_m(lights.radius[light]));
  if (lights.is_spot(light)) add_cone(lights, light);
}

void PackingLossMeter::add_cone(const view::LightArrays& lights, std::uint32_t light) {
  const std::uint32_t spot = light - lights.spots.first;
  const scene::WorldLight& exact = lights.source[light];
  const Vec3d axis{lights.axis_x[spot], lights.axis_y[spot], lights.axis_z[spot]};
  axis_.add(geom::angle_between(axis, lights.space.rotation * exact.direction));
  const double angle =
      std::atan2(static_cast<double>(lights.sin_angle[spot]), static_cast<double>(lights.cos_angle[spot]));
  angle_.add(std::fabs(angle - exact.outer_cone_rad));
}

PackingLoss PackingLossMeter::result() const {
  return {position_.result(),  range_.result(),         axis_.result(),         angle_.result(),
          inflation_.result(), unrepresentable_lights_, unrepresentable_frames_};
}

}  // namespace clusterbench::measure
