#include "depth/depth_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/memory.h"
#include "core/random.h"

namespace clusterbench::depth {

PixelGrid::PixelGrid(Vec2i of_viewport, int divisor)
    : viewport(of_viewport), size((of_viewport.x + divisor - 1) / divisor, (of_viewport.y + divisor - 1) / divisor) {}

Vec2d PixelGrid::pixel(std::size_t index) const {
  const auto width = static_cast<std::size_t>(size.x);
  const std::size_t column = index % width, row = index / width;
  return {std::floor((static_cast<double>(column) + 0.5) * viewport.x / size.x) + 0.5,
          std::floor((static_cast<double>(row) + 0.5) * viewport.y / size.y) + 0.5};
}

DepthImage thinned(const DepthImage& full, const PixelGrid& pixels) {
  DepthImage out{pixels, {}};
  out.nearest.reserve(pixels.count());
  const auto width = static_cast<std::size_t>(full.pixels.size.x);
  for (std::size_t i = 0; i < pixels.count(); ++i) {
    const Vec2d at = pixels.pixel(i);
    out.nearest.push_back(full.nearest[static_cast<std::size_t>(at.y) * width + static_cast<std::size_t>(at.x)]);
  }
  return out;
}

namespace {

enum class Pattern : std::uint8_t { nothing, flat, slope, steps, random };
constexpr std::uint64_t k_patterns = 5;

// Depths from near to far, more of them near.
struct DepthDraw {
  SplitMix64 random;
  double near, far;

  double depth() {
    const double share = random.unit();
    return near + (far - near) * share * share * share * share;
  }
};

// Uneven parts of a side, from edge to edge.
std::vector<int> edges_of(int pixels, SplitMix64& random) {
  std::vector<int> edges{0};
  const auto widest = static_cast<std::uint64_t>(std::max(1, pixels / 4));
  while (edges.back() < pixels)
    edges.push_back(std::min(pixels, edges.back() + 1 + static_cast<int>(random.below(widest))));
  return edges;
}

void fill(DepthImage& image, Vec2i from, Vec2i to, DepthDraw& draw) {
  const auto pattern = static_cast<Pattern>(draw.random.below(k_patterns));
  if (pattern == Pattern::nothing) return;
  const double first = draw.depth(), second = draw.depth();
  for (int y = from.y; y < to.y; ++y)
    for (int x = from.x; x < to.x; ++x) {
      double depth = first;
      if (pattern == Pattern::slope)
        depth += (second - first) * (x - from.x + y - from.y) / (to.x - from.x + to.y - from.y);
      if (pattern == Pattern::steps && (x / 3 + y / 5) % 2 == 1) depth = second;
      if (pattern == Pattern::random) depth = draw.depth();
      image.nearest[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.pixels.size.x) +
                    static_cast<std::size_t>(x)] = static_cast<float>(depth);
    }
}

}  // namespace

DepthImage seeded_depths(const view::Frame& frame, std::uint64_t seed) {
  DepthImage image{PixelGrid(frame.viewport, 1), {}};
  check_memory("depths of pixels", image.pixels.count(), sizeof(float));
  image.nearest.assign(image.pixels.count(), std::numeric_limits<float>::infinity());
  const double near = frame.projection.near_m, far = frame.projection.far_m;
  DepthDraw draw{SplitMix64(SplitMix64(seed).next()), near, std::isfinite(far) ? far : 1e4 * std::abs(near) + 1.0};
  const std::vector<int> columns = edges_of(frame.viewport.x, draw.random),
                         rows = edges_of(frame.viewport.y, draw.random);
  for (std::size_t y = 0; y + 1 < rows.size(); ++y)
    for (std::size_t x = 0; x + 1 < columns.size(); ++x)
      fill(image, {columns[x], rows[y]}, {columns[x + 1], rows[y + 1]}, draw);
  return image;
}

}  // namespace clusterbench::depth
