#pragma once
// The frames of one camera path in one viewport, made on request: a path over a large rig would not fit in memory as a
// whole.

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid/grid.h"
#include "measure/samples/samples.h"
#include "run/cases/frame_depths.h"
#include "run/cases/path_lights.h"
#include "run/cases/plan.h"
#include "run/cases/scene_visible_sets.h"
#include "scene/camera_path.h"
#include "view/frame.h"

namespace clusterbench::run {

// Tiles of a frame after their reaction, and the amount that decides it: entries of the lists in these tiles, or words
// of their masks.
struct FrameReaction {
  grid::Tiling tiles;
  std::uint64_t amount = 0;
};

class PathFrames {
 public:
  // All must outlive this object. Without `depths` its frames have none. `threads`: used where all frames are
  // looked at, and for the depths that grids follow; results do not depend on it. `visible_sets`: of the scene, if a
  // pre-cull needs them. `lights`: path_lights() of these.
  PathFrames(const scene::Scene& scene, const scene::CameraPath& path, Vec2i viewport, FrameDepths* depths = nullptr,
             int threads = 1, SceneVisibleSets* visible_sets = nullptr);
  PathFrames(const scene::Scene& scene, const scene::CameraPath& path, Vec2i viewport,
             std::shared_ptr<const PathLights> lights, FrameDepths* depths, int threads,
             SceneVisibleSets* visible_sets);

  // The frames of another path in this path's grids, which follow the lights over this path. `other` must outlive them.
  PathFrames along(const scene::CameraPath& other) const { return {*this, other}; }

  // Only these frames of the path, ascending, each with its own index, in the grids of the whole path.
  PathFrames only(std::vector<int> frames) const;

  const scene::CameraPath& camera_path() const { return path_; }
  int count() const { return static_cast<int>(frames_.empty() ? path_.shots.size() : frames_.size()); }
  // `index`: below count().
  view::Frame frame(int index) const;
  // The previous frame of the whole path; for the first frame, the second one. None on a path of one frame.
  std::optional<view::Frame> neighbour(const view::Frame& frame) const;
  // grid::lights_in_view() of one of the path's frames.
  std::vector<bool> lights_in_view(const view::Frame& frame) const;
  // Slices that follow needs have the state that they reach in this frame, from the path's first frame on.
  grid::GridInputs inputs(const grid::GridSpec& spec, const view::Frame& frame) const;
  // Spans that slices with `fit` follow, frame by frame; computed once in the path's order, whichever frames are
  // requested.
  const std::vector<grid::Span>& spans(const grid::GridSpec& spec) const;
  // Reactions of tiles, frame by frame; computed like spans().
  const std::vector<FrameReaction>& reactions(const grid::GridSpec& spec) const;
  Vec2i viewport() const { return viewport_; }
  // For a single frame.
  grid::Span needed(const grid::GridSpec& spec, const view::Frame& frame) const;
  // The largest distance from any eye of the path at which a light with a finite range still reaches a point.
  double far_m() const { return lights_->reach.far_m(); }
  // Of this path and of those from along(); null without triangles.
  FrameDepths* depths() const { return depths_; }
  SceneVisibleSets* visible_sets() const { return visible_sets_; }  // null without triangles
  // The box around lights with finite ranges over the path.
  measure::Bounds light_bounds() const { return {lights_->reach.lo(), lights_->reach.hi()}; }

 private:
  PathFrames(const PathFrames& whole, const scene::CameraPath& path)
      : scene_(whole.scene_),
        path_(path),
        viewport_(whole.viewport_),
        lights_(whole.lights_),
        depths_(whole.depths_),
        threads_(whole.threads_),
        visible_sets_(whole.visible_sets_) {
    is_own_path_ = false;
  }

  view::Frame frame_of_path(int index) const;
  // The inputs with tiles as requested, before any reaction to the previous frame.
  grid::GridInputs inputs_before_reaction(const grid::GridSpec& spec, const view::Frame& frame) const;
  std::vector<FrameReaction> reactions_to_entries(const grid::GridSpec& spec) const;
  std::vector<FrameReaction> reactions_to_lights(const grid::GridSpec& spec) const;

  const scene::Scene& scene_;
  const scene::CameraPath& path_;
  Vec2i viewport_;
  std::shared_ptr<const PathLights> lights_;  // of this path, or of that from which along() has made it
  bool is_own_path_ = true;
  FrameDepths* depths_ = nullptr;
  std::vector<int> frames_;  // empty: all
  int threads_ = 1;
  SceneVisibleSets* visible_sets_ = nullptr;
  // By the grid's name.
  mutable std::map<std::string, std::vector<grid::Span>> spans_;
  mutable std::map<std::string, std::vector<FrameReaction>> reactions_;
};

// The frames in which a group of cases is measured.
PathFrames path_of(const config::Config& config, const Plan& plan, const GroupPlan& group);
PathFrames path_of(const config::Config& config, const SceneData& data, std::size_t camera, std::size_t viewport);

// Whether one of a group's methods needs depth.
bool needs_depth(const config::Config& config, const GroupPlan& group);
// A frame's depths if one of a group's methods needs them; else null.
std::shared_ptr<const depth::DepthImage> depths_for(const config::Config& config, const GroupPlan& group,
                                                    const PathFrames& path, const view::Frame& frame);

// Largest distance of samples: the camera's far plane or the reach of the lights, the same for all grids, so that
// overshade is comparable. A grid that ends before it misses lights, and the samples show that.
double sample_far(const view::Frame& frame, double path_far_m);

// `wanted` frames of the path, evenly spaced from its first to its last; all if it has fewer.
std::vector<int> evenly_spaced(int wanted, int path_frames);

// The grid of the current frame, rebuilt only when its inputs change.
class GridOfFrames {
 public:
  explicit GridOfFrames(const grid::GridSpec& spec) : spec_(spec) {}

  // True if the grid is a new one.
  bool update(const PathFrames& path, const view::Frame& frame);
  const grid::Grid& grid() const { return *grid_; }
  // Stays valid after the next update.
  const std::shared_ptr<const grid::Grid>& shared() const { return grid_; }

 private:
  grid::GridSpec spec_;
  grid::GridInputs inputs_;
  std::shared_ptr<const grid::Grid> grid_ = std::make_shared<const grid::Grid>();
  bool is_made_ = false;
};

}  // namespace clusterbench::run
