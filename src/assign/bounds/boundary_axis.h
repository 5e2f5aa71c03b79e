#pragma once
// Boundaries along one axis of a grid.

#include <vector>

namespace clusterbench::assign {

// Ascending boundaries, with the scale for a first guess of a value's interval.
struct BoundaryAxis {
  std::vector<float> boundaries;
  float start = 0.0f, per_length = 0.0f;
};

}  // namespace clusterbench::assign
