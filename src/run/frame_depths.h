#pragma once
// Depth of a scene's frames: one source for the methods that need it and for sets of samples.

#include <memory>
#include <optional>

#include "depth/ray_caster.h"

namespace clusterbench::run {

// Of one scene, camera and viewport. Nothing is cast before something is asked for.
class FrameDepths {
 public:
  // Both must outlive it.
  FrameDepths(const scene::Scene& scene, const scene::Geometry& geometry) : caster_(scene, geometry) {}

  // Of all pixels. Cast once: whoever asks for the same frame again, before another one, gets the same image.
  std::shared_ptr<const depth::DepthImage> of(const view::Frame& frame, int threads);
  // In front of these.
  depth::LayerImage layers(const view::Frame& frame, const depth::DepthImage& opaque, int most_layers, int threads);

  int images_cast() const { return images_cast_; }

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

  depth::RayCaster caster_;
  std::optional<Shot> shot_;
  std::shared_ptr<const depth::DepthImage> image_;  // of the shot
  int images_cast_ = 0;
};

}  // namespace clusterbench::run
