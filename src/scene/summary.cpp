#include "scene/summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>

#include "core/text.h"
#include "geom/shapes/domain.h"
#include "scene/camera_path.h"
#include "scene/domain_check.h"

namespace clusterbench::scene {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr int k_moments = 16;  // at which animated lights and cameras are sampled

std::string four_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

bool is_assigned(const Light& light) {
  return light.type != LightType::directional;
}

// A light or camera of a warning, and how many there are: there may be millions.
struct Counted {
  std::size_t count = 0;
  std::string first;

  void push_back(const std::string& name) {
    if (count++ == 0) first = name;
  }
};

// "12 lights ...: first 'lamp 3'"; no warning without lights.
void warn_of(Summary& summary, const Counted& lights, const std::string& problem) {
  if (lights.count == 0) return;
  summary.warnings.push_back(std::to_string(lights.count) + (lights.count == 1 ? " light " : " lights ") + problem +
                             ": " + (lights.count == 1 ? "'" : "first '") + lights.first + "'");
}

void count_lights(const Scene& scene, Summary& summary) {
  std::vector<double> ranges, made_ranges;
  for (const Light& light : scene.lights) {
    ++(light.type == LightType::point  ? summary.points
       : light.type == LightType::spot ? summary.spots
                                       : summary.directionals);
    if (!is_assigned(light)) continue;
    ranges.push_back(light.range_m);
    if (light.range_source != RangeSource::given) made_ranges.push_back(light.range_m);
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
  if (made_ranges.empty()) return;
  const auto [least, greatest] = std::minmax_element(made_ranges.begin(), made_ranges.end());
  summary.made_range_min_m = *least;
  summary.made_range_max_m = *greatest;
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

// Diagonal of the box around all lights' positions except the outermost twentieth on each side: one forgotten light far
// away should not make every range look small.
double usual_distance(const Scene& scene) {
  const std::vector<WorldLight> lights = world_lights(scene, 0.0);
  if (lights.empty()) return 0.0;
  Vec3d size{0.0};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> coordinates;
    for (const WorldLight& light : lights) coordinates.push_back(light.position[axis]);
    std::sort(coordinates.begin(), coordinates.end());
    const std::size_t outermost = coordinates.size() / 20;
    size[axis] = coordinates[coordinates.size() - 1 - outermost] - coordinates[outermost];
  }
  return glm::length(size);
}

void measure_bounds(const Scene& scene, Summary& summary) {
  Extent balls;
  for (const double time : moments(scene)) {
    const std::vector<WorldLight> lights = world_lights(scene, time);
    check_domain(scene, lights, time);
    for (const WorldLight& light : lights)
      if (std::isfinite(light.range_m)) balls.add(light.position, light.range_m);
  }
  if (balls.empty()) return;
  summary.bounds_lo = balls.lo;
  summary.bounds_hi = balls.hi;
}

// A camera with a larger aspect ratio does not fit into the widest usual viewport unless the view is enlarged.
constexpr double k_usual_aspect = 16.0 / 9.0;

// Half extents of the camera's own rectangle: slopes, or metres. Width 0: the viewport gives it.
struct HalfExtents {
  double width = 0.0, height = 0.0;
};

HalfExtents rectangle_of(const CameraProjection& projection) {
  if (projection.orthographic) return {projection.xmag_m, projection.ymag_m};
  const double height = std::tan(projection.yfov_rad / 2.0);
  return {projection.aspect_ratio.value_or(0.0) * height, height};
}

double degrees_between(double low_slope, double high_slope) {
  return (std::atan(high_slope) - std::atan(low_slope)) * 180.0 / 3.14159265358979323846;
}

// Of half an extent, as a slope.
std::string degrees_text(double half_extent) {
  return four_digits(degrees_between(-half_extent, half_extent));
}

std::string projection_text(const CameraProjection& projection) {
  const std::string reach = four_digits(projection.near_m) + " m to " +
                            (std::isinf(projection.far_m) ? "infinity" : four_digits(projection.far_m) + " m");
  if (projection.sides)
    return "perspective, off-centre: slopes " + four_digits(projection.sides->left) + " to " +
           four_digits(projection.sides->right) + " across, " + four_digits(projection.sides->bottom) + " to " +
           four_digits(projection.sides->top) + " up, " + "vertical FOV " +
           four_digits(degrees_between(projection.sides->bottom, projection.sides->top)) + "°, horizontal " +
           four_digits(degrees_between(projection.sides->left, projection.sides->right)) + "°, " + reach;
  const HalfExtents half = rectangle_of(projection);
  const bool is_wide = half.width > 1.01 * k_usual_aspect * half.height;
  const std::string shape = is_wide ? four_digits(half.width / half.height) + " times as wide, " : "";
  if (projection.orthographic)
    return "orthographic, " + four_digits(2.0 * projection.ymag_m) + " m high, " + shape + reach;
  const double width = half.width > 0.0 ? half.width : k_usual_aspect * half.height;
  const bool is_usual = std::abs(width / (k_usual_aspect * half.height) - 1.0) < 0.01;
  return "perspective, vertical FOV " + degrees_text(half.height) + "°, horizontal " + degrees_text(width) + "°" +
         (is_usual ? " in 16:9" : "") + ", " + shape + reach;
}

// The sides of a projection's view, wider than for any picture in use (32:9) and as high as in a 16:9 picture that
// contains the camera's whole rectangle, so that no light is reported as out of reach that a camera could see.
ProjectionSides largest_view(const CameraProjection& projection) {
  if (projection.sides) return *projection.sides;
  constexpr double k_widest = 32.0 / 9.0;
  const HalfExtents half = rectangle_of(projection);
  const double height = std::max(half.height, half.width / k_usual_aspect);
  const double width = std::max(half.width, half.height * k_widest);
  return {-width, width, -height, height};
}

struct View {
  CameraPose pose;
  const CameraProjection& projection;
  ProjectionSides sides;
};

// Whether a light's ball reaches into the half-spaces of a view.
bool may_see(const View& view, const WorldLight& light) {
  const Vec3d p = view.pose.view_from_world * (light.position - view.pose.eye);
  const double depth = -p.z, r = light.range_m;
  if (depth + r < view.projection.near_m || depth - r > view.projection.far_m) return false;
  const auto beyond = [&](double across, double edge) {
    if (view.projection.orthographic) return across - edge;
    return (across - edge * depth) / std::sqrt(1.0 + edge * edge);
  };
  return beyond(p.x, view.sides.right) <= r && beyond(-p.x, -view.sides.left) <= r &&
         beyond(p.y, view.sides.top) <= r && beyond(-p.y, -view.sides.bottom) <= r;
}

// The lights (indices in Scene::lights) that some camera can see at some moment.
struct Sight {
  std::vector<bool> is_seen;
  bool is_known = true;  // false: too many cameras and lights for the test
  bool is_whole = true;  // every frame of every path was tested
};

// Limits of the test: pairs of a light and a moment of a camera, and nodes whose positions are computed. More would
// take longer than a second.
constexpr double k_max_tests = 2e7, k_max_transforms = 4e6;

// The moments of all cameras, reduced so that the test stays fast: time -> cameras.
std::map<double, std::vector<std::size_t>> sampled_moments(const Scene& scene,
                                                           const std::vector<CameraMoments>& moments, Sight& sight) {
  double all = 0.0;
  std::set<double> times;
  for (const CameraMoments& camera : moments) {
    all += static_cast<double>(camera.times_s.size());
    times.insert(camera.times_s.begin(), camera.times_s.end());
  }
  const double lights = static_cast<double>(scene.lights.size());
  const double placed = static_cast<double>(scene.nodes.size() + scene.channels.size());
  const double share =
      std::max(all * lights / k_max_tests, static_cast<double>(times.size()) * placed / k_max_transforms);
  const auto stride = static_cast<std::size_t>(std::ceil(std::max(share, 1.0)));
  sight.is_known = static_cast<double>(moments.size()) * lights <= k_max_tests;
  sight.is_whole = stride == 1;
  std::map<double, std::vector<std::size_t>> out;
  if (!sight.is_known) return out;
  for (std::size_t i = 0; i < moments.size(); ++i)
    for (std::size_t k = 0; k < moments[i].times_s.size(); k += stride) out[moments[i].times_s[k]].push_back(i);
  return out;
}

// All cameras at one time share the lights' positions.
void mark_visible_lights(const Scene& scene, double time_s, const std::vector<std::size_t>& cameras, Sight& sight) {
  std::vector<WorldLight> unseen = world_lights(scene, time_s);
  // For many cameras, the transforms of all nodes at once; for few, that would waste memory.
  constexpr std::size_t k_few_cameras = 16;
  const std::vector<Mat4d> world =
      cameras.size() > k_few_cameras ? world_transforms(scene, time_s) : std::vector<Mat4d>();
  check_domain(scene, unseen, time_s);
  for (const std::size_t index : cameras) {
    const Camera& camera = scene.cameras[index];
    const CameraProjection projection = projection_at(scene, camera, time_s);
    const Mat4d* transform = world.empty() ? nullptr : &world[static_cast<std::size_t>(camera.node)];
    const bool is_flat = transform == nullptr || glm::determinant(Mat3d(*transform)) == 0.0;
    const CameraPose pose = is_flat ? camera_pose(scene, camera, time_s) : camera_pose(*transform);
    const View view{pose, projection, largest_view(projection)};
    check_domain(scene, camera.name, Shot{time_s, view.pose, projection});
    std::erase_if(unseen, [&](const WorldLight& light) {
      const auto rig_index = static_cast<std::size_t>(light.rig_index);
      if (!(light.range_m > 0.0)) return true;  // invisible, at least at this time
      if (!sight.is_seen[rig_index]) sight.is_seen[rig_index] = may_see(view, light);
      return bool{sight.is_seen[rig_index]};
    });
  }
}

void mark_visible_on_made_path(const Scene& scene, Summary& summary, Sight& sight) {
  const CameraPath path = camera_paths(scene, {}).front();
  check_domain(scene, path);
  summary.cameras.push_back(path.camera + ": " + projection_text(path.shots.front().projection) + "; " + path.how);
  for (const Shot& shot : path.shots) {
    const View view{shot.pose, shot.projection, largest_view(shot.projection)};
    for (const WorldLight& light : world_lights(scene, shot.time_s))
      if (may_see(view, light)) sight.is_seen[static_cast<std::size_t>(light.rig_index)] = true;
  }
}

// The moments of this summary; without a configuration `run` and `size` use others, fewer or more.
std::string moments_text(const CameraMoments& moments) {
  return moments.how + (moments.times_s.size() > 1 ? " (here; run and size choose theirs)" : "");
}

// Cameras' lines, and the lights that they see.
Sight sight_of_cameras(const Scene& scene, Summary& summary) {
  Sight sight;
  sight.is_seen.assign(scene.lights.size(), false);
  std::vector<CameraMoments> moments;
  for (const Camera& camera : scene.cameras) {
    moments.push_back(camera_moments(scene, camera, {}));
    summary.cameras.push_back(camera.name + ": " + projection_text(camera.projection) + "; " +
                              moments_text(moments.back()));
  }
  for (const auto& [time, cameras] : sampled_moments(scene, moments, sight))
    mark_visible_lights(scene, time, cameras, sight);
  const bool can_make_a_path = summary.points + summary.spots > 0;
  if (scene.cameras.empty() && can_make_a_path) mark_visible_on_made_path(scene, summary, sight);
  return sight;
}

// `run` rejects them.
void warn_of_steep_cameras(const Scene& scene, Summary& summary) {
  for (const Camera& camera : scene.cameras) {
    const HalfExtents half = rectangle_of(camera.projection);
    if (!camera.projection.orthographic && !camera.projection.sides &&
        std::max(half.width, half.height) > geom::k_steepest_slope)
      summary.warnings.push_back("camera '" + camera.name +
                                 "' shows more than 89.9994 degrees to one side and can not be measured");
  }
}

void warn_of_lights(const Scene& scene, const Sight& sight, Summary& summary) {
  Counted without_range, useless, black, unseen;
  const double diagonal = usual_distance(scene);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    const bool is_black = light.intensity == 0.0 || light.color == Vec3d(0.0);
    if (is_black || light.range_m == 0.0) black.push_back(light.name);
    if (!is_assigned(light)) continue;
    if (!light.range_given_m) without_range.push_back(light.name);
    if (summary.points + summary.spots > 1 && light.range_m > diagonal) useless.push_back(light.name);
    if (light.range_m > 0.0 && !sight.is_seen[i]) unseen.push_back(light.name);
  }
  warn_of(summary, without_range, "without range (the rule of the configuration gives one)");
  if (2 * summary.ranges_clamped > summary.points + summary.spots)
    summary.warnings.push_back("most ranges are the range rule's longest (--max-range): " +
                               number_of(static_cast<std::uint64_t>(summary.ranges_clamped), "light") +
                               " would shine farther at its cut-off (--cutoff-lux); give them ranges, or your engine's "
                               "cut-off");
  warn_of(summary, useless, "reaching farther than the lights are apart, for which clustering is useless");
  warn_of(summary, black, "black or of no range");
  if (sight.is_known)
    warn_of(summary, unseen,
            std::string("never within any camera's reach, over ") +
                (sight.is_whole ? "the frames of its path" : "some evenly spaced frames of its path"));
  else
    summary.warnings.push_back("too many cameras and lights to tell which lights no camera reaches");
}

}  // namespace

Summary summarise(const Scene& scene) {
  Summary summary;
  summary.warnings = scene.warnings;
  count_lights(scene, summary);
  measure_bounds(scene, summary);
  const Sight sight = sight_of_cameras(scene, summary);
  warn_of_steep_cameras(scene, summary);
  warn_of_lights(scene, sight, summary);
  if (const std::string why = why_no_lights(scene); !why.empty()) summary.warnings.push_back(why);
  return summary;
}

}  // namespace clusterbench::scene
