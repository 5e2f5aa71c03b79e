#pragma once
// Where a player can stand: the triangles of a scene that look upward. A search that walks keeps its eye at a fixed
// height above them.

#include <array>
#include <vector>

#include "core/random.h"
#include "scene/geometry.h"

namespace clusterbench::search {

class Walkable {
 public:
  // Triangles whose front (counter-clockwise side) is at most 45 degrees from facing +y; of double-sided ones either
  // side. As the scene has them at rest, hidden ones left out. Throws Error if there is none.
  Walkable(const scene::Scene& scene, const scene::Geometry& geometry);

  // The point of these triangles that is nearest.
  Vec3d nearest(const Vec3d& point) const;
  // A point on them, all equally likely.
  Vec3d random(SplitMix64& random) const;
  std::size_t triangles() const { return corners_.size(); }
  double area_m2() const { return area_up_to_.back(); }
  // Of all of them.
  const Vec3d& lo() const { return lo_; }
  const Vec3d& hi() const { return hi_; }

 private:
  using Corners = std::array<Vec3d, 3>;

  std::vector<Corners> corners_;
  std::vector<std::array<Vec3d, 2>> boxes_;  // of each triangle
  std::vector<double> area_up_to_;           // of the triangles up to each
  Vec3d lo_{0.0}, hi_{0.0};
};

}  // namespace clusterbench::search
