#include "scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <regex>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "scene/digests.h"

namespace clusterbench::scene {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// The keys that move some of these nodes: their own and those of all nodes above them.
class KeysOf {
 public:
  explicit KeysOf(const Scene& scene) : scene_(scene), is_wanted_(scene.nodes.size(), false) {}

  void add(int node) {
    for (; node >= 0 && !is_wanted_[static_cast<std::size_t>(node)];
         node = scene_.nodes[static_cast<std::size_t>(node)].parent)
      is_wanted_[static_cast<std::size_t>(node)] = true;
  }
  // The first and the last key of each channel, or all. Visibility moves no eye.
  std::set<double> keys(bool all, bool visibility) const {
    std::set<double> keys;
    for (const Channel& channel : scene_.channels)
      if (is_wanted_[static_cast<std::size_t>(channel.node)] && (visibility || channel.path != ChannelPath::visible))
        add_keys(channel, all, keys);
    return keys;
  }
  static void add_keys(const Channel& channel, bool all, std::set<double>& keys) {
    keys.insert({channel.times_s.front(), channel.times_s.back()});
    if (all) keys.insert(channel.times_s.begin(), channel.times_s.end());
  }

 private:
  const Scene& scene_;
  std::vector<bool> is_wanted_;
};

std::set<double> keys_of_lights(const Scene& scene, bool all) {
  KeysOf lights(scene);
  for (const Light& light : scene.lights) lights.add(light.node);
  std::set<double> keys = lights.keys(all, true);
  for (const Channel& channel : scene.light_channels) KeysOf::add_keys(channel, all, keys);
  return keys;
}

// The keys that move the camera; for a fixed camera, the keys of the lights. `all`, or at least the first and the last.
std::set<double> keys_seen(const Scene& scene, const Camera& camera, bool all) {
  KeysOf eye(scene);
  eye.add(camera.node);
  std::set<double> keys = eye.keys(all, false);
  for (const Channel& channel : scene.camera_channels)
    if (channel.definition == camera.definition) KeysOf::add_keys(channel, all, keys);
  if (!keys.empty()) return keys;
  return keys_of_lights(scene, all);
}

CameraMoments equal_steps(double from, double to, int count) {
  CameraMoments moments;
  for (int i = 0; i < count; ++i) moments.times_s.push_back(count == 1 ? from : from + (to - from) * i / (count - 1));
  moments.how = number_of(static_cast<std::uint64_t>(count), "equal step") + " over " + number(to - from) + " s";
  return moments;
}

// The times that a request chooses between the first and the last key.
CameraMoments moments_of(const std::set<double>& keys, const PathRequest& request) {
  if (keys.empty()) return {{0.0}, "nothing moves: one frame"};
  const double from = *keys.begin(), to = *keys.rbegin();
  if (from == to) return {{from}, "one key: one frame"};
  if (request.choice == FrameChoice::keys)
    return {{keys.begin(), keys.end()}, std::to_string(keys.size()) + " keys over " + number(to - from) + " s"};
  if (request.choice == FrameChoice::count) return equal_steps(from, to, request.count);
  constexpr double k_most_frames = 1e6;
  const double steps = std::floor((to - from) * request.rate_hz + 1e-9);
  if (!(steps < k_most_frames))
    throw Error("", "frames", "at " + number(request.rate_hz) + " per second are more than a million");
  CameraMoments moments;
  for (int i = 0; i <= static_cast<int>(steps); ++i) moments.times_s.push_back(from + i / request.rate_hz);
  moments.how = number(request.rate_hz) + " per second over " + number(to - from) + " s";
  return moments;
}

// Sets the angle on a rectangle wider than any picture, which every picture contains completely.
void set_field_of_view(CameraProjection& projection, const PathRequest& request) {
  if (!request.field_of_view || projection.orthographic || projection.sides) return;
  const FieldOfView& view = *request.field_of_view;
  projection.yfov_rad = view.angle_rad;
  projection.aspect_ratio.reset();
  if (!view.is_horizontal) return;
  projection.yfov_rad = 2.0 * std::atan(std::tan(view.angle_rad / 2.0) / k_widest_picture);
  projection.aspect_ratio = k_widest_picture;
  projection.fit = CameraFit::contain;
}

void set_far(CameraProjection& projection, const PathRequest& request, const Scene& scene, const std::string& camera) {
  if (!request.far_m) return;
  projection.far_m = *request.far_m;
  if (projection.far_m <= projection.near_m)
    throw Error(scene.path.string(), "far",
                number(projection.far_m) + " m is not behind the near plane of camera '" + camera + "', " +
                    number(projection.near_m) + " m");
}

CameraPath path_of(const Scene& scene, const Camera& camera, const PathRequest& request) {
  const CameraMoments moments = camera_moments(scene, camera, request);
  CameraPath path{camera.name, false, moments.how, {}, camera_digest(scene, camera)};
  for (const double time : moments.times_s) {
    path.shots.push_back({time, camera_pose(scene, camera, time), projection_at(scene, camera, time)});
    path.shots.back().projection.fit = request.fit;
    set_field_of_view(path.shots.back().projection, request);
    set_far(path.shots.back().projection, request, scene, camera.name);
  }
  return path;
}

// The box around the positions of all point and spot lights at the start.
struct Extent {
  Vec3d lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};
};

Extent light_positions(const Scene& scene) {
  const std::vector<WorldLight> lights = world_lights(scene, 0.0);
  const auto reaches = [](const WorldLight& light) { return light.range_m > 0.0; };
  const bool reaches_any = std::ranges::any_of(lights, reaches);  // lights without reach do not count
  Extent extent;
  for (const WorldLight& light : lights) {
    if (reaches_any && !reaches(light)) continue;
    extent.lo = glm::min(extent.lo, light.position);
    extent.hi = glm::max(extent.hi, light.position);
  }
  return extent;
}

// Looks along `forward` (horizontal, unit), y up.
CameraPose level_pose(const Vec3d& eye, const Vec3d& forward) {
  const Vec3d right{-forward.z, 0.0, forward.x};
  return {eye, glm::transpose(Mat3d(right, Vec3d(0.0, 1.0, 0.0), -forward))};
}

// A closed walk on an ellipse half as large as the lights' box, at eye height above its floor, looking along the way.
CameraPath path_around_lights(const Scene& scene, const PathRequest& request) {
  constexpr double k_eye_height_m = 1.7, k_half_turn = 3.14159265358979323846, k_smallest_half_axis_m = 1.0;
  const Extent extent = light_positions(scene);
  if (!(extent.lo.x <= extent.hi.x))
    throw Error(scene.path.string(), "",
                "has neither a camera nor a point or spot light to look at" +
                    (why_no_lights(scene).empty() ? "" : ": " + why_no_lights(scene)));
  const Vec3d middle = 0.5 * (extent.lo + extent.hi), half = 0.25 * (extent.hi - extent.lo);
  const double a = std::max(half.x, k_smallest_half_axis_m), b = std::max(half.z, k_smallest_half_axis_m);
  const double height = std::min(extent.lo.y + k_eye_height_m, std::max(extent.hi.y, extent.lo.y));
  const int count = request.choice == FrameChoice::count ? request.count : 60;

  CameraProjection projection;
  projection.yfov_rad = k_half_turn / 3.0;
  projection.far_m = std::numeric_limits<double>::infinity();
  set_field_of_view(projection, request);
  set_far(projection, request, scene, "around-lights");
  CameraPath path{"around-lights",
                  true,
                  "no camera in the file: a walk of " + std::to_string(count) + " frames around the lights",
                  {}};
  for (int i = 0; i < count; ++i) {
    const double turn = 2.0 * k_half_turn * i / count, time = scene.duration_s * i / count;
    const Vec3d eye{middle.x + a * std::cos(turn), height, middle.z + b * std::sin(turn)};
    const Vec3d forward = glm::normalize(Vec3d{-a * std::sin(turn), 0.0, b * std::cos(turn)});
    path.shots.push_back({time, level_pose(eye, forward), projection});
  }
  return path;
}

const Camera& camera_named(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const Camera& camera : scene.cameras) {
    if (camera.name == name) return camera;
    names.push_back(camera.name);
  }
  throw Error(scene.path.string(), "camera",
              "has no camera '" + name + "'" + did_you_mean(name, names) +
                  (names.empty() ? "; it has none" : "; it has: " + joined(names)));
}

std::vector<CameraPath> paths_without_jitter(const Scene& scene, const PathRequest& request) {
  const bool is_every = request.camera == "*";
  if (!request.camera.empty() && !is_every) return {path_of(scene, camera_named(scene, request.camera), request)};
  for (const Camera& camera : scene.cameras)
    if (camera.animated && !is_every) return {path_of(scene, camera, request)};
  std::vector<CameraPath> paths;
  for (const Camera& camera : scene.cameras) paths.push_back(path_of(scene, camera, request));
  if (paths.empty()) paths.push_back(path_around_lights(scene, request));
  return paths;
}

}  // namespace

CameraMoments camera_moments(const Scene& scene, const Camera& camera, const PathRequest& request) {
  CameraMoments moments = moments_of(keys_seen(scene, camera, request.choice == FrameChoice::keys), request);
  moments.how = (camera.animated ? "animated camera, " : "static camera, ") + moments.how;
  return moments;
}

std::vector<CameraPath> camera_paths(const Scene& scene, const PathRequest& request) {
  std::vector<CameraPath> paths = paths_without_jitter(scene, request);
  if (!request.jitter_px.empty())
    for (CameraPath& path : paths)
      for (std::size_t i = 0; i < path.shots.size(); ++i)
        path.shots[i].jitter_px = request.jitter_px[i % request.jitter_px.size()];
  return paths;
}

std::vector<std::string> cameras_left_out(const Scene& scene, const PathRequest& request) {
  std::vector<std::string> names;
  const auto first =
      std::find_if(scene.cameras.begin(), scene.cameras.end(), [](const Camera& c) { return c.animated; });
  if (!request.camera.empty() || first == scene.cameras.end()) return names;
  for (auto camera = scene.cameras.begin(); camera != scene.cameras.end(); ++camera)
    if (camera != first) names.push_back(camera->name + (camera->animated ? "" : " (static)"));
  return names;
}

std::optional<double> last_change_of_lights_s(const Scene& scene) {
  const std::set<double> keys = keys_of_lights(scene, false);
  return keys.empty() ? std::nullopt : std::optional(*keys.rbegin());
}

std::optional<FieldOfView> field_of_view(const std::string& text) {
  static const std::regex form("([0-9]{1,3}(?:\\.[0-9]{1,9})?)([hv])");
  std::smatch found;
  if (!std::regex_match(text, found, form)) return std::nullopt;
  const double degrees = std::stod(found[1]);
  if (!(degrees > 0.0 && degrees < 180.0)) return std::nullopt;
  return FieldOfView{degrees * 3.14159265358979323846 / 180.0, found[2] == "h"};
}

}  // namespace clusterbench::scene
