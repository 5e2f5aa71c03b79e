#include "search/walkable.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace clusterbench::search {
namespace {

double squared(const Vec3d& v) {
  return glm::dot(v, v);
}

double squared_distance(const Vec3d& point, const std::array<Vec3d, 2>& box) {
  return squared(point - glm::clamp(point, box[0], box[1]));
}

// Ericson 2005, "Real-Time Collision Detection", 5.1.5.
Vec3d nearest_on(const std::array<Vec3d, 3>& t, const Vec3d& p) {
  const Vec3d ab = t[1] - t[0], ac = t[2] - t[0];
  const double d1 = glm::dot(ab, p - t[0]), d2 = glm::dot(ac, p - t[0]);
  if (d1 <= 0.0 && d2 <= 0.0) return t[0];
  const double d3 = glm::dot(ab, p - t[1]), d4 = glm::dot(ac, p - t[1]);
  if (d3 >= 0.0 && d4 <= d3) return t[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return t[0] + ab * (d1 / (d1 - d3));
  const double d5 = glm::dot(ab, p - t[2]), d6 = glm::dot(ac, p - t[2]);
  if (d6 >= 0.0 && d5 <= d6) return t[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return t[0] + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return t[1] + (t[2] - t[1]) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double whole = va + vb + vc;
  return t[0] + ab * (vb / whole) + ac * (vc / whole);
}

// Twice the area along the normal, turned upward if that side is visible; zero if it is no floor.
Vec3d floor_normal(const std::array<Vec3d, 3>& t, bool is_double_sided) {
  constexpr double k_least_cosine = 0.70710678118654752;
  Vec3d normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  if (is_double_sided && normal.y < 0.0) normal = -normal;
  const double length = std::sqrt(squared(normal));
  return length > 0.0 && normal.y >= k_least_cosine * length ? normal : Vec3d(0.0);
}

// The part in the box, a convex polygon; side by side (Sutherland and Hodgman 1974).
std::vector<Vec3d> clipped(const std::array<Vec3d, 3>& triangle, const Box& box) {
  std::vector<Vec3d> polygon(triangle.begin(), triangle.end());
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    const auto inside = [&](const Vec3d& p) { return side % 2 == 0 ? p[axis] - box.lo[axis] : box.hi[axis] - p[axis]; };
    std::vector<Vec3d> rest;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3d &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
      const double a = inside(from), b = inside(to);
      if (a >= 0.0) rest.push_back(from);
      if ((a < 0.0) != (b < 0.0)) {
        Vec3d on = from + (to - from) * (a / (a - b));
        on[axis] = side % 2 == 0 ? box.lo[axis] : box.hi[axis];
        rest.push_back(on);
      }
    }
    polygon = rest;
  }
  return polygon;
}

}  // namespace

Walkable::Walkable(const scene::Scene& scene, const scene::Geometry& geometry, const std::optional<Box>& within) {
  const std::vector<Mat4d> worlds = scene::rest_transforms(scene);
  const std::vector<bool> visible = scene::visible_nodes(scene, 0.0);
  for (const scene::SurfaceInstance& instance : geometry.instances) {
    if (instance.shown_by >= 0 && !visible[static_cast<std::size_t>(instance.shown_by)]) continue;
    const scene::Surface& surface = geometry.surfaces[instance.surface];
    const Mat4d world = instance.node < 0 ? Mat4d(1.0) : worlds[static_cast<std::size_t>(instance.node)];
    const bool is_mirrored = glm::determinant(Mat3d(world)) < 0.0;
    for (const scene::Triangle& triangle : surface.triangles) {
      Corners corners;
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = Vec3d(world * Vec4d(surface.origin + Vec3d(surface.vertices[triangle[i]]), 1.0));
      if (is_mirrored) std::swap(corners[1], corners[2]);
      const double twice = std::sqrt(squared(floor_normal(corners, surface.double_sided)));
      if (!(twice > 0.0) || !std::isfinite(twice)) continue;
      if (!within) {
        add(corners);
        continue;
      }
      const std::vector<Vec3d> part = clipped(corners, *within);
      for (std::size_t i = 2; i < part.size(); ++i) add({part[0], part[i - 1], part[i]});
    }
  }
  if (!corners_.empty()) return;
  if (within) throw Error("", "--within", "holds no part of the floor that an eye could stand above");
  throw Error(scene.path.string(), "--walkable",
              geometry.empty() ? "the scene has no triangles" : "no triangle of the scene looks upward");
}

void Walkable::add(const Corners& corners) {
  const double twice = std::sqrt(squared(glm::cross(corners[1] - corners[0], corners[2] - corners[0])));
  if (!(twice > 0.0)) return;
  area_up_to_.push_back((area_up_to_.empty() ? 0.0 : area_up_to_.back()) + 0.5 * twice);
  corners_.push_back(corners);
  boxes_.push_back(
      {glm::min(corners[0], glm::min(corners[1], corners[2])), glm::max(corners[0], glm::max(corners[1], corners[2]))});
  lo_ = corners_.size() == 1 ? boxes_.back()[0] : glm::min(lo_, boxes_.back()[0]);
  hi_ = corners_.size() == 1 ? boxes_.back()[1] : glm::max(hi_, boxes_.back()[1]);
}

Vec3d Walkable::nearest(const Vec3d& point) const {
  Vec3d best = corners_.front()[0];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    if (squared_distance(point, boxes_[i]) >= least) continue;
    const Vec3d candidate = nearest_on(corners_[i], point);
    const double distance = squared(candidate - point);
    if (distance >= least) continue;
    least = distance;
    best = candidate;
  }
  return best;
}

Vec3d Walkable::random(SplitMix64& random) const {
  const auto found = std::ranges::upper_bound(area_up_to_, random.unit() * area_m2());
  const auto index = static_cast<std::size_t>(std::min(found, area_up_to_.end() - 1) - area_up_to_.begin());
  double u = random.unit(), v = random.unit();
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const Corners& t = corners_[index];
  return t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v;
}

}  // namespace clusterbench::search
