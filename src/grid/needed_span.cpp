#include "grid/needed_span.h"

#include <algorithm>
#include <cmath>

#include "grid/lights_in_view.h"

namespace clusterbench::grid {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

double along(const Vec3d& point, bool by_distance) {
  return by_distance ? std::sqrt(point.x * point.x + point.y * point.y + point.z * point.z) : -point.z;
}

// The reach of a ball, cut by a cone around its centre, in a direction at this angle to the cone's axis, in radii.
double reach_of_cone(double angle_rad, double half_angle_rad) {
  constexpr double k_right_angle = 1.57079632679489661923;
  const double beside = angle_rad - half_angle_rad;
  if (beside <= 0.0) return 1.0;
  return beside < k_right_angle ? std::cos(beside) : 0.0;
}

// Depths or distances of one light. A spot's depths are those of its cone, capped by its ball.
Span span_of(const view::Frame& frame, const scene::WorldLight& light, const Vec3d& center, bool by_distance) {
  const double middle = along(center, by_distance), r = light.range_m;
  if (!by_distance && light.type == scene::LightType::box) {
    double reach = 0.0;
    for (const Vec3d& axis : light.half_axes_m) reach += std::abs((frame.view_space.rotation * axis).z);
    return {middle - reach, middle + reach};
  }
  if (by_distance || light.type != scene::LightType::spot) return {middle - r, middle + r};
  const double cosine = -(frame.view_space.rotation * light.direction).z;
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
  constexpr double k_straight_angle = 3.14159265358979323846;
  return {middle - r * reach_of_cone(k_straight_angle - angle, light.outer_cone_rad),
          middle + r * reach_of_cone(angle, light.outer_cone_rad)};
}

void include(Span& span, const Span& other) {
  span.near_m = std::min(span.near_m, other.near_m);
  span.far_m = std::max(span.far_m, other.far_m);
}

// The powers of `step` next to a positive number, by multiplication only: the same on every machine.
struct Rungs {
  double below, above;
};

Rungs rungs_around(double value, double step) {
  double rung = 1.0;
  while (rung > value) rung /= step;
  while (rung * step <= value) rung *= step;
  return {rung, rung < value ? rung * step : rung};
}

Span snapped(const Span& span, double step) {
  if (step <= 1.0 || span.is_empty()) return span;
  Span out = span;
  if (span.near_m > 0.0) out.near_m = rungs_around(span.near_m, step).below;
  if (span.far_m > 0.0) out.far_m = rungs_around(span.far_m, step).above;
  return out;
}

}  // namespace

Span Span::within(const Span& other) const {
  const Span common{std::max(near_m, other.near_m), std::min(far_m, other.far_m)};
  return common.is_empty() ? Span{} : common;
}

const char* name_of(Fit::To to) {
  constexpr const char* k_names[] = {"lights", "surfaces", "both", "ranges"};
  return k_names[static_cast<int>(to)];
}

Span span_of_lights(const view::Frame& frame, bool by_distance) {
  Span span;
  const ViewPlanes planes(frame.projection);
  for (const scene::WorldLight& light : frame.lights) {
    if (!(light.range_m > 0.0)) continue;
    if (!std::isfinite(light.range_m)) return {-k_infinity, k_infinity};
    const Vec3d center = in_view_space(frame, light);
    const double slack = slack_of(center, light.range_m);
    if (!planes.may_see(center, light.range_m + slack)) continue;
    const Span own = span_of(frame, light, center, by_distance);
    include(span, {own.near_m - slack, own.far_m + slack});
  }
  return span;
}

Span span_of_surfaces(const view::Frame& frame, const depth::DepthImage& depths, bool by_distance) {
  Span span;
  for (std::size_t i = 0; i < depths.nearest.size(); ++i) {
    const auto depth = static_cast<double>(depths.nearest[i]);
    if (!std::isfinite(depth)) continue;
    const double at = by_distance ? along(view::picture_ray(frame, depths.pixels.pixel(i)).at(depth), true) : depth;
    include(span, {at, at});
  }
  return span;
}

Span needed_span(const Fit& fit, const view::Frame& frame, const depth::DepthImage* depths, bool by_distance) {
  if (fit.to == Fit::To::lights) return span_of_lights(frame, by_distance);
  if (fit.to == Fit::To::ranges) return span_of_balls(frame, by_distance);
  const Span surfaces = depths == nullptr ? Span{} : span_of_surfaces(frame, *depths, by_distance);
  return fit.to == Fit::To::surfaces ? surfaces : surfaces.within(span_of_lights(frame, by_distance));
}

Span span_of_balls(const view::Frame& frame, bool by_distance) {
  Span span{k_infinity, 0.0};
  const ViewPlanes planes(frame.projection);
  for (const scene::WorldLight& light : frame.lights) {
    if (light.range_m == 0.0 || !std::isfinite(light.range_m)) continue;
    const Vec3d center = in_view_space(frame, light);
    const double middle = along(center, by_distance);
    if (planes.may_see(center, light.range_m)) include(span, {middle - light.range_m, middle + light.range_m});
  }
  return span;
}

Span SpanFollower::next(const Span& needed) {
  if (needed.is_empty()) {
    if (fit_.damping == 0.0) held_ = {};
    return snapped(held_, fit_.step);
  }
  if (held_.is_empty()) {
    held_ = needed;
  } else {
    const double share = 1.0 - fit_.damping;
    held_ = {std::min(needed.near_m, held_.near_m + share * (needed.near_m - held_.near_m)),
             std::max(needed.far_m, held_.far_m + share * (needed.far_m - held_.far_m))};
  }
  return snapped(held_, fit_.step);
}

}  // namespace clusterbench::grid
