#pragma once
// The lights of a camera path's frames, found once for all grids and passes: how far they reach, and which are in view.

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "run/cases/light_reach.h"
#include "scene/camera_path.h"
#include "scene/scene.h"
#include "view/frame.h"

namespace clusterbench::run {

struct PathLights {
  LightReach reach;
  view::Projection shape;  // of the first frame: all frames have the same number of cells in a shape
  // Of all frames; null if they differ in their lights.
  std::shared_ptr<const std::vector<scene::WorldLight>> lights;
  // grid::lights_in_view() of each frame; none if they would take more than `most_bytes`.
  std::vector<std::vector<bool>> in_view;

  std::size_t bytes() const;

  static constexpr std::size_t k_most_bytes = std::size_t{16} << 20;
};

// The frame of a path's shot. `lights`: of all frames; null if they differ in their lights.
view::Frame frame_of_shot(const scene::Scene& scene, const scene::CameraPath& path, int shot, Vec2i viewport,
                          const std::vector<scene::WorldLight>* lights);

// Results do not depend on `threads`.
PathLights path_lights(const scene::Scene& scene, const scene::CameraPath& path, Vec2i viewport, int threads,
                       std::size_t most_bytes = PathLights::k_most_bytes);

// Those of a scene's paths. Several threads may ask: they wait for one another. The last ones are kept while they fit
// into k_most_bytes; the last one always is.
class PathLightsOfScene {
 public:
  // `camera`: index of the path, which never changes.
  std::shared_ptr<const PathLights> of(const scene::Scene& scene, const scene::CameraPath& path, std::size_t camera,
                                       Vec2i viewport, int threads);

  int times_found() const { return times_found_; }

 private:
  struct Kept {
    std::size_t camera;
    Vec2i viewport;
    std::shared_ptr<const PathLights> lights;
  };

  std::mutex finding_;
  std::deque<Kept> kept_;  // the oldest first
  int times_found_ = 0;
};

}  // namespace clusterbench::run
