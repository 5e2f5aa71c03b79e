#pragma once
// Potentially visible sets, by sampling: the lights that reach space that is visible from the camera's surroundings.
//
// The eyes of a camera path are grouped into view cells, cubes of the world. Rays go from points in a view cell in all
// directions; the space that they pass through until the first opaque surface is visible, in voxels. A light is kept if
// its ball (a spot's: around its cone) touches a visible voxel. Space that is visible but met by no ray is missing:
// such a set is NOT conservative. (Airey, Rohlf and Brooks 1990; by sampled rays: Wonka et al. 2006, Guided Visibility
// Sampling.)
//
// Surfaces have their places in the path's first frame. Moving lights are tested against the voxels in each frame.

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

// The rays that sample a view cell's visible space: `rays` of them, in directions that are spread evenly over the
// sphere (a Fibonacci lattice, turned at random). Each begins at a random point of the view cell that is visible from
// one of the eyes; the eyes take turns. `caster` is posed. Their length is the distance to the first surface.
std::vector<depth::WorldRay> view_rays(const VoxelIndex& view_cell, std::span<const Vec3d> eyes,
                                       const VisibleSetStep& step, const depth::RayCaster& caster, std::uint64_t seed,
                                       int threads);

class VisibleSets {
 public:
  // For the view cells of the path's eyes. The same for any number of threads. Throws Error beyond the limit on memory.
  VisibleSets(const scene::Scene& scene, const scene::Geometry& geometry, const scene::CameraPath& path,
              const VisibleSetStep& step, std::uint64_t seed, int threads);

  struct ViewCell {
    std::vector<std::uint64_t> lights;  // a bit per static light: kept
    Voxels voxels;                      // empty if no light moves
  };
  // The view cell of the eye; null if the path has no eye in it, and all lights are kept.
  const ViewCell* at(const Vec3d& eye) const;
  // `light`: from the frame, with its index there.
  bool keeps(const ViewCell& cell, std::uint32_t index, const scene::WorldLight& light) const;

  std::size_t view_cell_count() const { return cells_.size(); }
  std::uint64_t bytes() const;
  double build_ns() const { return build_ns_; }

 private:
  void find_moving(const scene::Scene& scene, const scene::CameraPath& path);
  ViewCell view_cell_of(const Voxels& empty, std::span<const depth::WorldRay> rays) const;

  VisibleSetStep step_;
  std::vector<scene::WorldLight> lights_;  // from the first frame
  std::vector<bool> moves_;
  bool any_moves_ = false;
  Vec3d lo_{0.0}, hi_{0.0};  // around the reach of all bounded lights over the path
  std::map<VoxelIndex, ViewCell> cells_;
  double build_ns_ = 0.0;
};

}  // namespace clusterbench::cull
