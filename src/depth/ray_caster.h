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
  // The same at a time, around a place in the world.
  void pose(double time_s, const Vec3d& around);

  // Of the frame that it was posed for. The same for any number of threads.
  DepthImage depths(const view::Frame& frame, const PixelGrid& pixels, int threads) const;
  // Does an opaque surface, seen from either side, stand between two places in the world? One ray in single precision,
  // from the one to so far before the other. May be asked from several threads.
  bool is_hidden(const Vec3d& from, const Vec3d& to, double ends_before_m) const;
  // How far above a surface a ray to a light must begin, so that it does not meet the surface itself: a place that far
  // from where the surfaces were posed around is rounded by less than an eighth of it.
  double clearance_m(const Vec3d& from) const;
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
