#pragma once
// Which moments of which camera become frames.

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace clusterbench::scene {

enum class FrameChoice : std::uint8_t { count, rate, keys };

// In place of the file's, for perspective cameras whose picture is not off-centre.
struct FieldOfView {
  double angle_rad = 0.0;
  bool is_horizontal = false;  // across the picture, whatever its height; else up and down
};
// "90h" or "60v": degrees across, or up and down. Nothing for anything else, and for what is not above 0 and below 180.
std::optional<FieldOfView> field_of_view(const std::string& text);
// Of pictures up to so many times as wide as high a horizontal field of view is met exactly.
inline constexpr double k_widest_picture = 64.0 / 9.0;

struct PathRequest {
  // Name; "*" = every camera; "" = default: first animated, else each static one, else a path that the tool makes.
  std::string camera;
  FrameChoice choice = FrameChoice::count;
  int count = 60;  // N equal steps from the first to the last key
  // Of a count: fewer, so that frames times the lights that reach a point of their view are at most so many; 0: as many
  // as asked for.
  double most_lights = 0.0;
  double rate_hz = 30.0;
  CameraFit fit = CameraFit::contain;
  std::optional<FieldOfView> field_of_view{};
  std::optional<double> far_m{};   // in place of the file's
  std::vector<Vec2d> jitter_px{};  // a Shot's, frame by frame and then from the first again; empty: none
};

// One moment of one camera.
struct Shot {
  double time_s = 0.0;
  CameraPose pose;
  CameraProjection projection;
  Vec2d jitter_px{0.0};  // the picture is moved by so many pixels to the right and down, as for TAA
};

struct CameraPath {
  std::string camera;  // the camera's name; "around-lights" for a made path
  bool made = false;   // made by the tool, not in the file
  std::string how;     // one line for the result: "animated camera 'walk', 60 equal steps over 12 s"
  std::vector<Shot> shots;
  std::string digest = {};  // digests.h; "" of a made one
};

// When a camera is looked through: times, and one line that says which.
struct CameraMoments {
  std::vector<double> times_s;
  std::string how;  // "animated camera, 60 equal steps over 12 s"
};
CameraMoments camera_moments(const Scene& scene, const Camera& camera, const PathRequest& request);

// A static camera gives one shot (more if lights are animated). Throws Error naming the cameras that exist when
// request.camera is none of them, and when the scene has neither camera nor light.
std::vector<CameraPath> camera_paths(const Scene& scene, const PathRequest& request);
// Cameras that the default leaves out, by name; static ones say so.
std::vector<std::string> cameras_left_out(const Scene& scene, const PathRequest& request);

// When lights last move or change; none where they never do.
std::optional<double> last_change_of_lights_s(const Scene& scene);

// So many points of the Halton sequence in bases 2 and 3, from its first, less a half: offsets within a pixel.
std::vector<Vec2d> halton_jitter(int count);

}  // namespace clusterbench::scene
