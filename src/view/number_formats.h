#pragma once
// Number formats in which engines pack lights: IEEE binary16, 16-bit unorm and snorm, unit vectors on an octahedron.
// Encoding rounds to nearest, halves to even, except if a name says otherwise.

#include <cstdint>

#include "geom/shapes/vec.h"

namespace clusterbench::view {

inline constexpr float k_largest_half = 65504.0f;

// Bits of the nearest binary16. From 65520 on (a unit beyond the largest, half rounded up): infinity. A NaN stays one.
std::uint16_t half_of(float value);
// Bits of the smallest binary16 that is not below the value, which is not negative. Beyond 65504: infinity.
std::uint16_t half_not_below(float value);
float float_of_half(std::uint16_t bits);
// The largest distance between a finite value and the result of half_of: half of the distance to the next one.
float half_rounding(float half);

// A share of 0 to 1 as a multiple of 1 / 65535, -1 to 1 as one of 1 / 32767. Clamped to the ends.
inline constexpr double k_unorm16_steps = 65535.0, k_snorm16_steps = 32767.0;
std::uint16_t unorm16_of(double share);
std::uint16_t unorm16_not_below(double share);
std::int16_t snorm16_of(double share);

// A unit vector (up to rounding) as a point on the octahedron |x| + |y| + |z| = 1, unfolded to a square (Cigolle and
// others 2014).
struct Octahedral {
  std::int16_t u, v;
};
Octahedral octahedral_of(const Vec3d& unit);
Vec3d unit_of(const Octahedral& point);
// The largest angle in radians between a vector and its decoded value: a point has an error of e = 1/2 step in u and v,
// so on the octahedron of sqrt(e² + e² + (2e)²) along its faces, which are nowhere nearer to the centre than 1 /
// sqrt(3).
inline constexpr double k_octahedral_rad = 4.2426406871192857 * 0.5 / k_snorm16_steps;

}  // namespace clusterbench::view
