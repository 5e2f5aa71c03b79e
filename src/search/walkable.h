#pragma once
// Places where a player can stand: the upward-facing triangles of a scene. A walking search keeps its eye at a fixed
// height above them.

#include <array>
#include <optional>
#include <vector>

#include "core/random.h"
#include "scene/geometry.h"

namespace clusterbench::search {

struct Box {
  Vec3d lo{0.0}, hi{0.0};

  bool holds(const Vec3d& point) const;
  void add(const Vec3d& point);
};

class Walkable {
 public:
  // Triangles whose front (counter-clockwise side) is at most 45 degrees from facing +y; for double-sided ones either
  // side. At rest, hidden ones left out, clipped to the box if one is given. Throws Error if there is none.
  Walkable(const scene::Scene& scene, const scene::Geometry& geometry, const std::optional<Box>& within = {});

  // The nearest point of these triangles.
  Vec3d nearest(const Vec3d& point) const;
  // A point on them, uniformly distributed over the area.
  Vec3d random(SplitMix64& random) const;
  std::size_t triangles() const { return corners_.size(); }
  double area_m2() const { return area_up_to_.back(); }
  // Bounds of all of them.
  const Vec3d& lo() const { return lo_; }
  const Vec3d& hi() const { return hi_; }

 private:
  using Corners = std::array<Vec3d, 3>;

  void add(const Corners& corners);

  std::vector<Corners> corners_;
  std::vector<std::array<Vec3d, 2>> boxes_;  // of each triangle
  std::vector<double> area_up_to_;           // of the triangles up to each
  Vec3d lo_{0.0}, hi_{0.0};
};

}  // namespace clusterbench::search
