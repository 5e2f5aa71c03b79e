#pragma once
// The planes between the tiles of a frustum grid.

#include <cmath>
#include <vector>

#include "grid/grid.h"

namespace clusterbench::assign {

// A tile plane through the eye (perspective) or along the view axis (orthographic); positive to the right or above.
// Points are given as (x or y, depth).
struct TilePlane {
  float across, along, offset;  // unit normal (across, along)

  float distance(float coordinate, float depth) const { return across * coordinate + along * depth + offset; }
};

inline TilePlane tile_plane(float boundary, bool orthographic) {
  if (orthographic) return {1.0f, 0.0f, -boundary};
  const double length = std::sqrt(1.0 + static_cast<double>(boundary) * static_cast<double>(boundary));
  return {static_cast<float>(1.0 / length), static_cast<float>(-static_cast<double>(boundary) / length), 0.0f};
}

inline std::vector<TilePlane> tile_planes(const std::vector<float>& boundaries, bool orthographic) {
  std::vector<TilePlane> planes;
  for (const float boundary : boundaries) planes.push_back(tile_plane(boundary, orthographic));
  return planes;
}

}  // namespace clusterbench::assign
