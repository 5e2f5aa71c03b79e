#pragma once
// How box methods test a spot: the parameter that they share.

#include <vector>

#include "assign/assigner.h"
#include "geom/predicates.h"

namespace clusterbench::assign {

enum class SpotTest { ball, cone_sphere, both };

// Parameter `spot`: "ball", "cone-sphere" or "both" (the default).
ParamSpec spot_param();
SpotTest spot_test_from(const Params& params);

// The ball that stands for a light in the method's own test: a point's ball, a spot's bounding ball, or with
// cone-sphere the ball of its range.
geom::Ball ball_for(const view::LightArrays& lights, std::uint32_t light, SpotTest spot);

// Bounding balls of all cells, made when the first spot that needs them comes.
class CellBalls {
 public:
  void clear() { balls_.clear(); }
  void ensure(const grid::Grid& grid);
  const geom::Ball& operator[](std::uint32_t cell) const { return balls_[cell]; }
  std::size_t capacity_bytes() const { return balls_.capacity() * sizeof(geom::Ball); }

 private:
  std::vector<geom::Ball> balls_;
};

}  // namespace clusterbench::assign
