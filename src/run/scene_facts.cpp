#include "run/scene_facts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/text.h"
#include "scene/camera_path.h"
#include "scene/digests.h"
#include "view/frame.h"

namespace clusterbench::run {
namespace {

nlohmann::json rig_json(const scene::RigSpec& rig) {
  return {{"lights", rig.lights},
          {"spots", rig.spots},
          {"range", rig.range_m},
          {"size", {rig.size_m.x, rig.size_m.y, rig.size_m.z}},
          {"seed", rig.seed}};
}

// A line per viewport in which cameras are not seen as they are.
void add_fit_warnings(const SceneData& data, const std::vector<Vec2i>& viewports, std::vector<std::string>& warnings) {
  for (const Vec2i viewport : viewports) {
    std::string first;
    int count = 0;
    for (const scene::CameraPath& path : data.paths) {
      const std::string text = view::fit_warning(path.shots.front().projection, viewport);
      if (!text.empty() && count++ == 0) first = "camera '" + path.camera + "': " + text;
    }
    if (count > 1) first += " (and " + std::to_string(count - 1) + " more cameras)";
    if (count > 0) warnings.push_back(first);
  }
}

std::string first_names(std::vector<std::string> names) {
  constexpr std::size_t k_most = 8;
  if (names.size() <= k_most) return joined(names);
  const std::size_t more = names.size() - k_most;
  names.resize(k_most);
  return joined(names) + " and " + std::to_string(more) + " more";
}

// Frames end with the camera's last key.
std::string lights_after_path(const SceneData& data) {
  const std::optional<double> last_s = scene::last_change_of_lights_s(data.scene);
  std::string text;
  for (const scene::CameraPath& path : data.paths) {
    const double end_s = path.shots.back().time_s;
    const double step_s = path.shots.size() < 2 ? 0.0 : end_s - path.shots[path.shots.size() - 2].time_s;
    if (!last_s || path.made || *last_s <= end_s + step_s) continue;  // frames of a rate end less than a step before
    char line[160];
    std::snprintf(line, sizeof line, "%s '%.60s' at %g s", text.empty() ? "" : ",", path.camera.c_str(), end_s);
    text += line;
  }
  if (text.empty()) return "";
  char last[48];
  std::snprintf(last, sizeof last, "%g s", *last_s);
  return std::string("lights move or change until ") + last + ", and camera paths end before:" + text +
         "; what comes later is not measured (a key at the end of the camera's animation adds it)";
}

// If most lights are clamped, the run measures the rule's longest range rather than the file's lights.
std::string most_clamped(int clamped, int all, const scene::RangeRule& rule) {
  char text[240];
  std::snprintf(text, sizeof text,
                "%d of %d lights have no range and shine farther than %g m at %g lux: the range rule cuts them off "
                "there. Give them ranges, or your engine's cut-off (--cutoff-lux, --max-range)",
                clamped, all, rule.max_range_m, rule.cutoff_lux);
  return text;
}

std::string dark_text(const scene::DarkLights& of_scene, const scene::Scene& scene) {
  const auto [dark, without_range] = of_scene;
  const auto lights = std::ranges::count_if(scene.lights, [](const scene::Light& light) {
    return light.type == scene::LightType::point || light.type == scene::LightType::spot;
  });
  std::string out = std::to_string(dark) + " of " + number_of(static_cast<std::size_t>(lights), "light") +
                    (dark == 1 ? " is" : " are") + " dark (intensity 0, black, range 0, or invisible); ";
  if (without_range < dark)
    out +=
        "lists and all figures but lights_lit and lights_seen (and its mean) count those with a range, engines do not";
  if (without_range == 0) return out;
  return out + (without_range < dark ? "; " : "") + std::to_string(without_range) +
         (without_range == 1
              ? " reaches nothing (invisible all the time, or of intensity 0 without a range in the file): no list has "
                "it, and sizes are without it; with a range, and visible, it is sized for when it is on"
              : " reach nothing (invisible all the time, or of intensity 0 without a range in the file): no list has "
                "them, and sizes are without them; with ranges, and visible, they are sized for when they are on");
}

}  // namespace

std::string dark_lights(const SceneData& data) {
  const scene::DarkLights dark = scene::count_dark_lights(data.scene);
  return dark.all == 0 ? "" : dark_text(dark, data.scene);
}

SceneResult scene_result(const SceneData& data, const config::SceneRequest& request,
                         const std::vector<Vec2i>& viewports, int threads) {
  SceneResult out;
  if (request.rig) out.rig = rig_json(*request.rig);
  const scene::Scene& scene = data.scene;
  out.name = scene.name;
  out.sha256 = scene.sha256;
  out.warnings = scene.warnings;
  out.boxes = static_cast<int>(scene.boxes.size());
  out.light_digest = scene::light_digest(scene, threads);
  const scene::DarkLights dark = scene::count_dark_lights(scene, threads);
  out.dark = dark.all;
  int given = 0, from_intensity = 0, clamped = 0;
  std::vector<double> ranges;
  for (const scene::Light& light : scene.lights) {
    if (light.type == scene::LightType::box) continue;
    ++(light.type == scene::LightType::point  ? out.points
       : light.type == scene::LightType::spot ? out.spots
                                              : out.directionals);
    if (light.type == scene::LightType::directional) continue;
    ++(light.range_source == scene::RangeSource::given            ? given
       : light.range_source == scene::RangeSource::clamped_to_max ? clamped
                                                                  : from_intensity);
    if (std::isfinite(light.range_m)) ranges.push_back(light.range_m);
  }
  for (const scene::CameraPath& path : data.paths) {
    out.frames += static_cast<int>(path.shots.size());
    if (path.made) out.warnings.push_back(path.how);
  }
  if (const std::vector<std::string> others = scene::cameras_left_out(scene, request.camera); !others.empty())
    out.warnings.push_back("not measured: " + number_of(others.size(), "camera") + " beside '" +
                           data.paths.front().camera + "': " + first_names(others) +
                           "; \"camera\": \"*\" measures all");
  if (const std::string why = scene::why_no_lights(scene); !request.rig && !why.empty()) out.warnings.push_back(why);
  if (dark.all > 0) out.warnings.push_back(dark_text(dark, scene));
  if (!request.camera.field_of_view) add_fit_warnings(data, viewports, out.warnings);
  for (const std::string& text : {lights_after_path(data), without_field_of_view(data, request), fewer_frames(data)})
    if (!text.empty()) out.warnings.push_back(text);
  if (2 * clamped > given + from_intensity + clamped)
    out.warnings.push_back(most_clamped(clamped, given + from_intensity + clamped, request.range_rule));
  out.range_rule = {{"cutoff_lux", request.range_rule.cutoff_lux},
                    {"max_range", request.range_rule.max_range_m},
                    {"given", given},
                    {"from_intensity", from_intensity},
                    {"clamped", clamped}};
  if (!ranges.empty()) {
    std::ranges::sort(ranges);
    out.range_rule["ranges"] = {
        {"least", ranges.front()}, {"median", ranges[ranges.size() / 2]}, {"greatest", ranges.back()}};
  }
  return out;
}

std::string fewer_frames(const SceneData& data) {
  if (data.requested_frames == 0) return "";
  const double most = *std::ranges::max_element(data.lights_at_points);
  return "measured in " + number_of(static_cast<std::uint64_t>(data.equal_steps), "frame") + " and not in " +
         std::to_string(data.requested_frames) +
         ", since much is to be counted in each: " + std::to_string(std::lround(most)) +
         " lights reach a point of the view, on average; --set 'scenes.*.frames=" +
         std::to_string(data.requested_frames) + "' takes all";
}

std::string without_field_of_view(const SceneData& data, const config::SceneRequest& request) {
  if (!request.camera.field_of_view) return "";
  std::vector<std::string> without;
  const auto has_none = [](const scene::Shot& shot) { return shot.projection.orthographic || shot.projection.sides; };
  for (const scene::CameraPath& path : data.paths)
    if (std::ranges::all_of(path.shots, has_none)) without.push_back("'" + path.camera + "'");
  if (without.empty()) return "";
  return "--fov (scenes.*.fov) changes nothing for " + number_of(without.size(), "camera") +
         ", orthographic or given by its " + "sides: " + first_names(without);
}

}  // namespace clusterbench::run
