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
#include "run/cases/case_plan.h"
#include "run/cases/path_frames.h"

namespace clusterbench::run {

// The pre-culls that a group's cases use; others stay empty. Visible sets are built here, untimed.
class PathCulls {
 public:
  PathCulls(const config::Config& config, const GroupPlan& group, const PathFrames& path);
  // The pre-cull of one case.
  PathCulls(const config::Config& config, const CasePlan& case_plan, const PathFrames& path);

  const cull::PreCull& of(const Method& method) const { return *culls_[method.pre_cull]; }
  const std::vector<std::shared_ptr<const cull::PreCull>>& all() const { return culls_; }

 private:
  void add(const config::Config& config, std::size_t pre_cull, const PathFrames& path);

  std::vector<std::shared_ptr<const cull::PreCull>> culls_;  // parallel to Config::pre_culls
};

// For each method, the largest number of lights that it gets in a frame of the path: indices and words must be wide
// enough for it. 0 without a pre-cull: the method gets all lights of the rig.
std::vector<std::uint32_t> most_kept_lights(const config::Config& config, const GroupPlan& group,
                                            const PathFrames& path, const PathCulls& culls,
                                            const std::vector<Method>& methods);

// The pre-culls of a group's methods, and the largest number of lights that they keep.
struct GroupCulls {
  PathCulls path;
  std::vector<Method> methods;
  std::vector<std::uint32_t> most_lights;  // most_kept_lights() of these

  GroupCulls(const config::Config& config, const GroupPlan& group, const PathFrames& frames)
      : path(config, group, frames),
        methods(methods_of(group)),
        most_lights(most_kept_lights(config, group, frames, path, methods)) {}

  std::uint32_t max_lights_of(const Method& method) const;
};

// A method behind a pre-cull, for measures: its results use the rig's indices.
class CulledRun {
 public:
  // `pre_cull` must outlive this object.
  CulledRun(const config::Config& config, const Method& method, const cull::PreCull& pre_cull)
      : run_(start_method(config, method)), pre_cull_(&pre_cull) {}

  void build(const grid::Grid& grid, const assign::LightKinds& kinds);
  // `lights`: all lights of the frame, in the method's precision.
  void assign(const view::Frame& frame, const view::LightArrays& lights, const depth::DepthImage* depth);

  // Null without a pre-cull.
  const cull::FrameCull* cull() const { return pre_cull_->is_none() ? nullptr : &cull_; }
  // For the frame of the last assign(): whether the pre-cull removes no light of a cell.
  bool cull_is_conservative(const view::Frame& frame, const view::LightArrays& lights) const {
    return pre_cull_->is_conservative(frame, *grid_, lights, cull_);
  }

  bool has_cells() const { return run_.has_cells(); }
  bool has_occupied_cells() const { return run_.has_occupied_cells(); }
  // In the rig's indices. Only with cells.
  const assign::Lists& cell_lists(assign::ListOrder order = assign::ListOrder::ascending) const;
  // Writes the method's lists into a storage as an engine does: with the indices of the lights that the method got. Not
  // for a method with its own structure. count(): sizes alone.
  void store(assign::Storage& storage) const { storage.store(lists_for(storage)); }
  void count(assign::Storage& storage) const { storage.count(lists_for(storage)); }
  // As the method filled them, with the indices of the lights that it got; null if it makes its own structure.
  const assign::Lists* filled_lists() const { return run_.filled_lists(); }
  // As the method made it; null if it fills lists.
  const assign::LightStructure* own_structure() const { return run_.structure(); }
  // Converts the answers of a structure of this frame's lights (the method's own or a storage's) to the rig's indices;
  // none if they need no conversion. Refers to both.
  std::optional<assign::MappedStructure> mapped(const assign::LightStructure& structure) const;

  std::uint64_t tests_done() const { return run_.tests_done(); }
  std::uint64_t fallbacks() const { return run_.fallbacks(); }
  std::size_t scratch_bytes() const { return run_.scratch_bytes(); }
  bool shares_frames(bool counts_scratch) const { return run_.shares_frames(counts_scratch); }

 private:
  const assign::Lists& lists_for(assign::Storage& storage) const;

  assign::AssignerRun run_;
  const cull::PreCull* pre_cull_;
  const grid::Grid* grid_ = nullptr;
  cull::FrameCull cull_;
  mutable assign::Lists mapped_lists_;  // made on request
};

}  // namespace clusterbench::run
