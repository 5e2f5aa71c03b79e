#pragma once
// Depths of a picture's pixels, as a depth buffer has them.

#include <cstdint>
#include <vector>

#include "geom/shapes/vec.h"
#include "view/frame.h"

namespace clusterbench::depth {

// Which pixels of the picture are looked through: one in the middle of each block of divisor x divisor pixels (of an
// even number the one below and to the right of the middle), row by row from the top left. Blocks beside the picture's
// right or lower edge are as many as are needed to cover it; then all are a little narrower.
struct PixelGrid {
  Vec2i viewport{0, 0}, size{0, 0};

  PixelGrid() = default;
  PixelGrid(Vec2i of_viewport, int divisor);

  bool is_full_resolution() const { return size == viewport; }
  std::size_t count() const { return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y); }
  // Its centre in the viewport's pixels, from the top left.
  Vec2d pixel(std::size_t index) const;
};

// Depths along the view's -z, in metres, in single precision as a depth buffer has them: between the camera's near and
// far plane, +inf where nothing opaque is.
struct DepthImage {
  PixelGrid pixels;
  std::vector<float> nearest;  // of the first opaque surface
};

// The pixels of a coarser grid, of an image of all pixels.
DepthImage thinned(const DepthImage& full, const PixelGrid& pixels);

// What is seen through: surfaces that blend, in front of the opaque one. The layers of pixel i are depths[begin[i]] ..
// depths[begin[i + 1] - 1], front to back.
struct LayerImage {
  PixelGrid pixels;
  std::vector<std::uint32_t> begin;
  std::vector<float> depths;
};

// Depths without triangles, for checks of what takes a depth buffer: the picture in uneven rectangles of nothing, of
// one depth, of slopes, of two depths that alternate, and of depths at random. The same for the same seed everywhere.
DepthImage seeded_depths(const view::Frame& frame, std::uint64_t seed);

}  // namespace clusterbench::depth
