#pragma once
// Potentially visible sets, by sampling: which lights reach space that can be seen from where a camera is.
//
// The eyes of a camera path are put into view cells, cubes of the world. From points in a view cell rays go in all
// directions; what they pass through until the first opaque surface is visible space, in voxels. A light is kept where
// its ball (a spot's: around its cone) touches a visible voxel. What a ray could see and none met is missing: such a
// set is NOT conservative. (Airey, Rohlf and Brooks 1990; by sampled rays: Wonka et al. 2006, Guided Visibility
// Sampling.)
//
// Surfaces stand as in the path's first frame. Lights that move are held against the voxels in each frame.

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "cull/pre_cull_spec.h"
#include "cull/voxels.h"
#include "depth/ray_caster.h"
#include "scene/camera_path.h"
#include "scene/geometry.h"
#include "scene/scene.h"

namespace clusterbench::cull {

// The ways from which a view cell's space is seen: `rays` of them, in directions that are spread evenly over the sphere
// (a Fibonacci lattice, turned at random). Each begins at a random point of the view cell that one of the eyes sees;
// the eyes take turns. `caster` is posed. Their length is how far they get.
std::vector<depth::WorldRay> view_rays(const VoxelIndex& view_cell, std::span<const Vec3d> eyes,
                                       const VisibleSetStep& step, const depth::RayCaster& caster, std::uint64_t seed,
                                       int threads);

class VisibleSets {
 public:
  // Of the view cells that the path's eyes are in. The same for any number of threads. Throws Error beyond the limit on
  // memory.
  VisibleSets(const scene::Scene& scene, const scene::Geometry& geometry, const scene::CameraPath& path,
              const VisibleSetStep& step, std::uint64_t seed, int threads);

  struct ViewCell {
    std::vector<std::uint64_t> lights;  // a bit per light that does not move: kept
    Voxels voxels;                      // empty where no light moves
  };
  // The eye's; null where the path has no eye in it, and all lights are kept.
  const ViewCell* at(const Vec3d& eye) const;
  // `light`: as the frame has it, with its index there.
  bool keeps(const ViewCell& cell, std::uint32_t index, const scene::WorldLight& light) const;

  std::size_t view_cell_count() const { return cells_.size(); }
  std::uint64_t bytes() const;
  double build_ns() const { return build_ns_; }

 private:
  void find_moving(const scene::Scene& scene, const scene::CameraPath& path);
  ViewCell look_around(const Voxels& empty, std::span<const depth::WorldRay> rays) const;

  VisibleSetStep step_;
  std::vector<scene::WorldLight> lights_;  // as they are in the first frame
  std::vector<bool> moves_;
  bool any_moves_ = false;
  Vec3d lo_{0.0}, hi_{0.0};  // around all that bounded lights reach over the path
  std::map<VoxelIndex, ViewCell> cells_;
  double build_ns_ = 0.0;
};

}  // namespace clusterbench::cull
