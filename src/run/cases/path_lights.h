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

using SharedLights = std::shared_ptr<const std::vector<scene::WorldLight>>;

// A scene's lights at all times, of which `time_s` is one; null if they change. Throws Error for lights outside of the
// domain.
SharedLights find_static_lights(const scene::Scene& scene, double time_s);

struct PathLights {
  LightReach reach;
  view::Projection shape;      // of the first frame: all frames have the same number of cells in a shape
  SharedLights static_lights;  // find_static_lights() of the scene
  // grid::lights_in_view() of each frame; none if they would take more than `most_bytes`.
  std::vector<std::vector<bool>> in_view;

  std::size_t bytes_in_view() const;

  static constexpr std::size_t k_most_bytes = std::size_t{4} << 20;
};

// The frame of a path's shot. `static_lights`: as in PathLights.
view::Frame frame_of_shot(const scene::Scene& scene, const scene::CameraPath& path, int shot, Vec2i viewport,
                          const SharedLights& static_lights);

// Results do not depend on `threads`.
PathLights path_lights(const scene::Scene& scene, const scene::CameraPath& path, Vec2i viewport,
                       const SharedLights& static_lights, int threads,
                       std::size_t most_bytes = PathLights::k_most_bytes);

// Those of a scene's paths, which never change once they were asked for. Several threads may ask: who asks for the same
// view waits. The last ones are kept as long as their lights in view take at most `most_bytes`; the last one always is.
class PathLightsOfScene {
 public:
  explicit PathLightsOfScene(std::size_t most_bytes = 2 * PathLights::k_most_bytes) : most_bytes_(most_bytes) {}

  // `camera`: index of the path.
  std::shared_ptr<const PathLights> of(const scene::Scene& scene, const scene::CameraPath& path, std::size_t camera,
                                       Vec2i viewport, int threads);

  int times_found() const { return times_found_; }

 private:
  struct View {
    std::size_t camera;
    Vec2i viewport;
    std::mutex finding;
    std::shared_ptr<const PathLights> found;
  };

  // A new one if it is not kept.
  std::shared_ptr<View> view_of(std::size_t camera, Vec2i viewport);
  SharedLights static_lights_of(const scene::Scene& scene, const scene::CameraPath& path);
  void drop_oldest();

  std::size_t most_bytes_;
  std::mutex changing_;                     // all below
  std::deque<std::shared_ptr<View>> kept_;  // the oldest first
  int times_found_ = 0;
  bool knows_static_lights_ = false;
  SharedLights static_lights_;
};

}  // namespace clusterbench::run
