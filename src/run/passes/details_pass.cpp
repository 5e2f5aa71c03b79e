#include "run/passes/details_pass.h"

#include <algorithm>

#include "measure/truth/truth.h"
#include "run/cases/frame_lights.h"
#include "run/cases/path_culls.h"
#include "run/passes/frame_pipeline.h"

namespace clusterbench::run {
namespace {

struct DetailedFrame {
  view::Frame frame;
  std::shared_ptr<const grid::Grid> grid;
  FrameLights lights;
  measure::Truth truth;

  std::size_t bytes() const { return (truth.lists.begin.size() + truth.lists.lights.size()) * sizeof(std::uint32_t); }
};

// The frames of one method, with their details.
class Track {
 public:
  Track(const config::Config& config, const MethodMeasures& counted, const cull::PreCull& pre_cull, int path_frames)
      : method_(counted.method), with_pairs_(config.details->lists), run_(config, counted.method, pre_cull) {
    if (!counted.has_cells || run_.has_occupied_cells()) return;
    details_.emplace();
    details_->max_bytes = config.details->max_bytes;
    for (const int frame : wanted(*config.details, counted, path_frames))
      (frame < path_frames ? frames_ : details_->frames_not_on_path).push_back(frame);
  }

  const Method& method() const { return method_; }
  const std::vector<int>& frames() const { return frames_; }
  const std::optional<Details>& details() const { return details_; }

  void add(const DetailedFrame& now, const scene::Scene& scene, const grid::Grid& case_grid) {
    if (!std::binary_search(frames_.begin(), frames_.end(), now.frame.index)) return;
    grid_ = now.grid;
    const view::LightArrays& packed = now.lights.in_precision(method_.precision);
    run_.build(*grid_, assign::kinds_of(packed));
    run_.assign(now.frame, packed, nullptr);
    const measure::FrameDetails found = measure::find_details(now.truth.lists, run_.cell_lists());
    add_frame(*details_, packed_frame(now.frame, scene, *grid_, case_grid, found, with_pairs_));
  }

 private:
  static std::vector<int> wanted(const config::DetailsRequest& request, const MethodMeasures& counted,
                                 int path_frames) {
    if (request.frames.choice == config::DetailsFrames::Choice::worst) return {counted.occupancy.worst_frame};
    if (request.frames.choice == config::DetailsFrames::Choice::evenly)
      return evenly_spaced(request.frames.count, path_frames);
    return request.frames.list;
  }

  Method method_;
  bool with_pairs_;
  std::shared_ptr<const grid::Grid> grid_;  // for which the method is built
  CulledRun run_;
  std::vector<int> frames_;
  std::optional<Details> details_;  // none without cells, or if they are not the grid's
};

std::vector<int> frames_of(const std::vector<Track>& tracks) {
  std::vector<int> all;
  for (const Track& track : tracks) all.insert(all.end(), track.frames().begin(), track.frames().end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

std::vector<std::optional<Details>> details_pass(const config::Config& config, const GroupPlan& group,
                                                 const PathFrames& path, const scene::Scene& scene,
                                                 const AccuracyResult& counted, const Stop& stop) {
  std::vector<Track> tracks;
  const PathCulls culls(config, group, path);
  for (const MethodMeasures& method : counted.methods)
    tracks.emplace_back(config, method, culls.of(method.method), path.count());

  GridOfFrames grids(config.grids[group.grid]);
  const std::vector<int> frames = frames_of(tracks);
  FrameWork<DetailedFrame> work;
  work.begin = [&](int number) {
    auto now = std::make_unique<DetailedFrame>();
    now->frame = path.frame(frames[static_cast<std::size_t>(number)]);
    grids.update(path, now->frame);
    now->grid = grids.shared();
    return now;
  };
  work.prepare = [&](DetailedFrame& now) {
    now.lights = FrameLights(config.precisions, view::lights_in(now.frame, grid::space_of(*now.grid, now.frame)));
    now.truth = measure::find_truth(now.frame, *now.grid, config.threads);
  };
  work.bytes = [](const DetailedFrame& now) { return now.bytes(); };
  for (Track& track : tracks)
    work.users.push_back({[&](const DetailedFrame& now) { track.add(now, scene, counted.last_grid); }});
  work.users_apart = !runs_elsewhere(config, group);
  if (!FramePipeline<DetailedFrame>(work, static_cast<int>(frames.size()), config.threads, stop).run()) return {};

  std::vector<std::optional<Details>> results;
  for (const CasePlan& case_plan : group.cases)
    results.push_back(std::find_if(tracks.begin(), tracks.end(), [&](const Track& track) {
                        return track.method() == case_plan.method();
                      })->details());
  return results;
}

}  // namespace clusterbench::run
