#pragma once
// Depth of a scene's frames: one source for the methods that need it and for sets of samples, in all grids.

#include <memory>
#include <vector>

#include "depth/ray_caster.h"

namespace clusterbench::run {

// Of one scene. Nothing is cast before something is asked for.
class FrameDepths {
 public:
  // Both must outlive it.
  FrameDepths(const scene::Scene& scene, const scene::Geometry& geometry) : caster_(scene, geometry) {}

  // Of all pixels. Cast once: whoever asks for the same frame again gets the same image, as far as images fit into
  // k_most_kept_bytes; the last one is kept in any case.
  std::shared_ptr<const depth::DepthImage> of(const view::Frame& frame, int threads);
  // In front of these.
  depth::LayerImage layers(const view::Frame& frame, const depth::DepthImage& opaque, int most_layers, int threads);

  int images_cast() const { return images_cast_; }

  static constexpr std::size_t k_most_kept_bytes = std::size_t{256} << 20;

 private:
  // What an image depends on.
  struct Shot {
    double time_s;
    Vec3d eye;
    Mat3d rotation;
    view::Projection projection;
    Vec2i viewport;

    friend bool operator==(const Shot&, const Shot&) = default;
  };

  struct Kept {
    Shot shot;
    std::shared_ptr<const depth::DepthImage> image;

    std::size_t bytes() const { return image->nearest.size() * sizeof(float); }
  };

  depth::RayCaster caster_;
  std::vector<Kept> kept_;
  int images_cast_ = 0;
};

}  // namespace clusterbench::run
