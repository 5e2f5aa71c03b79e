#pragma once
// The scene's surfaces as a camera sees them: depth by ray casting (Embree).

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
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

// A surface that a ray meets: how far from where the ray begins, and the triangle's corners, seen from there along the
// world's axes.
struct SurfaceHit {
  double distance_m = 0.0;
  std::array<Vec3d, 3> corners{};
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
  // The same at any time and around any point: what is cast from far away of it is less precise.
  void pose(double time_s, const Vec3d& origin);
  // How often they were built: what was found before still holds while this stays.
  std::uint64_t builds() const { return builds_; }

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

  // The first opaque surface on the way from a point, from `begin_m` to `end_m` away. `along` is of unit length.
  std::optional<SurfaceHit> first_surface(const Vec3d& from, const Vec3d& along, double begin_m, double end_m) const;
  // Whether any opaque surface stands there.
  bool is_blocked(const Vec3d& from, const Vec3d& along, double begin_m, double end_m) const;

 private:
  struct Surfaces;
  const scene::Scene& scene_;
  const scene::Geometry& geometry_;
  std::unique_ptr<Surfaces> surfaces_;
  std::uint64_t builds_ = 0;
};

}  // namespace clusterbench::depth
