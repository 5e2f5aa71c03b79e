#pragma once
// The scene's surfaces as a camera sees them: depth by ray casting (Embree).

#include <cstdint>
#include <memory>
#include <vector>

#include "scene/geometry.h"
#include "scene/scene.h"
#include "view/frame.h"

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

class RayCaster {
 public:
  // Both must outlive it. Nothing is built yet.
  RayCaster(const scene::Scene& scene, const scene::Geometry& geometry);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  // Puts the surfaces where they stand at a frame's time, around its eye; builds anew only where surfaces have moved,
  // or the eye far from where it was. Throws Error for surfaces outside of the domain and beyond the limit on memory.
  void pose(const view::Frame& frame);

  // Of the frame that it was posed for. The same for any number of threads.
  DepthImage depths(const view::Frame& frame, const PixelGrid& pixels, int threads) const;
  // At most `most_layers` for each pixel: the nearest ones.
  LayerImage layers(const view::Frame& frame, const DepthImage& opaque, int most_layers, int threads) const;

 private:
  struct Surfaces;
  const scene::Scene& scene_;
  const scene::Geometry& geometry_;
  std::unique_ptr<Surfaces> surfaces_;
};

}  // namespace clusterbench::depth
