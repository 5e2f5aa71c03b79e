#include "geom/projection/disk_tangents.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace clusterbench::geom {
namespace {

constexpr double k_inf = std::numeric_limits<double>::infinity();
constexpr float k_inf_f = std::numeric_limits<float>::infinity();
constexpr float k_max_f = std::numeric_limits<float>::max();
constexpr double k_epsilon = std::numeric_limits<double>::epsilon();

float round_down(double value) {
  if (value == k_inf) return k_inf_f;
  if (value > static_cast<double>(k_max_f)) return k_max_f;
  if (value < -static_cast<double>(k_max_f)) return -k_inf_f;
  const float rounded = static_cast<float>(value);
  return static_cast<double>(rounded) > value ? std::nextafter(rounded, -k_inf_f) : rounded;
}

float round_up(double value) {
  return -round_down(-value);
}

// Hull of values, each known up to `error`.
struct Hull {
  double lo = k_inf, hi = -k_inf;

  void add(double value, double error) {
    lo = std::min(lo, value - error);
    hi = std::max(hi, value + error);
  }
  // The slope of a point at depth >= 0; at depth 0 it is infinite, on both sides where the side is not certain.
  void add_slope(double u, double depth, double u_error) {
    if (depth > 0.0) {
      add(u / depth, u_error / depth + 2.0 * k_epsilon * std::fabs(u / depth));
    } else {
      if (u >= -u_error) hi = k_inf;
      if (u <= u_error) lo = -k_inf;
    }
  }
  SlopeRange rounded() const { return {round_down(lo), round_up(hi)}; }
};

// r - |line - depth|, correct to a unit roundoff or two: wherever terms cancel, one of the two differences is exact
// (Sterbenz).
double reach_past(double line, double depth, double r) {
  const double small = std::min(line, depth), large = std::max(line, depth);
  if (small >= 0.5 * large) return r - (large - small);
  return (r - large) + small;
}

// u² + depth² - r². The products of floats are exact in double; the sum's rounding error is added, so the result is
// correct to a few unit roundoffs however much cancels.
double squared_tangent(double u, double depth, double r) {
  const double large = std::max(u * u, depth * depth), small = std::min(u * u, depth * depth);
  const double sum = large + small;
  const double lost = small - (sum - large);
  return (sum - r * r) + lost;
}

// Adds the slopes of the two tangents through the eye if they touch between the depths. They are the roots of (depth² -
// r²) s² - 2 u depth s + (u² - r²) = 0; the root that would cancel is computed from the product of the roots.
void add_tangents(Hull& hull, double u, double depth, double r, double depth_min, double depth_max) {
  const double squared = squared_tangent(u, depth, r);
  if (squared <= 0.0) return;  // the eye is in the disk
  const double length = std::sqrt(squared);
  const double q = u * depth + std::copysign(r * length, u * depth);
  const double root_q = q / ((depth - r) * (depth + r));
  const double root_product = ((u - r) * (u + r)) / q;
  const bool same_side = !std::signbit(u * depth);
  const double low = same_side ? root_product : root_q;
  const double high = same_side ? root_q : root_product;
  const auto add = [&](double slope) {
    const double touch_depth = length / std::sqrt(1.0 + slope * slope);
    if (touch_depth >= depth_min && touch_depth <= depth_max) hull.add(slope, 16.0 * k_epsilon * std::fabs(slope));
  };
  // Three cases: the disk is in front of the eye's plane, and both tangents touch there; or it crosses the plane, and
  // only the tangent on the eye's side touches in front; or neither does.
  if (depth > r || (depth > -r && u > 0.0)) add(low);
  if (depth > r || (depth > -r && u < 0.0)) add(high);
}

bool misses_slab(double depth, double r, double depth_min, double depth_max) {
  if (!(r >= 0.0)) return true;
  if (depth < depth_min) return reach_past(depth_min, depth, r) < 0.0;
  if (depth > depth_max) return reach_past(depth_max, depth, r) < 0.0;
  return false;
}

// Half the chord that the disk cuts out of the line at this depth, < 0 if there is none.
double half_chord(double line, double depth, double r) {
  const double past = reach_past(line, depth, r);
  return past < 0.0 ? -1.0 : std::sqrt(past * (r + std::fabs(line - depth)));
}

double chord_error(double u, double half) {
  return 4.0 * k_epsilon * (std::fabs(u) + half);
}

}  // namespace

SlopeRange slope_range(float u, float depth, float r, float depth_min, float depth_max) {
  assert(depth_min >= 0.0f && depth_max >= depth_min);
  if (r == k_inf_f) return {-k_inf_f, k_inf_f};
  if (misses_slab(depth, r, depth_min, depth_max)) return {k_inf_f, -k_inf_f};
  const double u_d = u, depth_d = depth, r_d = r;
  Hull hull;
  if (depth >= depth_min && depth <= depth_max) hull.add_slope(u_d, depth_d, 0.0);
  if (r > 0.0f) add_tangents(hull, u_d, depth_d, r_d, depth_min, depth_max);
  for (const double line : {static_cast<double>(depth_min), static_cast<double>(depth_max)}) {
    const double half = line < k_inf ? half_chord(line, depth_d, r_d) : -1.0;
    if (half < 0.0) continue;
    hull.add_slope(u_d - half, line, chord_error(u_d, half));
    hull.add_slope(u_d + half, line, chord_error(u_d, half));
  }
  return hull.rounded();
}

SlopeRange offset_range(float u, float depth, float r, float depth_min, float depth_max) {
  assert(depth_max >= depth_min);
  if (r == k_inf_f) return {-k_inf_f, k_inf_f};
  if (misses_slab(depth, r, depth_min, depth_max)) return {k_inf_f, -k_inf_f};
  const float line = std::clamp(depth, depth_min, depth_max);
  const double half = line == depth ? static_cast<double>(r) : half_chord(line, depth, r);
  Hull hull;
  hull.add(static_cast<double>(u) - half, chord_error(u, half));
  hull.add(static_cast<double>(u) + half, chord_error(u, half));
  return hull.rounded();
}

}  // namespace clusterbench::geom
