#pragma once
// The measure of frames that are not of the recorded path.

#include <optional>
#include <vector>

#include "search/frame_measure.h"
#include "search/path_scene.h"

namespace clusterbench::search {

// Measures single frames; one object for each task.
class FrameRater {
 public:
  FrameRater(const config::Config& config, const run::CasePlan& plan, Measure measure, const LightRig& rig,
             const scene::CameraProjection& projection)
      : rig_(rig),
        request_(config.scenes[plan.scene].camera),
        viewport_(config.viewports[plan.viewport]),
        scene_(rig.scene(1, projection)),
        meter_(config, plan, measure) {}

  double rate(const FrameChoice& choice) {
    rig_.set_frame(scene_, 0, choice);
    const scene::CameraPath path = path_of(scene_, request_);
    return meter_.value({scene_, path, viewport_}, 0);
  }
  std::optional<double> theoretical_max() const { return meter_.theoretical_max(); }
  std::vector<assign::BufferNeed> buffers() const { return meter_.buffers(); }

 private:
  const LightRig& rig_;
  const scene::PathRequest& request_;
  Vec2i viewport_;
  scene::Scene scene_;
  FrameMeter meter_;
};

}  // namespace clusterbench::search
