#include "run/cases/path_frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assign/contract/assigner_run.h"
#include "grid/lights_in_view.h"

namespace clusterbench::run {

PathFrames::PathFrames(const scene::Scene& scene, const scene::CameraPath& path, Vec2i viewport, FrameDepths* depths,
                       int threads, SceneVisibleSets* visible_sets)
    : PathFrames(scene, path, viewport, PathLightsOfScene(0).of(scene, path, 0, viewport, threads), depths, threads,
                 visible_sets) {}

PathFrames::PathFrames(const scene::Scene& scene, const scene::CameraPath& path, Vec2i viewport,
                       std::shared_ptr<const PathLights> lights, FrameDepths* depths, int threads,
                       SceneVisibleSets* visible_sets)
    : scene_(scene),
      path_(path),
      viewport_(viewport),
      lights_(std::move(lights)),
      depths_(depths),
      threads_(threads),
      visible_sets_(visible_sets) {}

PathFrames PathFrames::only(std::vector<int> frames) const {
  PathFrames some = *this;
  some.frames_ = std::move(frames);
  return some;
}

view::Frame PathFrames::frame(int index) const {
  return frame_of_path(frames_.empty() ? index : frames_[static_cast<std::size_t>(index)]);
}

std::optional<view::Frame> PathFrames::neighbour(const view::Frame& frame) const {
  if (path_.shots.size() < 2) return {};
  return frame_of_path(frame.index > 0 ? frame.index - 1 : 1);
}

std::vector<bool> PathFrames::lights_in_view(const view::Frame& frame) const {
  return is_own_path_ && !lights_->in_view.empty() ? lights_->in_view[static_cast<std::size_t>(frame.index)]
                                                   : grid::lights_in_view(frame);
}

view::Frame PathFrames::frame_of_path(int index) const {
  return frame_of_shot(scene_, path_, index, viewport_, lights_->static_lights);
}

grid::GridInputs PathFrames::inputs(const grid::GridSpec& spec, const view::Frame& frame) const {
  grid::GridInputs inputs = inputs_before_reaction(spec, frame);
  // The first frame has no previous one. For other reactions the inputs of the frame itself already have the tiles.
  if (spec.reaction && spec.reaction->to == grid::Reaction::To::entries && frame.index > 0)
    inputs.tiles = reactions(spec)[static_cast<std::size_t>(frame.index)].tiles;
  return inputs;
}

grid::GridInputs PathFrames::inputs_before_reaction(const grid::GridSpec& spec, const view::Frame& frame) const {
  grid::GridInputs inputs =
      grid::grid_inputs(spec.unfitted(), frame, lights_->reach.far_m(), lights_->reach.lo(), lights_->reach.hi());
  if (inputs.shape) inputs.shape = lights_->shape;
  if (spec.slices.fit) inputs.needed = spans(spec)[static_cast<std::size_t>(frame.index)];
  return inputs;
}

grid::Span PathFrames::needed(const grid::GridSpec& spec, const view::Frame& frame) const {
  const bool needs_depths = depths_ != nullptr && spec.slices.fit->needs_surfaces();
  const std::shared_ptr<const depth::DepthImage> depths = needs_depths ? depths_->of(frame, threads_) : nullptr;
  return grid::grid_inputs(spec, frame, lights_->reach.far_m(), lights_->reach.lo(), lights_->reach.hi(), depths.get())
      .needed;
}

const std::vector<grid::Span>& PathFrames::spans(const grid::GridSpec& spec) const {
  std::vector<grid::Span>& spans = spans_[spec.name()];
  if (!spans.empty()) return spans;
  grid::SpanFollower follower(*spec.slices.fit);
  for (int i = 0; i < static_cast<int>(path_.shots.size()); ++i)
    spans.push_back(grid::deciding_span(spec.slices, follower.next(needed(spec, frame_of_path(i)))));
  return spans;
}

const std::vector<FrameReaction>& PathFrames::reactions(const grid::GridSpec& spec) const {
  std::vector<FrameReaction>& reactions = reactions_[spec.name()];
  if (reactions.empty())
    reactions =
        spec.reaction->to == grid::Reaction::To::entries ? reactions_to_entries(spec) : reactions_to_lights(spec);
  return reactions;
}

std::vector<FrameReaction> PathFrames::reactions_to_entries(const grid::GridSpec& spec) const {
  const assign::AssignerDescriptor& method = *assign::find_assigner(spec.reaction->of);
  assign::AssignerRun run(method, assign::Params(method.params), assign::Answer::lists);
  std::vector<FrameReaction> reactions;
  grid::GridInputs built_for;
  grid::Grid grid;
  grid::Tiling tiles = spec.tiles;
  for (int i = 0; i < static_cast<int>(path_.shots.size()); ++i) {
    const view::Frame frame = frame_of_path(i);
    grid::GridInputs inputs = inputs_before_reaction(spec, frame);
    inputs.tiles = tiles;
    const bool is_new_grid = i == 0 || !(inputs == built_for);
    if (is_new_grid) grid = grid::make_grid(spec, inputs);
    const view::LightArrays lights = view::lights_in(frame, grid::space_of(grid, frame));
    if (is_new_grid) run.build(grid, assign::kinds_of(lights));
    run.assign({frame, lights});
    const std::uint64_t entries = run.filled_lists()->pair_count();
    reactions.push_back({tiles, entries});
    tiles = grid::shrunk_tiles(spec.tiles, viewport_, entries, spec.reaction->most);
    built_for = inputs;
  }
  return reactions;
}

std::vector<FrameReaction> PathFrames::reactions_to_lights(const grid::GridSpec& spec) const {
  std::vector<FrameReaction> reactions;
  for (int i = 0; i < static_cast<int>(path_.shots.size()); ++i) {
    const view::Frame frame = frame_of_path(i);
    const grid::Tiling tiles = *inputs_before_reaction(spec, frame).tiles;
    reactions.push_back({tiles, grid::mask_words(tiles, viewport_, grid::lights_with_bits(*spec.reaction, frame))});
  }
  return reactions;
}

PathFrames path_of(const config::Config& config, const SceneData& data, std::size_t camera, std::size_t viewport) {
  const scene::CameraPath& path = data.paths[camera];
  const Vec2i pixels = config.viewports[viewport];
  return {data.scene,
          path,
          pixels,
          data.path_lights->of(data.scene, path, camera, pixels, config.threads),
          data.depths.get(),
          config.threads,
          data.visible_sets.get()};
}
PathFrames path_of(const config::Config& config, const Plan& plan, const GroupPlan& group) {
  return path_of(config, plan.scenes[group.scene], group.camera, group.viewport);
}

bool needs_depth(const config::Config& config, const GroupPlan& group) {
  return std::ranges::any_of(group.cases, [&](const CasePlan& plan) {
    return assign::find_assigner(config.assigners[plan.assigner].name)->needs.depth;
  });
}

std::shared_ptr<const depth::DepthImage> depths_for(const config::Config& config, const GroupPlan& group,
                                                    const PathFrames& path, const view::Frame& frame) {
  if (path.depths() == nullptr || !needs_depth(config, group)) return nullptr;
  return path.depths()->of(frame, config.threads);
}

double sample_far(const view::Frame& frame, double path_far_m) {
  // Behind the near plane, even if no light reaches that far; the near plane of an orthographic camera can be behind
  // its eye.
  const double near = frame.projection.near_m, behind_near = near > 0.0 ? 2.0 * near : 1.0 - 2.0 * near;
  return std::min(frame.projection.far_m, std::max(path_far_m, behind_near));
}

std::vector<int> evenly_spaced(int wanted, int path_frames) {
  const int count = std::min(wanted, path_frames);
  std::vector<int> frames;
  for (int i = 0; i < count; ++i)
    frames.push_back(count == 1 ? 0 : static_cast<int>(std::lround(i * (path_frames - 1.0) / (count - 1))));
  return frames;
}

bool GridOfFrames::update(const PathFrames& path, const view::Frame& frame) {
  const grid::GridInputs inputs = path.inputs(spec_, frame);
  if (is_made_ && inputs == inputs_) return false;
  grid_ = std::make_shared<const grid::Grid>(grid::make_grid(spec_, inputs));
  inputs_ = inputs;
  is_made_ = true;
  return true;
}

}  // namespace clusterbench::run
