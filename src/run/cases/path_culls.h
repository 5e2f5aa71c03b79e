#pragma once
// A configuration's pre-culls on one camera path, and methods behind them.

#include <memory>
#include <optional>
#include <vector>

#include "assign/contract/assigner_run.h"
#include "assign/contract/mapped_structure.h"
#include "assign/contract/storage.h"
#include "config/config.h"
#include "cull/pre_cull.h"
#include "run/cases/path_frames.h"
#include "run/cases/sweep.h"

namespace clusterbench::run {

// Those that a group's cases use; others stay empty. Visible sets are built here, untimed.
class PathCulls {
 public:
  PathCulls(const config::Config& config, const GroupPlan& group, const PathFrames& path);
  // Of one case alone.
  PathCulls(const config::Config& config, const CasePlan& case_plan, const PathFrames& path);

  const cull::PreCull& of(const Method& method) const { return *culls_[method.pre_cull]; }
  const std::vector<std::shared_ptr<const cull::PreCull>>& all() const { return culls_; }

 private:
  void add(const config::Config& config, std::size_t pre_cull, const PathFrames& path);

  std::vector<std::shared_ptr<const cull::PreCull>> culls_;  // beside Config::pre_culls
};

// The most lights that each of these methods gets in a frame of the path: what indices and words are wide enough for.
// 0 where nothing is culled, and it gets all of the rig's.
std::vector<std::uint32_t> most_kept_lights(const config::Config& config, const GroupPlan& group,
                                            const PathFrames& path, const PathCulls& culls,
                                            const std::vector<Method>& methods);

// The pre-culls of a group's methods, and what these leave at most.
struct GroupCulls {
  PathCulls path;
  std::vector<Method> methods;
  std::vector<std::uint32_t> most_lights;  // most_kept_lights() of these

  GroupCulls(const config::Config& config, const GroupPlan& group, const PathFrames& frames)
      : path(config, group, frames),
        methods(methods_of(group)),
        most_lights(most_kept_lights(config, group, frames, path, methods)) {}

  std::uint32_t most_lights_of(const Method& method) const;
};

// A method at work behind a pre-cull, for measures: what it leaves is told in the rig's indices.
class CulledRun {
 public:
  // `pre_cull` outlives it.
  CulledRun(const config::Config& config, const Method& method, const cull::PreCull& pre_cull)
      : run_(start_method(config, method)), pre_cull_(&pre_cull) {}

  void build(const grid::Grid& grid, const assign::LightKinds& kinds);
  // `lights`: all of the frame's, as the method's precision has them.
  void assign(const view::Frame& frame, const view::LightArrays& lights, const depth::DepthImage* depth);

  // Null where nothing is culled.
  const cull::FrameCull* cull() const { return pre_cull_->is_none() ? nullptr : &cull_; }
  // Of the frame that assign() was given last: it removes no light of a cell.
  bool cull_is_conservative(const view::Frame& frame, const view::LightArrays& lights) const {
    return pre_cull_->is_conservative(frame, *grid_, lights, cull_);
  }

  bool has_cells() const { return run_.has_cells(); }
  bool has_occupied_cells() const { return run_.has_occupied_cells(); }
  // Ascending, in the rig's indices. Only with cells.
  const assign::Lists& cell_lists() const;
  // Puts the method's lists into a storage as an engine does: by the indices of the lights that it got. Not for a
  // structure of its own.
  void store(assign::Storage& storage) const;
  // As the method made it; null if it fills lists.
  const assign::LightStructure* own_structure() const { return run_.structure(); }
  // What a structure of this frame's lights, the method's own or a storage's, answers in the rig's indices; none where
  // it does so itself. Refers to both.
  std::optional<assign::MappedStructure> mapped(const assign::LightStructure& structure) const;

  std::uint64_t tests_done() const { return run_.tests_done(); }
  std::uint64_t fallbacks() const { return run_.fallbacks(); }
  std::size_t scratch_bytes() const { return run_.scratch_bytes(); }

 private:
  assign::AssignerRun run_;
  const cull::PreCull* pre_cull_;
  const grid::Grid* grid_ = nullptr;
  cull::FrameCull cull_;
  mutable assign::Lists mapped_lists_;  // made when they are asked for
};

}  // namespace clusterbench::run
