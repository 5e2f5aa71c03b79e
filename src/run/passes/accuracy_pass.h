#pragma once
// The first pass over a group's frames: lists against truth, occupancy, buffers, samples. Timing comes later.

#include <functional>
#include <memory>

#include "core/stop.h"
#include "run/cases/case_plan.h"
#include "run/cases/path_frames.h"
#include "run/cases/scene_data.h"
#include "run/findings/fit_meter.h"
#include "run/findings/pre_cull_meter.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

// The measures of a method, independent of the storage of its lists.
struct MethodMeasures {
  Method method;
  bool has_cells = true;       // without: neither occupancy nor error
  bool has_grid_cells = true;  // its cells are the grid's cells
  measure::Occupancy occupancy;
  measure::ErrorCounts error;  // of the lists, before a storage drops anything
  std::uint64_t tests_done = 0, fallbacks = 0;
  std::optional<ListChanges> list_changes;     // with cells, if requested
  std::optional<PreCullCounts> pre_cull;       // if there is one
  std::vector<ShadowCullResult> shadow_culls;  // of lists, one per way, if requested
};

// The measures of one case's light structure: lights at samples, and size.
struct StructureMeasures {
  measure::Buffers buffers;
  std::vector<SampleSetResult> samples;  // one per set of the configuration
  std::vector<measure::LookupCounts> lookup;
  // The same for the same storage with room for all lists, if the case's storage can run out of room: buffers and
  // samples.
  std::shared_ptr<const StructureMeasures> roomy = {};
};

struct AccuracyResult {
  std::vector<MethodMeasures> methods;        // of the group, in order of first use
  std::vector<StructureMeasures> structures;  // one per case of the group
  std::vector<measure::PackingLoss> losses;   // one per precision of the configuration; none if it has float32 alone
  measure::LightsInView lights_in_view;
  measure::LightsBeyondGrid lights_beyond_grid;
  std::optional<measure::DepthRanges> depth_ranges;  // of visible surfaces in a frustum grid, if requested
  std::optional<measure::SharingCounts> sharing;     // of shadow maps, if requested
  std::optional<GridMoves> moves;                    // of a grid that follows the needs of frames
  grid::Grid last_grid;
  bool is_complete = false;  // false: stopped before the end
};

// The compared figures of a case that depend on its structure.
CaseSide structure_side(const StructureMeasures& measures);

// Whether lists are compared with the lists of the previous frame.
enum class ListsOverFrames { ignored, compared };

// The largest size of the lists of a frame that methods and truth could have, in bytes, if each light were in each
// cell.
double most_list_bytes(const config::Config& config, const GroupPlan& group, const PathFrames& path);

// Frames are prepared, and methods work, on config.threads threads; results do not depend on their number. Methods that
// run elsewhere (runs_elsewhere()) are called by the calling thread alone, and so is `on_frame`, before each frame.
AccuracyResult accuracy_pass(const config::Config& config, const SceneData& data, const GroupPlan& group,
                             const PathFrames& path, const std::function<void(int frame)>& on_frame, const Stop& stop,
                             ListsOverFrames over_frames = ListsOverFrames::ignored);

}  // namespace clusterbench::run
