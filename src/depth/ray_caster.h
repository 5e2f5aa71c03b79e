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
  double most_m = 0.0;  // its length if it meets nothing; may be +inf
};

// A surface that a ray meets: its distance from the ray's beginning, and the triangle's corners relative to the
// beginning, along the world's axes.
struct SurfaceHit {
  double distance_m = 0.0;
  std::array<Vec3d, 3> corners{};
};

class RayCaster {
 public:
  // Both must outlive this object. Nothing is built yet.
  RayCaster(const scene::Scene& scene, const scene::Geometry& geometry);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  // Moves the surfaces to their places at a frame's time, around its eye; rebuilds only if surfaces have moved, or the
  // eye is far from where it was. Throws Error for surfaces outside of the domain and beyond the limit on memory.
  void pose(const view::Frame& frame);
  // The same at any time and around any point: rays far away from the point are less precise.
  void pose(double time_s, const Vec3d& origin);
  // The number of builds: results stay valid while it is the same.
  std::uint64_t builds() const { return builds_; }

  // For the frame for which it was posed. The same for any number of threads.
  DepthImage depths(const view::Frame& frame, const PixelGrid& pixels, int threads) const;
  // Whether an opaque surface, seen from either side, is between two points in the world. One ray in single precision,
  // from the first point to `ends_before_m` before the other. Thread-safe.
  bool is_hidden(const Vec3d& from, const Vec3d& to, double ends_before_m) const;
  // Distance above a surface at which a ray to a light must begin, so that it does not meet the surface itself: the
  // rounding of a point, given its distance from the posed origin, is less than an eighth of it.
  double clearance_m(const Vec3d& from) const;
  // At most `most_layers` for each pixel: the nearest ones.
  LayerImage layers(const view::Frame& frame, const DepthImage& opaque, int most_layers, int threads) const;
  // The length of each ray up to the first opaque front-facing surface, in metres. The same for any number of threads.
  std::vector<double> free_ways(std::span<const WorldRay> rays, int threads) const;

  // The first opaque surface from a point, between `begin_m` and `end_m` away. `along` is of unit length.
  std::optional<SurfaceHit> first_surface(const Vec3d& from, const Vec3d& along, double begin_m, double end_m) const;
  // Whether any opaque surface is there.
  bool is_blocked(const Vec3d& from, const Vec3d& along, double begin_m, double end_m) const;

 private:
  struct Surfaces;
  const scene::Scene& scene_;
  const scene::Geometry& geometry_;
  std::unique_ptr<Surfaces> surfaces_;
  std::uint64_t builds_ = 0;
};

}  // namespace clusterbench::depth
