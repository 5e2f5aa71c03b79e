#pragma once
// One figure of one frame of a case: the same number that `clusterbench run` gives for a path of that frame alone, but
// for the entries of a storage that is full.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assign/contract/storage.h"
#include "run/cases/frame_lights.h"
#include "run/cases/path_culls.h"
#include "run/cases/path_frames.h"
#include "run/cases/sweep.h"

namespace clusterbench::search {

enum class Measure : std::uint8_t {
  entries,        // index entries of the light structure (`buffers.index_entries.high_water`), had it room for all
  longest,        // lights in the longest list (`occupancy.lights_per_cell.max`)
  p99,            // the list that 99 % of the cells do not exceed (`occupancy.lights_per_cell.p99`)
  evaluated,      // lights per sample of the view: what a pixel loops over (`shading.evaluated` / `shading.samples`)
  tests,          // what the method tests lights against (`tests_done`)
  lights,         // in view, whatever the method (`lights_in_view.max`): what engines limit
  lights_of_type  // the same of the type that has most (`lights_in_view.max_by_type`)
};
struct MeasureRow {
  Measure measure;
  const char *name, *unit, *summary;
  const char* figure;  // of a case in a result of `run`
};
std::span<const MeasureRow> measure_rows();
const MeasureRow& row_of(Measure measure);

// Measures frames of one case. Not for several threads at a time.
class FrameMeter {
 public:
  // `config` must outlive it. Throws Error for a case that does not have the measure: longest and p99 need cells,
  // evaluated needs samples in the view, and visible sets a path of their own. The method must not need depth.
  FrameMeter(const config::Config& config, const run::CasePlan& plan, Measure measure);

  // Of lights in view nothing is assigned, and structure() is not to be asked.
  double value(const run::PathFrames& path, int frame);
  // The most that there can be in the grid and with the lights of the last frame; none for tests.
  std::optional<double> theoretical_max() const;
  // What the last frame needs of each buffer.
  std::vector<assign::BufferNeed> buffers() const { return structure().buffers(); }
  // What the last frame left; behind a pre-cull it answers by the lights that this leaves.
  const assign::LightStructure& structure() const { return storage_ ? *storage_ : *run_.own_structure(); }

 private:
  // True if the grid is a new one.
  bool update_grid(const run::PathFrames& path, const view::Frame& frame);
  double lights_in_view(const view::Frame& frame);
  double evaluated_at_samples(const run::PathFrames& path, const view::Frame& frame);

  const config::Config& config_;
  Measure measure_;
  grid::GridSpec spec_;
  std::vector<config::PrecisionRequest> precision_;  // the case's own
  grid::GridInputs inputs_;
  std::optional<grid::Grid> grid_;
  std::unique_ptr<const cull::PreCull> pre_cull_;  // which stays where it is
  run::CulledRun run_;
  std::unique_ptr<assign::Storage> storage_;  // none: the method's own structure
  std::uint32_t real_cells_ = 0;
  std::uint32_t lights_ = 0;  // that the measure can come to
  std::vector<std::uint32_t> given_;
};

// Gives the case's grid what would follow from the whole path, as the recorded path has it: where slices end while the
// camera sees without end, and the bounds of a world grid. An engine's grid does not change with where its camera goes
// in a search either; and the grid is made once, not for each frame. Slices by `fit` follow from a frame's own lights
// and stay so.
void fix_grid(config::Config& config, const run::Plan& plan, const run::CasePlan& case_plan);

// Of all frames of a path. `on_frame` is told of each.
std::vector<double> values_along(const config::Config& config, const run::CasePlan& plan, Measure measure,
                                 const run::PathFrames& path, const std::function<void()>& on_frame = {});

}  // namespace clusterbench::search
