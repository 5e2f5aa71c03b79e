#pragma once
// What finding true cells light by light has in common, whatever the cells are.

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "geom/shapes/ball_and_cone.h"
#include "geom/shapes/light_volume.h"
#include "measure/truth.h"
#include "measure/truth_rows.h"

namespace clusterbench::measure {

BallInSpace ball_in_space(const geom::LightVolume& volume);

// A spot in double precision, for tests that settle most cells at once.
struct QuickCone {
  Vec3d apex, axis;
  double range, cos_angle, sin_angle, slack;

  QuickCone(const geom::LightVolume& volume, const BallInSpace& ball);

  // Is a ball outside of the cone's side, behind its apex or beyond its range?
  bool surely_misses(const geom::Ball& around) const {
    const Vec3d v = Vec3d(around.center) - apex;
    const double along = glm::dot(v, axis);
    const double reach = around.radius * (1.0 + 0x1p-30) + 0x1p-30 * glm::length(v) + slack;
    if (along < -reach || glm::length(v) > range + reach) return true;
    return cos_angle * glm::length(v - along * axis) - sin_angle * along > reach;
  }
  bool surely_holds(const Vec3d& p) const {
    const Vec3d v = p - apex;
    const double along = glm::dot(v, axis), size = glm::length(v), rounding = 0x1p-30 * size + slack;
    return size < range - rounding && sin_angle * along - cos_angle * glm::length(v - along * axis) > rounding;
  }
};

// The true cells of one light, in runs of neighbours.
struct LightCells {
  struct Run {
    std::uint32_t first_cell, count;
  };
  std::vector<Run> runs;
  std::uint64_t filter_decided = 0, exact_decided = 0, undecided = 0;

  void add(std::uint32_t first_cell, std::uint32_t count = 1) {
    if (!runs.empty() && runs.back().first_cell + runs.back().count == first_cell)
      runs.back().count += count;
    else
      runs.push_back({first_cell, count});
  }
};

// All lights' cells. Independent of the number of threads. Throws Error beyond the limit on memory.
Truth gathered_truth(std::size_t lights, std::uint32_t cells, int threads,
                     const std::function<LightCells(std::uint32_t light)>& find);

}  // namespace clusterbench::measure
