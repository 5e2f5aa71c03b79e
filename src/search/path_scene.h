#pragma once
// A scene with only lights and one camera, which has another pose in each frame: the input of a search's measurements,
// and its output file. Between frames nothing moves (glTF's interpolation STEP), so that any choice of frames gives the
// same.

#include <optional>
#include <utility>
#include <vector>

#include "core/single_precision.h"
#include "scene/camera_path.h"
#include "scene/scene.h"

namespace clusterbench::search {

// The nearest single-precision number, as in glTF's animations.
using clusterbench::rounded_to_float;
Vec3d rounded_to_float(const Vec3d& value);
Vec4d rounded_to_float(const Vec4d& value);

// One frame. All its numbers are in single precision.
struct FrameChoice {
  Vec3d eye{0.0};
  Vec4d rotation{0.0, 0.0, 0.0, 1.0};  // of the camera's node
  std::size_t moment = 0;              // of LightRig
  std::vector<Vec3d> extra_lights;     // their positions
  // Moved lights of the scene: index in LightRig, position. Ascending, each once.
  std::vector<std::pair<std::size_t, Vec3d>> moved;
};

// A scene's point and spot lights in the world, at the moments of a camera path.
class LightRig {
 public:
  // `extra_ranges_m`: of the point lights that a search adds. `may_move`: it also moves the scene's own lights.
  LightRig(const scene::Scene& scene, const scene::CameraPath& path, const std::vector<double>& extra_ranges_m,
           bool may_move);

  // Number of different moments: 1 if no light changes along the path. At most k_most_moments, evenly spaced.
  std::size_t moments() const { return states_.size(); }
  static constexpr int k_most_moments = 256;
  // The moment of a frame of the path; if it was left out, the last kept one before it.
  std::size_t moment_of(std::size_t frame) const;
  std::size_t own_lights() const { return own_; }
  const Vec3d& position(std::size_t moment, std::size_t light) const { return states_[moment][light].position; }

  bool reaches_something(std::size_t moment, std::size_t light) const { return states_[moment][light].range_m > 0.0; }

  // A scene with room for this many frames; set_frame() fills them. The name of its camera is `worst-case`.
  scene::Scene scene(std::size_t frames, const scene::CameraProjection& projection) const;
  void set_frame(scene::Scene& scene, std::size_t frame, const FrameChoice& choice) const;

 private:
  struct State {
    Vec3d position{0.0};
    Vec4d rotation{0.0, 0.0, 0.0, 1.0};
    double range_m = 0.0, outer_cone_rad = 0.0;
  };
  struct Changes {
    bool position = false, rotation = false, range = false, cone = false;
  };

  void find_changes(bool may_move);
  void round_changing();

  std::vector<scene::Light> lights_;        // without directional ones, followed by the extra ones
  std::size_t own_ = 0;                     // number of the scene's lights
  std::vector<std::size_t> moment_frames_;  // frame of each moment
  std::vector<std::vector<State>> states_;  // by moment, by light of the scene
  std::vector<Changes> changes_;            // by light of the scene: over the moments
};

// The frames of such a scene, each once.
scene::CameraPath path_of(const scene::Scene& path_scene, const scene::PathRequest& request);

}  // namespace clusterbench::search
