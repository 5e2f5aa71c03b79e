#include "scene/summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "scene/camera_path.h"

namespace clusterbench::scene {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr int k_moments = 16;  // at which animated lights and cameras are looked at

std::string four_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

bool is_assigned(const Light& light) {
  return light.type != LightType::directional;
}

// "12 lights ...: first 'lamp 3'", or nothing.
void warn_of(Summary& summary, const std::vector<std::string>& names, const std::string& what) {
  if (names.empty()) return;
  summary.warnings.push_back(std::to_string(names.size()) + (names.size() == 1 ? " light " : " lights ") + what + ": " +
                             (names.size() == 1 ? "'" : "first '") + names.front() + "'");
}

void count_lights(const Scene& scene, Summary& summary) {
  std::vector<double> ranges;
  for (const Light& light : scene.lights) {
    ++(light.type == LightType::point  ? summary.points
       : light.type == LightType::spot ? summary.spots
                                       : summary.directionals);
    if (!is_assigned(light)) continue;
    ranges.push_back(light.range_m);
    ++(light.range_source == RangeSource::given            ? summary.ranges_given
       : light.range_source == RangeSource::clamped_to_max ? summary.ranges_clamped
                                                           : summary.ranges_from_intensity);
  }
  summary.boxes = static_cast<int>(scene.boxes.size());
  if (ranges.empty()) return;
  std::sort(ranges.begin(), ranges.end());
  summary.range_min_m = ranges.front();
  summary.range_median_m = ranges[ranges.size() / 2];
  summary.range_max_m = ranges.back();
}

std::vector<double> moments(const Scene& scene) {
  if (scene.duration_s == 0.0) return {0.0};
  std::vector<double> times;
  for (int i = 0; i < k_moments; ++i) times.push_back(scene.duration_s * i / (k_moments - 1));
  return times;
}

struct Extent {
  Vec3d lo{k_infinity}, hi{-k_infinity};

  void add(const Vec3d& p, double radius) {
    lo = glm::min(lo, p - radius);
    hi = glm::max(hi, p + radius);
  }
  bool empty() const { return !(lo.x <= hi.x); }
};

// Diagonal of the box that holds the places of all lights but the outermost twentieth on each side: one forgotten light
// far away shall not make every range look small.
double usual_distance(const Scene& scene) {
  const std::vector<WorldLight> lights = world_lights(scene, 0.0);
  if (lights.empty()) return 0.0;
  Vec3d size{0.0};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> places;
    for (const WorldLight& light : lights) places.push_back(light.position[axis]);
    std::sort(places.begin(), places.end());
    const std::size_t outermost = places.size() / 20;
    size[axis] = places[places.size() - 1 - outermost] - places[outermost];
  }
  return glm::length(size);
}

void measure_bounds(const Scene& scene, Summary& summary) {
  Extent balls;
  for (const double time : moments(scene))
    for (const WorldLight& light : world_lights(scene, time))
      if (std::isfinite(light.range_m)) balls.add(light.position, light.range_m);
  if (balls.empty()) return;
  summary.bounds_lo = balls.lo;
  summary.bounds_hi = balls.hi;
}

std::string lens_text(const Lens& lens) {
  const std::string reach =
      four_digits(lens.near_m) + " m to " + (std::isinf(lens.far_m) ? "infinity" : four_digits(lens.far_m) + " m");
  if (lens.orthographic) return "orthographic, " + four_digits(2.0 * lens.ymag_m) + " m high, " + reach;
  return "perspective, " + four_digits(lens.yfov_rad * 180.0 / 3.14159265358979323846) + " degrees high, " + reach;
}

// Does a light's ball reach into the half-spaces of a lens's view? The width is taken as for a picture of 32:9, wider
// than any in use, so that no light is called out of reach that a camera could see.
bool may_see(const Shot& shot, const WorldLight& light) {
  constexpr double k_widest = 32.0 / 9.0;
  const Vec3d p = shot.pose.view_from_world * (light.position - shot.pose.eye);
  const double depth = -p.z, r = light.range_m;
  if (depth + r < shot.lens.near_m || depth - r > shot.lens.far_m) return false;
  const double up = shot.lens.orthographic ? shot.lens.ymag_m : std::tan(shot.lens.yfov_rad / 2.0);
  const auto beyond = [&](double across, double edge) {
    if (shot.lens.orthographic) return across - edge;
    return (across - edge * depth) / std::sqrt(1.0 + edge * edge);
  };
  return beyond(std::abs(p.x), up * k_widest) <= r && beyond(std::abs(p.y), up) <= r;
}

// Cameras' lines, and which lights (places in Scene::lights) some camera can see at some moment.
std::vector<bool> look_through_cameras(const Scene& scene, Summary& summary) {
  std::vector<bool> is_seen(scene.lights.size(), false);
  const auto look = [&](const CameraPath& path) {
    summary.cameras.push_back(path.camera + ": " + lens_text(path.shots.front().lens) + "; " + path.how);
    for (const Shot& shot : path.shots)
      for (const WorldLight& light : world_lights(scene, shot.time_s))
        if (may_see(shot, light)) is_seen[static_cast<std::size_t>(light.rig_index)] = true;
  };
  for (const Camera& camera : scene.cameras) {
    PathRequest request;
    request.camera = camera.name;
    for (const CameraPath& path : camera_paths(scene, request)) look(path);
  }
  const bool can_make_a_path = summary.points + summary.spots > 0;
  if (scene.cameras.empty() && can_make_a_path) look(camera_paths(scene, {}).front());
  return is_seen;
}

void warn_of_lights(const Scene& scene, const std::vector<bool>& is_seen, Summary& summary) {
  std::vector<std::string> without_range, useless, black, unseen;
  const double diagonal = usual_distance(scene);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    const bool is_black = light.intensity == 0.0 || light.color == Vec3d(0.0);
    if (is_black || light.range_m == 0.0) black.push_back(light.name);
    if (!is_assigned(light)) continue;
    if (!light.range_given_m) without_range.push_back(light.name);
    if (summary.points + summary.spots > 1 && light.range_m > diagonal) useless.push_back(light.name);
    if (light.range_m > 0.0 && !is_seen[i]) unseen.push_back(light.name);
  }
  warn_of(summary, without_range, "without range (the rule of the configuration gives one)");
  warn_of(summary, useless, "reaching farther than the lights are apart, for which clustering is useless");
  warn_of(summary, black, "black or of no range");
  warn_of(summary, unseen, "never within any camera's reach, over the frames of its path");
}

}  // namespace

Summary summarise(const Scene& scene) {
  Summary summary;
  summary.warnings = scene.warnings;
  count_lights(scene, summary);
  measure_bounds(scene, summary);
  const std::vector<bool> is_seen = look_through_cameras(scene, summary);
  warn_of_lights(scene, is_seen, summary);
  return summary;
}

}  // namespace clusterbench::scene
