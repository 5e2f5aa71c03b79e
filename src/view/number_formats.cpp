#include "view/number_formats.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace clusterbench::view {
namespace {

constexpr std::uint32_t k_infinity_bits = 0x7f800000u;  // single precision
constexpr std::uint16_t k_half_infinity = 0x7c00u, k_half_nan = 0x7e00u;

// Halves below it are multiples of 2^-24.
constexpr float k_smallest_normal = 0x1p-14f;

// Of a magnitude below 65520.
std::uint16_t nearest_half(float magnitude) {
  if (magnitude < k_smallest_normal) return static_cast<std::uint16_t>(std::nearbyint(magnitude * 0x1p24f));
  // The exponent's bias changes from 127 to 15; the lowest 13 bits are rounded away.
  const std::uint32_t rebased = std::bit_cast<std::uint32_t>(magnitude) - ((127u - 15u) << 23);
  const std::uint32_t is_odd = rebased >> 13 & 1u;
  return static_cast<std::uint16_t>((rebased + 0xfffu + is_odd) >> 13);
}

double with_sign_of(double magnitude, double sign) {
  return sign < 0.0 ? -magnitude : magnitude;
}

}  // namespace

std::uint16_t half_of(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000u);
  const std::uint32_t magnitude = bits & 0x7fffffffu;
  constexpr float k_rounds_to_infinity = 65520.0f;
  std::uint16_t half = k_half_infinity;
  if (magnitude > k_infinity_bits) half = k_half_nan;
  if (std::bit_cast<float>(magnitude) < k_rounds_to_infinity) half = nearest_half(std::bit_cast<float>(magnitude));
  return static_cast<std::uint16_t>(sign | half);
}

std::uint16_t half_not_below(float value) {
  const std::uint16_t nearest = half_of(value);
  return static_cast<std::uint16_t>(float_of_half(nearest) < value ? nearest + 1 : nearest);
}

float float_of_half(std::uint16_t bits) {
  const std::uint32_t sign = (bits & 0x8000u) << 16, exponent = bits >> 10 & 31u, fraction = bits & 0x3ffu;
  if (exponent == 0) return std::copysign(static_cast<float>(fraction) * 0x1p-24f, std::bit_cast<float>(sign));
  const std::uint32_t wider = exponent == 31u ? 255u : exponent + 127u - 15u;
  return std::bit_cast<float>(sign | wider << 23 | fraction << 13);
}

float half_rounding(float half) {
  const int exponent = std::fabs(half) < k_smallest_normal ? -14 : std::ilogb(half);
  return std::ldexp(1.0f, exponent - 11);
}

std::uint16_t unorm16_of(double share) {
  return static_cast<std::uint16_t>(std::nearbyint(std::clamp(share, 0.0, 1.0) * k_unorm16_steps));
}

std::uint16_t unorm16_not_below(double share) {
  return static_cast<std::uint16_t>(std::ceil(std::clamp(share, 0.0, 1.0) * k_unorm16_steps));
}

std::int16_t snorm16_of(double share) {
  return static_cast<std::int16_t>(std::nearbyint(std::clamp(share, -1.0, 1.0) * k_snorm16_steps));
}

Octahedral octahedral_of(const Vec3d& unit) {
  const double size = std::fabs(unit.x) + std::fabs(unit.y) + std::fabs(unit.z);
  double u = unit.x / size, v = unit.y / size;
  if (unit.z < 0.0) {  // the lower half is folded out over the square's corners
    const double folded = with_sign_of(1.0 - std::fabs(v), u);
    v = with_sign_of(1.0 - std::fabs(u), v);
    u = folded;
  }
  return {snorm16_of(u), snorm16_of(v)};
}

Vec3d unit_of(const Octahedral& point) {
  const double u = point.u / k_snorm16_steps, v = point.v / k_snorm16_steps;
  Vec3d p{u, v, 1.0 - std::fabs(u) - std::fabs(v)};
  if (p.z < 0.0) {
    p.x = with_sign_of(1.0 - std::fabs(v), u);
    p.y = with_sign_of(1.0 - std::fabs(u), v);
  }
  return p / std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
}

}  // namespace clusterbench::view
