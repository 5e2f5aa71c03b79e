#pragma once
// The domain: the range of numbers for which every claim of this tool holds. Inside of it, squares and sums of squares
// of all lengths that methods use in single precision are finite and not 0. Input outside of it is an error that names
// its JSON location.

#include <cmath>
#include <limits>

namespace clusterbench::geom {

// The largest distance of lights and eyes from the world's origin along each axis, in metres, at every sampled frame;
// also the largest extent of a grid, as a bound in world space or as any coordinate of a cell relative to the eye.
inline constexpr double k_farthest_m = 1e15;

// Slices of perspective grids begin at 0 or at no less than this, and cells of cascades are no smaller than this.
inline constexpr double k_nearest_m = 1e-15;

// The steepest side of a picture, as a slope: tan of half the field of view, 89.9994 degrees.
inline constexpr double k_steepest_slope = 1e5;

inline bool is_in_domain(double coordinate_m) {
  return std::abs(coordinate_m) <= k_farthest_m;  // false for NaN
}

// The range that methods and the truth use for a given range (not negative): above k_farthest_m it is infinite, below
// k_nearest_m the light has no volume. NaN stays.
inline double range_in_domain(double range_m) {
  if (range_m > k_farthest_m) return std::numeric_limits<double>::infinity();
  return range_m < k_nearest_m ? 0.0 : range_m;
}

}  // namespace clusterbench::geom
