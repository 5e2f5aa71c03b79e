#include "view/packing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geom/numbers/round_to_float.h"
#include "view/number_formats.h"

namespace clusterbench::view {
namespace {

constexpr double k_right_angle = 1.57079632679489662;
// Error of single precision before and after packing, relative to a coordinate, and in radians.
constexpr double k_float_rounding = 0x1p-23, k_float_turn = 0x1p-21;

// A number after unpacking, and its largest distance from the packed value.
struct Number {
  double value = 0.0, bound = 0.0;
};
struct Axis {
  Vec3d unit{0.0};
  double bound_rad = 0.0;
};

Vec3f position_of(const LightArrays& lights, std::uint32_t light) {
  return {lights.x[light], lights.y[light], lights.z[light]};
}

Vec3d axis_of(const LightArrays& lights, std::uint32_t spot) {
  return {lights.axis_x[spot], lights.axis_y[spot], lights.axis_z[spot]};
}

class HalfFormat {
 public:
  explicit HalfFormat(const LightArrays&) {}

  static bool holds(const Vec3f& position, float range) {
    const auto is_in_half = [](float value) { return std::isfinite(float_of_half(half_of(value))); };
    return is_in_half(position.x) && is_in_half(position.y) && is_in_half(position.z) && range <= k_largest_half;
  }
  static Number coordinate(float value, int) { return number(value); }
  static float range(float value) { return float_of_half(half_not_below(value)); }
  static Number angle(double value) { return number(static_cast<float>(value)); }
  static Axis axis(const Vec3d& unit) {
    const Number x = number(static_cast<float>(unit.x)), y = number(static_cast<float>(unit.y)),
                 z = number(static_cast<float>(unit.z));
    const Vec3d unpacked{x.value, y.value, z.value};
    const double off = glm::length(Vec3d{x.bound, y.bound, z.bound}), length = glm::length(unpacked);
    return {unpacked / length, std::asin(std::min(1.0, off / length))};
  }

 private:
  static Number number(float value) {
    const float half = float_of_half(half_of(value));
    return {half, half_rounding(half)};
  }
};

class Unorm16Format {
 public:
  explicit Unorm16Format(const LightArrays& lights) {
    bool is_first = true;
    for (std::uint32_t light = 0; light < lights.size(); ++light) {
      if (!std::isfinite(lights.radius[light])) continue;
      const Vec3d position(position_of(lights, light));
      lo_ = is_first ? position : glm::min(lo_, position);
      hi_ = is_first ? position : glm::max(hi_, position);
      largest_range_ = std::max(largest_range_, static_cast<double>(lights.radius[light]));
      is_first = false;
    }
  }

  static bool holds(const Vec3f&, float range) { return std::isfinite(range); }
  Number coordinate(float value, int side) const {
    const double length = hi_[side] - lo_[side];
    if (!(length > 0.0)) return {value, 0.0};
    const double step = length / k_unorm16_steps;
    return {lo_[side] + step * unorm16_of((value - lo_[side]) / length), 0.5 * step};
  }
  float range(float value) const {
    if (!(value > 0.0f)) return value;
    const float unpacked =
        geom::rounded_up(largest_range_ / k_unorm16_steps * unorm16_not_below(value / largest_range_));
    return std::max(unpacked, value);  // the product may end a unit roundoff below
  }
  static Number angle(double value) {
    constexpr double k_step = k_right_angle / k_unorm16_steps;
    return {k_step * unorm16_of(value / k_right_angle), 0.5 * k_step};
  }
  static Axis axis(const Vec3d& unit) { return {unit_of(octahedral_of(unit)), k_octahedral_rad}; }

 private:
  Vec3d lo_{0.0}, hi_{0.0};
  double largest_range_ = 0.0;
};

float reach_of(const LightArrays& lights, std::uint32_t light, double inflation_m) {
  const auto size = [&](const std::vector<float>& numbers) { return std::fabs(static_cast<double>(numbers[light])); };
  return geom::rounded_up(size(lights.x) + size(lights.y) + size(lights.z) + size(lights.radius) + inflation_m);
}

void set_axis(LightArrays& lights, std::uint32_t spot, const Vec3d& unit) {
  lights.axis_x[spot] = static_cast<float>(unit.x);
  lights.axis_y[spot] = static_cast<float>(unit.y);
  lights.axis_z[spot] = static_cast<float>(unit.z);
}

void set_angle(LightArrays& lights, std::uint32_t spot, double angle_rad) {
  lights.cos_angle[spot] = static_cast<float>(std::cos(angle_rad));
  lights.sin_angle[spot] = static_cast<float>(std::sin(angle_rad));
}

template <class Format>
void pack_ball(const Format& format, LightArrays& lights, std::uint32_t light, PackingBound& bound) {
  double square = 0.0;
  std::vector<float>* const sides[] = {&lights.x, &lights.y, &lights.z};
  for (int side = 0; side < 3; ++side) {
    float& coordinate = (*sides[side])[light];
    const Number unpacked = format.coordinate(coordinate, side);
    coordinate = static_cast<float>(unpacked.value);
    const double off = unpacked.bound + k_float_rounding * (std::fabs(unpacked.value) + unpacked.bound);
    square += off * off;
  }
  bound.position_m = std::sqrt(square);
  lights.radius[light] = format.range(lights.radius[light]);
  lights.reach[light] = reach_of(lights, light, 0.0);
}

template <class Format>
void pack_cone(const Format& format, LightArrays& lights, std::uint32_t light, PackingBound& bound) {
  const std::uint32_t spot = light - lights.spots.first;
  const Axis axis = format.axis(axis_of(lights, spot));
  const Number angle = format.angle(lights.source[light].outer_cone_rad);
  set_axis(lights, spot, axis.unit);
  set_angle(lights, spot, std::min(angle.value, k_right_angle));
  bound.axis_rad = axis.bound_rad + k_float_turn;
  bound.angle_rad = angle.bound + k_float_turn;
}

template <class Format>
PackedLights packed_as(const LightArrays& lights) {
  const Format format(lights);
  PackedLights out{lights, std::vector<PackingBound>(lights.size()), {}};
  for (std::uint32_t light = 0; light < lights.size(); ++light) {
    if (!format.holds(position_of(lights, light), lights.radius[light])) {
      out.unrepresentable.push_back(light);
      continue;
    }
    pack_ball(format, out.lights, light, out.bounds[light]);
    if (lights.is_spot(light)) pack_cone(format, out.lights, light, out.bounds[light]);
  }
  return out;
}

// The change of a spot's cone after which it contains every cone from which it can have been packed.
struct Widening {
  double angle_rad;  // the new half-angle
  double back_m;     // distance by which the apex moves back
};

// A cone of half-angle a, moved back by d / sin a, contains the ball of radius d around its old apex and, since sums of
// its points stay in it, all cones of its directions from there. Beyond a right angle only the half-space is left; it
// must contain the directions that lean back over its plane, too.
Widening widening_of(double angle_rad, double range_m, const PackingBound& bound) {
  const double wider = angle_rad + bound.axis_rad + bound.angle_rad;
  if (wider > k_right_angle) return {k_right_angle, bound.position_m + range_m * std::sin(wider - k_right_angle)};
  const double shorter = std::asin(std::min(1.0, 2.0 * bound.position_m / range_m));
  const double widest = std::max(wider, shorter);
  return {widest, bound.position_m / std::sin(widest)};
}

void inflate_point(LightArrays& lights, std::uint32_t light, const PackingBound& bound) {
  lights.radius[light] = geom::rounded_up(lights.radius[light] + bound.position_m);
}

void inflate_spot(LightArrays& lights, std::uint32_t light, const PackingBound& bound) {
  const std::uint32_t spot = light - lights.spots.first;
  const double range = lights.radius[light];
  const Widening change = widening_of(std::atan2(lights.sin_angle[spot], lights.cos_angle[spot]), range, bound);
  const Vec3d apex = Vec3d(position_of(lights, light)) - change.back_m * glm::normalize(axis_of(lights, spot));
  lights.x[light] = static_cast<float>(apex.x);
  lights.y[light] = static_cast<float>(apex.y);
  lights.z[light] = static_cast<float>(apex.z);
  lights.radius[light] = geom::rounded_up(range + change.back_m + bound.position_m);
  set_angle(lights, spot, change.angle_rad);
}

}  // namespace

const char* packing_name(Packing packing) {
  switch (packing) {
    case Packing::half:
      return "half";
    case Packing::unorm16:
      return "unorm16";
    default:
      return "float32";
  }
}

PackedLights packed(const LightArrays& lights, Packing packing) {
  if (packing == Packing::half) return packed_as<HalfFormat>(lights);
  if (packing == Packing::unorm16) return packed_as<Unorm16Format>(lights);
  return {lights, std::vector<PackingBound>(lights.size()), {}};
}

LightArrays inflated(const PackedLights& packed) {
  LightArrays out = packed.lights;
  for (std::uint32_t light = 0; light < out.size(); ++light) {
    const PackingBound& bound = packed.bounds[light];
    if (out.is_empty(light) || bound.inflation_m(out.radius[light]) == 0.0) continue;
    out.is_spot(light) ? inflate_spot(out, light, bound) : inflate_point(out, light, bound);
    // The roundoffs for which methods pad are relative to the largest possible position of the light.
    out.reach[light] = reach_of(out, light, 2.0 * bound.position_m);
  }
  return out;
}

}  // namespace clusterbench::view
