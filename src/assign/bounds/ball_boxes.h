#pragma once
// Many balls against one box.

#include <algorithm>
#include <cstdint>

#include "assign/simd/lanes.h"
#include "core/aligned_vector.h"
#include "core/arrays.h"
#include "geom/shapes/ball_and_cone.h"
#include "geom/shapes/cell.h"

namespace clusterbench::assign {

// Balls as one array per coordinate, with their lights. Keeps its memory.
class BallLanes {
 public:
  void clear() { count_ = 0; }
  void add(std::uint32_t light, const geom::Ball& ball) {
    if (count_ + k_most_lanes >= light_.size()) grow();
    x_[count_] = ball.center.x;
    y_[count_] = ball.center.y;
    z_[count_] = ball.center.z;
    squared_radius_[count_] = ball.radius * ball.radius;
    light_[count_++] = light;
  }
  std::uint32_t count() const { return count_; }

  // Writes the lights of the balls that touch the box by geom::ball_touches_box(), in their order, and returns their
  // number. `out` has room for k_most_lanes more than count().
  std::uint32_t touching(const geom::Box& box, std::uint32_t* out) const;

  std::size_t capacity_bytes() const { return light_.size() * (4 * sizeof(float) + sizeof(std::uint32_t)); }

 private:
  void grow() {
    const std::size_t room = 2 * light_.size() + 2 * k_most_lanes;
    grow_to(room, x_, y_, z_, squared_radius_, light_);
  }

  std::uint32_t count_ = 0;
  AlignedVector<float> x_, y_, z_, squared_radius_;  // with room for whole vectors after the last ball
  AlignedVector<std::uint32_t> light_;
};

}  // namespace clusterbench::assign
