#pragma once
// One figure of one frame of a case: the same number as in `clusterbench run` for a path of that frame only, except for
// the entries of a full storage.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assign/contract/storage.h"
#include "run/cases/frame_lights.h"
#include "run/cases/path_culls.h"
#include "run/cases/path_frames.h"
#include "run/cases/plan.h"

namespace clusterbench::search {

enum class Measure : std::uint8_t {
  entries,        // with room for all, also where a storage is full
  longest,        // list
  p99,            // length of list that 99 % of the cells do not exceed
  evaluated,      // per random point in the view: the loop of a pixel
  tests,          // of the method
  lights,         // in view, independent of the method: engines limit it
  lights_of_type  // the same for the type with most lights
};
struct MeasureRow {
  Measure measure;
  const char* name;
  const char* figure;         // in the table of figures (result/figures/case_figure.h); "": no row has it
  const char* pointer;        // to the number in a case of a result, for documents
  const char* meaning;        // of one frame; the table's words are for all frames of a path
  const char* own_unit = "";  // "": the figure's

  std::string unit() const;  // "lights"
};
std::span<const MeasureRow> measure_rows();
const MeasureRow& row_of(Measure measure);

// Measures frames of one case. Not thread-safe.
class FrameMeter {
 public:
  // `config` must outlive this object. Throws Error for a case without the measure: longest and p99 need cells,
  // evaluated needs samples in the view, and visible sets a path of their own. The method must not need depth.
  FrameMeter(const config::Config& config, const run::CasePlan& plan, Measure measure);

  // For measures of lights in view nothing is assigned, and structure() may not be called.
  double value(const run::PathFrames& path, int frame);
  // The largest possible value in the grid and with the lights of the last frame; none for tests.
  std::optional<double> theoretical_max() const;
  // The needs of the last frame for each buffer.
  std::vector<assign::BufferNeed> buffers() const { return structure().buffers(); }
  // The structure of the last frame; behind a pre-cull it uses the indices of the kept lights.
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
  std::unique_ptr<const cull::PreCull> pre_cull_;  // at a fixed address
  run::CulledRun run_;
  std::unique_ptr<assign::Storage> storage_;  // none: the method's own structure
  std::uint32_t real_cells_ = 0;
  std::uint32_t lights_ = 0;  // largest possible value of a measure of lights
  std::vector<std::uint32_t> given_;
};

// Fixes the values of the case's grid that depend on the whole path to those of the recorded path: the end of slices
// for a view without end, and the bounds of a world grid. An engine's grid would not change with the camera of a search
// either; and the grid is made once, not for each frame. Slices with `fit` still follow a frame's own lights.
void fix_grid(config::Config& config, const run::Plan& plan, const run::CasePlan& case_plan);

// One value per frame of a path. `on_frame` is called for each.
std::vector<double> values_along(const config::Config& config, const run::CasePlan& plan, Measure measure,
                                 const run::PathFrames& path, const std::function<void()>& on_frame = {});

}  // namespace clusterbench::search
