#pragma once
// Depths of the pixels of a picture.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geom/shapes/vec.h"

namespace clusterbench::depth {

// Which points of the picture are looked through: one in the middle of each block of divisor x divisor pixels, row by
// row from the top left. Blocks beside the picture's right or lower edge are as many as are needed to cover it; then
// all are a little narrower.
struct PixelGrid {
  Vec2i viewport{0, 0}, size{0, 0};

  PixelGrid() = default;
  PixelGrid(Vec2i of_viewport, int divisor);

  std::size_t count() const { return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y); }
  // In the viewport's pixels, from the top left.
  Vec2d pixel(std::size_t index) const;
};

// Depths along the view's -z, in metres, in single precision as a depth buffer has them: between the camera's near and
// far plane, +inf where nothing opaque is.
struct DepthImage {
  PixelGrid pixels;
  std::vector<float> nearest;  // of the first opaque surface
};

// What is seen through: surfaces that blend, in front of the opaque one. The layers of pixel i are depths[begin[i]] ..
// depths[begin[i + 1] - 1], front to back.
struct LayerImage {
  PixelGrid pixels;
  std::vector<std::uint32_t> begin;
  std::vector<float> depths;
};

}  // namespace clusterbench::depth
