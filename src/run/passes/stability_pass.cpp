#include "run/passes/stability_pass.h"

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <memory>

#include "measure/truth/truth.h"
#include "run/cases/frame_lights.h"
#include "run/cases/path_culls.h"
#include "scene/fine_path.h"

namespace clusterbench::run {
namespace {

scene::FineSteps fine_steps(const config::StabilityRequest& request) {
  return {request.steps, request.step_mm / 1e3, glm::radians(request.step_deg)};
}

// One method along the segment.
class StabilityTrack {
 public:
  StabilityTrack(const config::Config& config, const Method& method, const cull::PreCull& pre_cull)
      : method_(method),
        run_(config, method, pre_cull),
        meter_(config.stability->window),
        own_truth_(config.stability->window) {}

  void add(const view::Frame& frame, const grid::Grid& grid, bool is_new_grid, const FrameLights& lights,
           const depth::DepthImage* depth, int threads) {
    if (!run_.has_cells()) return;
    const view::LightArrays& packed = lights.in_precision(method_.precision);
    if (is_new_grid) run_.build(grid, assign::kinds_of(packed));
    run_.assign(frame, packed, depth);
    meter_.add(run_.cell_lists());
    if (!run_.has_occupied_cells()) return;
    const measure::Truth truth = measure::find_truth(frame, grid, run_.own_structure()->occupied_cells(), threads);
    own_truth_.add(truth.lists);
    undecided_ += truth.undecided;
  }

  const Method& method() const { return method_; }
  bool has_cells() const { return run_.has_cells(); }
  // `common`: the facts that all methods share, with the truth of the grid's cells.
  StabilityResult result(const StabilityResult& common) const {
    StabilityResult out = common;
    out.method = meter_.result();
    if (!run_.has_occupied_cells()) return out;
    out.truth = own_truth_.result();
    out.undecided = undecided_;
    return out;
  }

 private:
  Method method_;
  CulledRun run_;
  measure::ChurnMeter meter_;
  measure::ChurnMeter own_truth_;  // of cells that are not the grid's
  std::uint64_t undecided_ = 0;    // pairs in that truth
};

// The facts that all methods of the group share.
StabilityResult segment_facts(const scene::FinePath& segment, int window) {
  StabilityResult facts;
  facts.window = window;
  facts.step_m = segment.move_m;
  facts.step_deg = glm::degrees(segment.turn_rad);
  facts.from_frame = segment.from_shot;
  facts.is_drift = segment.is_drift;
  facts.path = segment.path.how;
  return facts;
}

std::vector<std::optional<StabilityResult>> per_case(const GroupPlan& group, const std::vector<StabilityTrack>& tracks,
                                                     const StabilityResult& common) {
  std::vector<std::optional<StabilityResult>> results;
  for (const CasePlan& case_plan : group.cases) {
    const StabilityTrack& track = *std::find_if(
        tracks.begin(), tracks.end(), [&](const StabilityTrack& any) { return any.method() == case_plan.method(); });
    results.emplace_back();
    if (track.has_cells()) results.back() = track.result(common);
  }
  return results;
}

}  // namespace

std::vector<std::optional<StabilityResult>> stability_pass(const config::Config& config, const GroupPlan& group,
                                                           const PathFrames& path,
                                                           const std::function<void(double share)>& on_step,
                                                           const std::atomic<bool>& stop) {
  const scene::FinePath segment = scene::fine_path(path.camera_path(), fine_steps(*config.stability));
  const PathFrames steps = path.along(segment.path);
  StabilityResult common = segment_facts(segment, config.stability->window);
  const PathCulls culls(config, group, steps);
  std::vector<StabilityTrack> tracks;
  for (const Method& method : methods_of(group)) tracks.emplace_back(config, method, culls.of(method));

  GridOfFrames grids(config.grids[group.grid]);
  measure::ChurnMeter truth_meter(config.stability->window);
  for (int step = 0; step < steps.count(); ++step) {
    if (stop) return {};
    on_step(1.0 / steps.count());
    const view::Frame frame = steps.frame(step);
    const bool is_new_grid = grids.update(steps, frame);
    const grid::Grid& grid = grids.grid();
    const FrameLights lights(config.precisions, view::lights_in(frame, grid::space_of(grid, frame)));
    const measure::Truth truth = measure::find_truth(frame, grid, config.threads);
    truth_meter.add(truth.lists);
    const std::shared_ptr<const depth::DepthImage> depth = depths_for(config, group, steps, frame);
    for (StabilityTrack& track : tracks) track.add(frame, grid, is_new_grid, lights, depth.get(), config.threads);
    common.grids += is_new_grid ? 1 : 0;
    common.undecided += truth.undecided;
  }
  common.truth = truth_meter.result();
  return per_case(group, tracks, common);
}

}  // namespace clusterbench::run
