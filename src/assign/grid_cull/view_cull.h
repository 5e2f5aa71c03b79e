#pragma once
// Culls balls beside the view: the first step of scalar methods, because most lights of a large level are outside.

#include <cmath>
#include <limits>

#include "geom/shapes/ball_and_cone.h"
#include "grid/grid.h"

namespace clusterbench::assign {

// The four sides of the picture, and the depths at which a grid of tiles begins and ends. In double precision, where
// products of floats neither overflow nor lose digits that matter here.
class ViewCull {
 public:
  ViewCull() = default;
  explicit ViewCull(const grid::ScreenGrid& grid)
      : left_(side(grid.tiles.x.front(), grid.tiles.orthographic)),
        right_(side(grid.tiles.x.back(), grid.tiles.orthographic)),
        top_(side(grid.tiles.y.front(), grid.tiles.orthographic)),
        bottom_(side(grid.tiles.y.back(), grid.tiles.orthographic)),
        // Points of a shell have any depth from 0 to its distance.
        near_(grid.by_distance ? 0.0 : static_cast<double>(grid.slices.boundaries.front())),
        far_(grid.slices.boundaries.back()) {}

  // Does the ball touch no cell, even if it is enlarged by the error of a method's own single-precision steps? So no
  // list depends on this culling.
  bool misses(const geom::Ball& ball) const {
    const double x = ball.center.x, y = ball.center.y, depth = -ball.center.z, r = ball.radius;
    const double size = std::fabs(x) + std::fabs(y) + std::fabs(depth) + r;
    const double reach = r + k_roundoffs * 0x1p-24 * size + k_smallest;
    return left_.beyond(x, depth) < -reach || right_.beyond(x, depth) > reach || top_.beyond(y, depth) > reach ||
           bottom_.beyond(y, depth) < -reach || near_ - depth > reach || depth - far_ > reach;
  }

 private:
  static constexpr double k_roundoffs = 64.0;  // sphere refinement has the most: 18
  static constexpr double k_smallest = std::numeric_limits<float>::min();

  // A plane through the eye or along the view axis; positive to the right or above.
  struct Side {
    double across = 0.0, along = 0.0, offset = 0.0;

    double beyond(double coordinate, double depth) const { return across * coordinate + along * depth + offset; }
  };
  static Side side(double boundary, bool orthographic) {
    if (orthographic) return {1.0, 0.0, -boundary};
    const double length = std::sqrt(1.0 + boundary * boundary);
    return {1.0 / length, -boundary / length, 0.0};
  }

  Side left_, right_, top_, bottom_;
  double near_ = 0.0, far_ = 0.0;
};

}  // namespace clusterbench::assign
