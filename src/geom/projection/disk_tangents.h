#pragma once
// A disk as seen from the eye: the range of slopes of its part between two depths. A plane through one of the eye's
// axes cuts a sphere in such a disk, so these functions bound a light on the screen, per slice or per row.
//
// All functions are conservative: the range contains the slope of every real point of disk ∩ slab, and each end is at
// most two single-precision steps (and 1e-15 of the terms it is a difference of) beyond the true one. They compute in
// double because a float cannot represent |c|² - r² for r = 1e6 and a gap of 1 m to the eye (the textbook form is off
// by more than a 32-pixel tile there); the ends are rounded outward to float.

namespace clusterbench::geom {

struct SlopeRange {
  float lo, hi;

  bool empty() const { return !(lo <= hi); }
};

// The range of u'/depth' over the disk |(u', depth') - (u, depth)| <= r cut to depth_min <= depth' <= depth_max.
//   u, depth   the centre, finite; depth may be negative (behind the eye)
//   r          >= 0; 0 is a point, +inf is everything
//   depth_min  >= 0; at 0 the range may reach ±inf
//   depth_max  >= depth_min; may be +inf
// Empty (lo > hi) if the disk misses the slab.
SlopeRange slope_range(float u, float depth, float r, float depth_min, float depth_max);

// The same for an orthographic projection: the range of u'. depth_min may be negative.
SlopeRange offset_range(float u, float depth, float r, float depth_min, float depth_max);

}  // namespace clusterbench::geom
