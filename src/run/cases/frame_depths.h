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
  // Of one pixel in each block of divisor x divisor: taken from the image of all pixels where that is kept, else cast
  // for themselves and kept likewise. The depths are the same.
  std::shared_ptr<const depth::DepthImage> thinned(const view::Frame& frame, int divisor, int threads);
  // In front of these.
  depth::LayerImage layers(const view::Frame& frame, const depth::DepthImage& opaque, int most_layers, int threads);

  int images_cast() const { return images_cast_; }
  std::size_t pixels_cast() const { return pixels_cast_; }

  static constexpr std::size_t k_most_kept_bytes = std::size_t{256} << 20;

 private:
  // What an image depends on.
  struct Shot {
    double time_s;
    Vec3d eye;
    Mat3d rotation;
    view::Projection projection;
    Vec2i viewport;
    int divisor = 1;

    friend bool operator==(const Shot&, const Shot&) = default;
  };

  struct Kept {
    Shot shot;
    std::shared_ptr<const depth::DepthImage> image;

    std::size_t bytes() const { return image->nearest.size() * sizeof(float); }
  };

  std::shared_ptr<const depth::DepthImage> kept(const Shot& shot) const;  // null: it is not

  depth::RayCaster caster_;
  std::vector<Kept> kept_;
  int images_cast_ = 0;
  std::size_t pixels_cast_ = 0;
};

}  // namespace clusterbench::run
