#include "depth/depth_image.h"

namespace clusterbench::depth {

PixelGrid::PixelGrid(Vec2i of_viewport, int divisor)
    : viewport(of_viewport), size((of_viewport.x + divisor - 1) / divisor, (of_viewport.y + divisor - 1) / divisor) {}

Vec2d PixelGrid::pixel(std::size_t index) const {
  const auto width = static_cast<std::size_t>(size.x);
  const std::size_t column = index % width, row = index / width;
  return {(static_cast<double>(column) + 0.5) * viewport.x / size.x,
          (static_cast<double>(row) + 0.5) * viewport.y / size.y};
}

}  // namespace clusterbench::depth
