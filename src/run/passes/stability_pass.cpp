#include "run/passes/stability_pass.h"

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <memory>

#include "measure/truth/truth.h"
#include "run/cases/frame_lights.h"
#include "run/cases/path_culls.h"
#include "run/passes/frame_pipeline.h"
#include "scene/fine_path.h"

namespace clusterbench::run {
namespace {

scene::FineSteps fine_steps(const config::StabilityRequest& request) {
  return {request.steps, request.step_mm / 1e3, glm::radians(request.step_deg)};
}

// A frame of the segment.
struct Step {
  view::Frame frame;
  std::shared_ptr<const grid::Grid> grid;
  bool is_new_grid = false;
  FrameLights lights;
  measure::Truth truth;
  std::shared_ptr<const depth::DepthImage> depth;  // if a method needs it

  std::size_t bytes() const { return (truth.lists.begin.size() + truth.lists.lights.size()) * sizeof(std::uint32_t); }
};

// One method along the segment.
class StabilityTrack {
 public:
  StabilityTrack(const config::Config& config, const Method& method, const cull::PreCull& pre_cull)
      : method_(method),
        run_(config, method, pre_cull),
        meter_(config.stability->window),
        own_truth_(config.stability->window) {}

  void add(const Step& now, int threads) {
    if (!run_.has_cells()) return;
    grid_ = now.grid;
    const view::LightArrays& packed = now.lights.in_precision(method_.precision);
    if (now.is_new_grid) run_.build(*grid_, assign::kinds_of(packed));
    run_.assign(now.frame, packed, now.depth.get());
    meter_.add(run_.cell_lists());
    if (!run_.has_occupied_cells()) return;
    const measure::Truth truth =
        measure::find_truth(now.frame, *grid_, run_.own_structure()->occupied_cells(), threads);
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
  std::shared_ptr<const grid::Grid> grid_;  // for which the method is built
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
                                                           const Stop& stop) {
  const scene::FinePath segment = scene::fine_path(path.camera_path(), fine_steps(*config.stability));
  const PathFrames steps = path.along(segment.path);
  StabilityResult common = segment_facts(segment, config.stability->window);
  const PathCulls culls(config, group, steps);
  std::vector<StabilityTrack> tracks;
  for (const Method& method : methods_of(group)) tracks.emplace_back(config, method, culls.of(method));

  GridOfFrames grids(config.grids[group.grid]);
  measure::ChurnMeter truth_meter(config.stability->window);
  FrameWork<Step> work;
  work.begin = [&](int step) {
    on_step(1.0 / steps.count());
    auto now = std::make_unique<Step>();
    now->frame = steps.frame(step);
    now->is_new_grid = grids.update(steps, now->frame);
    now->grid = grids.shared();
    return now;
  };
  work.prepare = [&](Step& now) {
    now.lights = FrameLights(config.precisions, view::lights_in(now.frame, grid::space_of(*now.grid, now.frame)));
    now.truth = measure::find_truth(now.frame, *now.grid, config.threads);
    now.depth = depths_for(config, group, steps, now.frame);
  };
  work.bytes = [](const Step& now) { return now.bytes(); };
  work.users.push_back({[&](const Step& now) {
    truth_meter.add(now.truth.lists);
    common.grids += now.is_new_grid ? 1 : 0;
    common.undecided += now.truth.undecided;
  }});
  for (StabilityTrack& track : tracks) work.users.push_back({[&](const Step& now) { track.add(now, config.threads); }});
  work.users_apart = !runs_elsewhere(config, group);
  if (!FramePipeline<Step>(work, steps.count(), config.threads, stop).run()) return {};
  common.truth = truth_meter.result();
  return per_case(group, tracks, common);
}

}  // namespace clusterbench::run
