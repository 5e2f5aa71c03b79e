#pragma once
// Searches for the frames that are worst for one case: poses of the camera, and of lights that may be added or moved,
// that make a measure largest. Tries the recorded frames, random ones, a global search from the best of them and a
// local one from the best of all. The measured frames are those of a written path, to the bit.

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "run/cases/plan.h"
#include "search/frame_measure.h"
#include "search/path_scene.h"
#include "search/search_space.h"

namespace clusterbench::search {

struct WorstCaseRequest {
  Measure measure = Measure::entries;
  int evaluations = 5000;
  double seconds = 0.0;  // a time limit, on which results then depend; 0: none
  std::uint64_t seed = 1;
  int random = 10000;                  // frames to compare with
  int frames = 1;                      // number of distinct frames to find
  int threads = 1;                     // results do not depend on it
  std::vector<double> extra_ranges_m;  // of point lights that are added
  double move_m = 0.0;                 // largest distance by which each light of the scene may be moved
  std::optional<Box> within;  // allowed positions of the eye; without: the box of the lights and the recorded eyes
  bool walkable = false;      // the eye stays above the floor
  double eye_height_m = 1.7;
  bool keep_direction = false;  // the camera keeps the direction of one of the recorded frames
  bool keep_height = false;     // the eye stays between the recorded eyes' least and greatest y
};

// The flags that define the search space, as given: "--keep-height --add-lights 10"; "" if there are none.
std::string space_flags(const WorstCaseRequest& request);

struct WorstCaseListener {
  std::function<void(const std::string& doing, int done, int whole)> on_progress;  // from any thread, one at a time
};

struct Stage {
  std::string name;
  int evaluations = 0;
  double best = 0.0;  // so far
};

struct FoundFrame {
  FrameChoice choice;
  double value = 0.0;  // in the written path
};

// device: that on which the method runs has failed.
enum class Ended : std::uint8_t { evaluations, seconds, signal, device };

struct RandomFrames {
  int frames = 0;
  double max = 0.0, mean = 0.0;
};

struct RecordedFrames {
  int frames = 0;
  double max = 0.0;
  int frame = 0;  // the first with that value
};

struct WorstCase {
  Ended ended = Ended::evaluations;
  std::string device_failure;  // the reason for Ended::device
  int evaluations = 0;
  std::vector<Stage> stages;
  std::vector<FoundFrame> frames;  // best first
  RecordedFrames recorded;
  RandomFrames random;
  std::optional<double> theoretical_max;               // in the grid of the worst frame
  std::vector<assign::BufferNeed> buffers;             // of the worst frame
  std::uint64_t lights_in_view = 0, dark_in_view = 0;  // of the worst frame
  Box eyes, lights;
  std::size_t own_lights = 0, moments = 1;
  std::size_t directions = 0;  // allowed directions of the camera; 0: any
  std::size_t floor_triangles = 0;
  double floor_area_m2 = 0.0;
  std::vector<std::string> warnings;
  scene::Scene path_scene;  // the found frames, ready to be written
};

// The case to search: the first of the plan's, but not one of a method that tests all pairs if there is another. Throws
// Error if all need depth, since a written path has no triangles.
const run::CasePlan& case_to_search(const config::Config& config, const run::Plan& plan);

// Throws Error for a scene without lights, or without a place for a camera. `stop` is checked before each evaluation;
// the frames found by then are the result. So they are where the method's device fails, unless it does before the first
// one: then it throws gpu::DeviceError. Their values are then those of the search, without buffers, if the device
// cannot measure the written path.
WorstCase find_worst_case(const config::Config& config, const run::Plan& plan, const run::CasePlan& case_plan,
                          const WorstCaseRequest& request, const WorstCaseListener& listener,
                          const std::atomic<bool>& stop);

// Estimated duration of the search on this machine, from a few random frames.
double estimated_search_s(const config::Config& config, const run::Plan& plan, const run::CasePlan& case_plan,
                          const WorstCaseRequest& request);

}  // namespace clusterbench::search
