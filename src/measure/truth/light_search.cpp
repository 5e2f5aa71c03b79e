#include "measure/truth/light_search.h"

#include <cmath>

namespace clusterbench::measure {
namespace {

grid::BallInSpace ball_in_space(const geom::LightVolume& volume) {
  constexpr double k_slack = 0x1p-44;
  const geom::LocalPoint center = geom::local_point(geom::source_of(volume));
  const double range = geom::range_of(volume);
  const double size = std::abs(center.at.x) + std::abs(center.at.y) + std::abs(center.at.z) + range;
  return {center.at, range, k_slack * size + 4.0 * center.rounding_error};
}

// Whether a point is well inside a cell.
struct WellInside {
  Vec3d p;

  static bool between(double lo, double value, double hi) {
    const double rounding = 0x1p-40 * (std::abs(lo) + std::abs(hi));
    return value > lo + rounding && value < hi - rounding;
  }
  bool operator()(const geom::FrustumCell& c) const {
    const double depth = -p.z, scale = c.orthographic ? 1.0 : depth;
    return between(c.depth0, depth, c.depth1) && between(c.x0 * scale, p.x, c.x1 * scale) &&
           between(c.y0 * scale, p.y, c.y1 * scale);
  }
  bool operator()(const geom::ShellCell& c) const {
    const double depth = -p.z;
    return depth > 0.0 && between(c.distance0, glm::length(p), c.distance1) &&
           between(c.x0 * depth, p.x, c.x1 * depth) && between(c.y0 * depth, p.y, c.y1 * depth);
  }
  bool operator()(const geom::Box& c) const {
    return between(c.lo.x, p.x, c.hi.x) && between(c.lo.y, p.y, c.hi.y) && between(c.lo.z, p.z, c.hi.z);
  }
};

}  // namespace

QuickCone::QuickCone(const geom::SpotVolume& spot, const Vec3d& apex_at)
    : apex(apex_at),
      axis(glm::normalize(spot.apex.rotation * spot.direction)),
      range(spot.range),
      cos_angle(std::cos(spot.half_angle_rad)),
      sin_angle(std::sin(spot.half_angle_rad)),
      slack(0x1p-30 * (std::abs(apex.x) + std::abs(apex.y) + std::abs(apex.z))) {}

LightSearch::LightSearch(const geom::LightVolume& light)
    : ball_(ball_in_space(light)),
      decider_(geom::source_of(light), is_endless() ? 0.0 : geom::range_of(light)) {  // endless lights use no decider
  if (const auto* spot = std::get_if<geom::SpotVolume>(&light)) {
    spot_.emplace(*spot);
    cone_.emplace(*spot, ball_.center);
  }
  if (const auto* box = std::get_if<geom::BoxVolume>(&light)) {
    box_.emplace(*box);
    quick_box_.emplace(*box, ball_.center);
  }
}

bool LightSearch::is_well_inside(const geom::Cell& cell, const Vec3d& p) {
  return std::visit(WellInside{p}, cell);
}

}  // namespace clusterbench::measure
