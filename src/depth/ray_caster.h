#pragma once
// The scene's surfaces as a camera sees them: depth by ray casting (Embree).

#include <memory>
#include <span>
#include <vector>

#include "depth/depth_image.h"
#include "scene/geometry.h"
#include "scene/scene.h"
#include "view/frame.h"

namespace clusterbench::depth {

// A ray anywhere in the world; `along` is of unit length.
struct WorldRay {
  Vec3d from{0.0}, along{0.0, 0.0, -1.0};
  double most_m = 0.0;  // how far it goes where nothing is; may be +inf
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
  // How far each ray gets: to the first opaque surface that turns its front to it, in metres. The same for any number
  // of threads.
  std::vector<double> free_ways(std::span<const WorldRay> rays, int threads) const;

 private:
  struct Surfaces;
  const scene::Scene& scene_;
  const scene::Geometry& geometry_;
  std::unique_ptr<Surfaces> surfaces_;
};

}  // namespace clusterbench::depth
