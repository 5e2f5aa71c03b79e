#pragma once
// The frames of one camera path in one viewport, made when they are asked for: a path over a large rig would not fit in
// memory whole.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid/grid.h"
#include "measure/samples/samples.h"
#include "run/cases/frame_depths.h"
#include "run/cases/light_reach.h"
#include "run/cases/scene_visible_sets.h"
#include "run/cases/sweep.h"
#include "scene/camera_path.h"
#include "view/frame.h"

namespace clusterbench::run {

// What tiles that react have come to in a frame, and what is too much or not: the entries of the lists in these tiles,
// or the words of their masks.
struct FrameReaction {
  grid::Tiling tiles;
  std::uint64_t amount = 0;
};

class PathFrames {
 public:
  // All must outlive it. Without `depths` its frames have none.
  // `threads`: for depths that grids follow; what is found does not depend on it.
  // `visible_sets`: of the scene, where a pre-cull asks for them.
  PathFrames(const scene::Scene& scene, const scene::CameraPath& path, Vec2i viewport, FrameDepths* depths = nullptr,
             int threads = 1, SceneVisibleSets* visible_sets = nullptr);

  // The frames of another path in this path's grids, which follow from the lights over this path. `other` outlives
  // them.
  PathFrames along(const scene::CameraPath& other) const { return {*this, other}; }

  // These frames of the path alone, ascending, each with its own index, in the grids of the whole path.
  PathFrames only(std::vector<int> frames) const;

  const scene::CameraPath& camera_path() const { return path_; }
  int count() const { return static_cast<int>(frames_.empty() ? path_.shots.size() : frames_.size()); }
  // `index`: below count().
  view::Frame frame(int index) const;
  // The whole path's frame before this one; of its first one the second. None on a path of one frame.
  std::optional<view::Frame> neighbour(const view::Frame& frame) const;
  // Of slices that follow what is needed: what they have come to in this frame, from the path's first frame on.
  grid::GridInputs inputs(const grid::GridSpec& spec, const view::Frame& frame) const;
  // What slices with `fit` follow, frame by frame; found once and in the path's order, whatever frames are asked for.
  const std::vector<grid::Span>& spans(const grid::GridSpec& spec) const;
  // Of tiles that react, frame by frame; found like spans().
  const std::vector<FrameReaction>& reactions(const grid::GridSpec& spec) const;
  Vec2i viewport() const { return viewport_; }
  // Of one frame by itself.
  grid::Span needed(const grid::GridSpec& spec, const view::Frame& frame) const;
  // The farthest that a light with an end reaches from any eye of the path.
  double far_m() const { return reach_.far_m(); }
  // Of its frames, and of those of paths along it; null without triangles.
  FrameDepths* depths() const { return depths_; }
  SceneVisibleSets* visible_sets() const { return visible_sets_; }  // null without triangles
  // The box around such lights over the path.
  measure::Bounds light_bounds() const { return {reach_.lo(), reach_.hi()}; }

 private:
  PathFrames(const PathFrames& whole, const scene::CameraPath& path)
      : scene_(whole.scene_),
        path_(path),
        viewport_(whole.viewport_),
        reach_(whole.reach_),
        shape_(whole.shape_),
        depths_(whole.depths_),
        threads_(whole.threads_),
        visible_sets_(whole.visible_sets_) {}

  view::Frame frame_of_path(int index) const;
  // But for tiles that react to the frame before: as they are asked for.
  grid::GridInputs inputs_as_asked(const grid::GridSpec& spec, const view::Frame& frame) const;
  std::vector<FrameReaction> reactions_to_entries(const grid::GridSpec& spec) const;
  std::vector<FrameReaction> reactions_to_lights(const grid::GridSpec& spec) const;

  const scene::Scene& scene_;
  const scene::CameraPath& path_;
  Vec2i viewport_;
  LightReach reach_;
  view::Projection shape_;  // of the first frame: cells of a shape are as many in all
  FrameDepths* depths_ = nullptr;
  std::vector<int> frames_;  // empty: all
  int threads_ = 1;
  SceneVisibleSets* visible_sets_ = nullptr;
  // By the grid's name.
  mutable std::map<std::string, std::vector<grid::Span>> spans_;
  mutable std::map<std::string, std::vector<FrameReaction>> reactions_;
};

// Those that a group of cases is measured in.
PathFrames path_of(const config::Config& config, const Plan& plan, const GroupPlan& group);

// Whether one of a group's methods needs depth.
bool needs_depth(const config::Config& config, const GroupPlan& group);
// A frame's depths where one of a group's methods needs them; else null.
std::shared_ptr<const depth::DepthImage> depths_for(const config::Config& config, const GroupPlan& group,
                                                    const PathFrames& path, const view::Frame& frame);

// How far samples are spread: as far as the camera sees and lights reach, the same for all grids, so that their
// overshade compares. A grid that ends before that misses lights, and the samples say so.
double sample_far(const view::Frame& frame, double path_far_m);

// So many of the path's frames, evenly spaced from its first to its last; all if it has fewer.
std::vector<int> evenly_spaced(int wanted, int path_frames);

// The grid of the frame at hand, rebuilt only when its inputs change.
class GridOfFrames {
 public:
  explicit GridOfFrames(const grid::GridSpec& spec) : spec_(spec) {}

  // True if the grid is a new one.
  bool update(const PathFrames& path, const view::Frame& frame);
  const grid::Grid& grid() const { return grid_; }

 private:
  grid::GridSpec spec_;
  grid::GridInputs inputs_;
  grid::Grid grid_;
  bool is_made_ = false;
};

}  // namespace clusterbench::run
