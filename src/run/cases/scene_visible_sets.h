#pragma once
// Potentially visible sets of a scene (cull/visible_sets.h), each built once for all grids, viewports and passes.

#include <memory>
#include <mutex>
#include <vector>

#include "cull/visible_sets.h"

namespace clusterbench::run {

// Sets of one scene. Nothing is built before the first request. Several threads may request sets: each is built once.
class SceneVisibleSets {
 public:
  // Both must outlive this object.
  SceneVisibleSets(const scene::Scene& scene, const scene::Geometry& geometry) : scene_(scene), geometry_(geometry) {}

  std::shared_ptr<const cull::VisibleSets> of(const scene::CameraPath& path, const cull::VisibleSetStep& step,
                                              std::uint64_t seed, int threads);

 private:
  // The key of a set: paths with the same eyes at the same times share one.
  struct Eye {
    double time_s;
    Vec3d place;

    friend bool operator==(const Eye&, const Eye&) = default;
  };
  struct Kept {
    std::vector<Eye> eyes;
    cull::VisibleSetStep step;
    std::uint64_t seed;
    std::shared_ptr<const cull::VisibleSets> sets;
  };

  const scene::Scene& scene_;
  const scene::Geometry& geometry_;
  std::mutex building_;
  std::vector<Kept> kept_;
};

}  // namespace clusterbench::run
