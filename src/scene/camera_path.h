#pragma once
// The choice of cameras and moments that become frames.

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace clusterbench::scene {

enum class FrameChoice : std::uint8_t { count, rate, keys };

// Replaces the file's, for perspective cameras whose picture is not off-centre.
struct FieldOfView {
  double angle_rad = 0.0;
  bool is_horizontal = false;  // else vertical
};
// "90h" or "60v": degrees across, or up and down. nullopt for other texts, and for angles outside 0 to 180.
std::optional<FieldOfView> field_of_view(const std::string& text);
// A horizontal field of view is exact for pictures up to this aspect ratio.
inline constexpr double k_widest_picture = 64.0 / 9.0;

struct PathRequest {
  // Name; "*" = every camera; "" = default: first animated, else each static one, else a path that the tool makes.
  std::string camera;
  FrameChoice choice = FrameChoice::count;
  int count = 60;  // N equal steps from the first to the last key
  // For a count: reduces it, so that frames times the lights that reach a point of their view are at most this number;
  // 0: no reduction.
  double most_lights = 0.0;
  double rate_hz = 30.0;
  CameraFit fit = CameraFit::contain;
  std::optional<FieldOfView> field_of_view{};
  std::optional<double> far_m{};   // replaces the file's
  std::vector<Vec2d> jitter_px{};  // see Shot; one entry per frame, then from the first again; empty: none
};

// One moment of one camera.
struct Shot {
  double time_s = 0.0;
  CameraPose pose;
  CameraProjection projection;
  Vec2d jitter_px{0.0};  // the picture is moved by this many pixels to the right and down, as for TAA
};

struct CameraPath {
  std::string camera;  // the camera's name; "around-lights" for a made path
  bool made = false;   // made by the tool, not in the file
  std::string how;     // one line for the result: "animated camera 'walk', 60 equal steps over 12 s"
  std::vector<Shot> shots;
  std::string digest = {};  // digests.h; "" for a made path
};

// The moments of a camera: times, and one line that describes them.
struct CameraMoments {
  std::vector<double> times_s;
  std::string how;  // "animated camera, 60 equal steps over 12 s"
};
CameraMoments camera_moments(const Scene& scene, const Camera& camera, const PathRequest& request);

// A static camera gives one shot (more if lights are animated). Throws Error if request.camera is unknown, with the
// names of the existing cameras, and if the scene has neither camera nor light.
std::vector<CameraPath> camera_paths(const Scene& scene, const PathRequest& request);
// Names of the cameras that the default leaves out; static ones are marked.
std::vector<std::string> cameras_left_out(const Scene& scene, const PathRequest& request);

// Time of the last move or change of lights; none if they never change.
std::optional<double> last_change_of_lights_s(const Scene& scene);

}  // namespace clusterbench::scene
