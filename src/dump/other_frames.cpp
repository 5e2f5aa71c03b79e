#include "dump/other_frames.h"

#include <cmath>
#include <glm/matrix.hpp>

#include "core/error.h"
#include "core/text.h"
#include "dump/camera.h"
#include "geom/shapes/domain.h"

namespace clusterbench::dump {
namespace {

// Beyond other words on the same matrices.
struct CameraChange {
  std::string text;
  result::DumpCamera camera;
  Vec3d mirrored{1.0};          // signs of view space: lights are seen in a mirror
  bool is_other_space = false;  // lights are in the world in place of view space, or the other way round
};

// The other way is either of two: also the numbers may be those of the other handedness.
std::string words_text(const CameraWords& words) {
  std::vector<std::string> changes = words.changes;
  for (std::string& change : changes)
    if (change.starts_with("camera.forward")) change = "camera.forward: the other way";
  return joined(changes, " and ");
}

// In the order in which they are believed. Where lights are in view space there is no view matrix to invert.
std::vector<CameraChange> camera_changes(const DumpFile& dump) {
  const result::DumpCamera& given = dump.record.camera;
  std::vector<CameraChange> out;
  // No camera changes the cells of a world grid.
  if (!has_matrices(given) || dump.record.grid.kind.value_or("frustum") == "world") return out;
  const bool is_in_view_space = has_lights_in_view_space(dump);
  for (const CameraWords& words : other_camera_words(given, is_in_view_space))
    out.push_back({words_text(words), words.camera});
  if (given.world_to_view || given.view_to_world) {
    out.push_back(
        {"camera.view_to_world and camera.world_to_view: the other of the two (the matrix is the inverse)", given});
    std::swap(out.back().camera.world_to_view, out.back().camera.view_to_world);
  }
  out.push_back(
      {"camera: the other handedness (the z row of world_to_view negated, or camera.forward and projection both the "
       "other way)",
       given,
       {1.0, 1.0, -1.0}});
  out.push_back({"camera: the x row of world_to_view negated", given, {-1.0, 1.0, 1.0}});
  out.push_back({"camera: the x and z rows of world_to_view negated", given, {-1.0, 1.0, -1.0}});
  if (!dump.record.lights.scene.value_or(false))
    out.push_back({is_in_view_space ? "lights.space 'world'" : "lights.space 'view'", given, Vec3d(1.0), true});
  return out;
}

// Moves all lights to where a camera sees them whose rows of the view matrix have these signs.
void mirror_lights(view::Frame& frame, const Vec3d& signs) {
  const Mat3d to_view = frame.view_space.rotation, to_world = glm::transpose(to_view);
  for (scene::WorldLight& light : frame.lights) {
    light.position =
        frame.view_space.origin + to_world * (signs * (to_view * (light.position - frame.view_space.origin)));
    light.direction = to_world * (signs * (to_view * light.direction));
  }
}

// nullopt where the matrices are none of a camera that way.
std::optional<DumpFrame> changed_frame(const DumpFile& dump, const CameraChange& change) {
  try {
    DumpFrame frame = frame_of(dump, change.camera, has_lights_in_view_space(dump) != change.is_other_space);
    if (change.mirrored != Vec3d(1.0)) mirror_lights(frame.frame, change.mirrored);
    return frame;
  } catch (const Error&) {
    return std::nullopt;
  }
}

// A number of a buffer is the range to the power of this.
double power_of(const std::string& is) {
  if (is == "squared") return 2.0;
  if (is == "inverse") return -1.0;
  return is == "inverse-squared" ? -2.0 : 1.0;
}

// Of each light of the dump; ranges in the file itself are plain ones.
std::vector<double> given_powers(const result::DumpLights& lights) {
  std::vector<double> out;
  if (lights.rows)
    for (const result::DumpLightRows& rows : *lights.rows)
      out.insert(out.end(), rows.count, power_of(rows.range.is.value_or("range")));
  else if (lights.listed)
    out.assign(lights.listed->size(), 1.0);
  return out;
}

struct RangeChange {
  const char* rows_text;
  const char* listed_text;
  double power = 0.0;   // of the number; 0: as it is given
  double factor = 1.0;  // of the range
};
const RangeChange k_range_changes[] = {
    {"lights.rows range.is 'squared'", "the square root of each range_m", 2.0},
    {"lights.rows range.is 'range'", nullptr, 1.0},
    {"lights.rows range.is 'inverse'", "1 / range_m for each range_m", -1.0},
    {"lights.rows range.is 'inverse-squared'", "1 over the square root of each range_m", -2.0},
    {"ranges half as large (the number is a diameter, or the engine culls with half the range)",
     "ranges half as large (range_m is a diameter, or the engine culls with half the range)", 0.0, 0.5},
    {"ranges twice as large (the number is half a range, or the engine culls with twice the range)",
     "ranges twice as large (range_m is half a range, or the engine culls with twice the range)", 0.0, 2.0}};

double changed_range(double range_m, double given_power, const RangeChange& change) {
  const double power = change.power == 0.0 ? 1.0 : given_power / change.power;
  return geom::range_in_domain(change.factor * (power == 1.0 ? range_m : std::pow(range_m, power)));
}

}  // namespace

void each_other_camera(const DumpFile& dump, const TryFrame& try_frame) {
  for (const CameraChange& change : camera_changes(dump)) {
    const std::optional<DumpFrame> other = changed_frame(dump, change);
    if (other && try_frame(*other, change.text)) return;
  }
}

void each_other_range(const DumpFile& dump, const DumpFrame& frame, const WantedRanges& wanted,
                      const TryFrame& try_frame) {
  const std::vector<double> given = given_powers(dump.record.lights);
  for (const RangeChange& change : k_range_changes) {
    const char* text = dump.record.lights.rows ? change.rows_text : change.listed_text;
    if (given.empty() || text == nullptr) continue;
    DumpFrame other = frame;
    std::size_t smaller = 0, larger = 0;
    for (std::size_t i = 0; i < other.frame.lights.size(); ++i) {
      double& range_m = other.frame.lights[i].range_m;
      const double before_m = range_m;
      range_m = changed_range(range_m, given[frame.dump_index[i]], change);
      smaller += range_m < before_m ? 1 : 0;
      larger += range_m > before_m ? 1 : 0;
    }
    const bool is_wanted = smaller > larger ? wanted.smaller : larger > 0 && wanted.larger;
    if (is_wanted && try_frame(other, text)) return;
  }
}

void each_larger_range(const DumpFile& dump, const DumpFrame& frame, const TryFrame& try_frame) {
  if (!dump.record.lights.rows && !dump.record.lights.listed) return;
  for (const int factor : {4, 8, 16}) {
    DumpFrame other = frame;
    for (scene::WorldLight& light : other.frame.lights) light.range_m = geom::range_in_domain(factor * light.range_m);
    if (try_frame(other, "ranges " + std::to_string(factor) + " times as large")) return;
  }
}

}  // namespace clusterbench::dump
