#pragma once
// Depths of a picture's pixels, as in a depth buffer.

#include <cstdint>
#include <vector>

#include "geom/shapes/vec.h"
#include "view/frame.h"

namespace clusterbench::depth {

// The sampled pixels of the picture: one in the middle of each block of divisor x divisor pixels (for an even divisor
// the one below and to the right of the middle), row by row from the top left. There are enough blocks to cover the
// picture; if the divisor does not divide its size, all are a little narrower.
struct PixelGrid {
  Vec2i viewport{0, 0}, size{0, 0};

  PixelGrid() = default;
  PixelGrid(Vec2i of_viewport, int divisor);

  bool is_full_resolution() const { return size == viewport; }
  std::size_t count() const { return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y); }
  // Its centre in the viewport's pixels, from the top left.
  Vec2d pixel(std::size_t index) const;
};

// Depths along the view's -z, in metres, in single precision as in a depth buffer: between the camera's near and far
// plane, +inf without an opaque surface.
struct DepthImage {
  PixelGrid pixels;
  std::vector<float> nearest;  // of the first opaque surface
};

// The pixels of a coarser grid, from an image of all pixels.
DepthImage thinned(const DepthImage& full, const PixelGrid& pixels);

// Transparent layers: surfaces that blend, in front of the opaque one. The layers of pixel i are depths[begin[i]] ..
// depths[begin[i + 1] - 1], front to back.
struct LayerImage {
  PixelGrid pixels;
  std::vector<std::uint32_t> begin;
  std::vector<float> depths;
};

// Depths without triangles, for tests of methods that need a depth buffer: the picture in uneven rectangles of no
// surface, of one depth, of slopes, of two depths that alternate, and of random depths. The same seed gives the same
// depths everywhere.
DepthImage seeded_depths(const view::Frame& frame, std::uint64_t seed);

}  // namespace clusterbench::depth
