#pragma once
// Depth images of a scene's frames: one source for methods and sample sets, shared by all grids.

#include <memory>
#include <mutex>
#include <vector>

#include "depth/ray_caster.h"

namespace clusterbench::run {

// Depth images of one scene. Nothing is cast before the first request. Several threads may request images: they wait
// for one another, since the scene stands as at one frame's time.
class FrameDepths {
 public:
  // Both must outlive this object.
  FrameDepths(const scene::Scene& scene, const scene::Geometry& geometry) : caster_(scene, geometry) {}

  // Depths of all pixels, cast once: the same frame returns the same image while images fit into k_most_kept_bytes; the
  // last image is always kept.
  std::shared_ptr<const depth::DepthImage> of(const view::Frame& frame, int threads);
  // Depths of one pixel in each block of divisor x divisor: from the cached image of all pixels if there is one, else
  // cast separately and cached in the same way. The depths are the same.
  std::shared_ptr<const depth::DepthImage> thinned(const view::Frame& frame, int divisor, int threads);
  // Layers in front of these depths.
  depth::LayerImage layers(const view::Frame& frame, const depth::DepthImage& opaque, int most_layers, int threads);

  int images_cast() const { return images_cast_; }
  std::size_t pixels_cast() const { return pixels_cast_; }

  static constexpr std::size_t k_most_kept_bytes = std::size_t{256} << 20;

 private:
  // The key of a cached image.
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

  std::shared_ptr<const depth::DepthImage> kept(const Shot& shot) const;  // null: not cached

  std::mutex casting_;
  depth::RayCaster caster_;
  std::vector<Kept> kept_;
  int images_cast_ = 0;
  std::size_t pixels_cast_ = 0;
};

}  // namespace clusterbench::run
