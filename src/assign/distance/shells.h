#pragma once
// The common constants of `distance` and its fast form.

namespace clusterbench::assign {

// The cap that a ball covers in a shell is computed in double and stored in floats: its radius is off by 1, its section
// in a plane by 1 for its depth, 1 for its chord and 1 for the slope: 4.
inline constexpr float k_shell_roundoffs = 4.0f;

// A tangent touches a row if its touch point is no farther outside than this, relative to its coordinates. One slope
// too many only widens the interval.
inline constexpr double k_touch_tolerance = 1e-6;

}  // namespace clusterbench::assign
