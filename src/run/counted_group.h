#pragma once
// The counts of a group of cases: truth, errors, occupancy, buffers, samples, steps and details; no times.

#include <functional>
#include <optional>
#include <vector>

#include "core/stop.h"
#include "run/cases/path_frames.h"
#include "run/cases/scene_data.h"
#include "run/findings/reaction_meter.h"
#include "run/passes/accuracy_pass.h"
#include "run/passes/details_pass.h"
#include "run/passes/stability_pass.h"

namespace clusterbench::run {

struct GroupCounts {
  int frames = 0;
  AccuracyResult counted;
  // of a grid that follows the needs of frames: the same in the grid that does not follow
  std::optional<AccuracyResult> unfitted;
  std::optional<AccuracyResult> fixed;  // of tiles that react: the same in the requested tiles
  std::optional<TileMoves> tile_moves;  // of tiles that react
  std::vector<Vec3i> cells;             // of tiles that react, frame by frame
  std::vector<std::optional<StabilityResult>> stabilities;
  std::vector<std::optional<Details>> details;
};

// The passes that count, in their order.
enum class CountingStage : std::uint8_t { truth, stability, details };
const char* name_of(CountingStage stage);

// Called as a pass begins (share: 0), and with the share of it that was begun: on the calling thread.
using OnCounting = std::function<void(CountingStage stage, double share)>;

// None if stopped before the end. Counts on config.threads threads; the counts do not depend on their number. Groups
// without methods that run elsewhere (runs_elsewhere()) can be counted at the same time. Throws Error as the passes do.
std::optional<GroupCounts> count_group(const config::Config& config, const SceneData& data, const GroupPlan& group,
                                       const PathFrames& path, const OnCounting& on_counting, const Stop& stop);

}  // namespace clusterbench::run
