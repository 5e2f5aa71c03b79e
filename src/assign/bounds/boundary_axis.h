#pragma once
// Boundaries along one axis of a grid.

#include <vector>

namespace clusterbench::assign {

// Ascending, and where among them a value may be looked for first.
struct BoundaryAxis {
  std::vector<float> boundaries;
  float start = 0.0f, per_length = 0.0f;
};

}  // namespace clusterbench::assign
