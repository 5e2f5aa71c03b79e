#pragma once
// The first pass over a group's frames: lists against truth, occupancy, buffers, samples. Nothing is timed before it.

#include <atomic>
#include <functional>
#include <memory>

#include "run/cases/path_frames.h"
#include "run/cases/sweep.h"
#include "run/findings/fit_meter.h"
#include "run/findings/pre_cull_meter.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

// What a method answers, whatever keeps its lists.
struct MethodMeasures {
  Method method;
  bool has_cells = true;       // without: neither occupancy nor error
  bool has_grid_cells = true;  // its cells are those of the grid, and not its own
  measure::Occupancy occupancy;
  measure::ErrorCounts error;  // of the lists, before a storage drops anything
  std::uint64_t tests_done = 0, fallbacks = 0;
  std::optional<ListChanges> list_changes;     // with cells, where asked for
  std::optional<PreCullCounts> pre_cull;       // where there is one
  std::vector<ShadowCullResult> shadow_culls;  // of lists, one per way, where asked for
};

// What samples find in one case's light structure, and what it takes.
struct StructureMeasures {
  measure::Buffers buffers;
  std::vector<SampleSetResult> samples;  // one per set of the configuration
  std::vector<measure::LookupCounts> lookup;
  // Of the same lists in the same storage with room for all, where the case's can run out of it: buffers and samples.
  std::shared_ptr<const StructureMeasures> roomy = {};
};

struct AccuracyResult {
  std::vector<MethodMeasures> methods;        // of the group, in order of first use
  std::vector<StructureMeasures> structures;  // one per case of the group
  std::vector<measure::PackingLoss> losses;   // one per precision of the configuration; none if it has float32 alone
  measure::LightsInView lights_in_view;
  measure::LightsBeyondGrid lights_beyond_grid;
  std::optional<measure::DepthRanges> depth_ranges;  // of visible surfaces in a frustum grid, where asked for
  std::optional<measure::SharingCounts> sharing;     // of shadow maps, where asked for
  std::optional<GridMoves> moves;                    // of a grid that follows what frames need
  grid::Grid last_grid;
  bool is_complete = false;  // false: stopped before the end
};

// What of a case is compared that depends on its structure.
CaseSide structure_side(const StructureMeasures& measures);

// Whether lists are compared with those of the frame before.
enum class ListsOverFrames { ignored, compared };

AccuracyResult accuracy_pass(const config::Config& config, const SceneData& data, const GroupPlan& group,
                             const PathFrames& path, const std::function<void(int frame)>& on_frame,
                             const std::atomic<bool>& stop, ListsOverFrames over_frames = ListsOverFrames::ignored);

}  // namespace clusterbench::run
