#include "run/cases/path_culls.h"

#include <algorithm>

#include "core/error.h"
#include "run/cases/frame_lights.h"

namespace clusterbench::run {
namespace {

std::shared_ptr<const cull::PreCull> pre_cull_on(const config::Config& config, std::size_t pre_cull,
                                                 const PathFrames& path) {
  const cull::PreCullSpec& spec = config.pre_culls[pre_cull];
  std::vector<std::shared_ptr<const cull::VisibleSets>> sets;
  for (const cull::Step& step : spec.steps) {
    const auto* visible_set = std::get_if<cull::VisibleSetStep>(&step);
    if (visible_set == nullptr) continue;
    if (path.visible_sets() == nullptr)
      throw Error("", "pre_cull", "visible_set: this path has no triangles to build it of", ExitCode::internal);
    sets.push_back(path.visible_sets()->of(path.camera_path(), *visible_set, config.seed, config.threads));
  }
  return std::make_shared<const cull::PreCull>(spec, std::move(sets));
}

}  // namespace

PathCulls::PathCulls(const config::Config& config, const GroupPlan& group, const PathFrames& path) {
  for (const CasePlan& case_plan : group.cases) add(config, case_plan.pre_cull, path);
}

PathCulls::PathCulls(const config::Config& config, const CasePlan& case_plan, const PathFrames& path) {
  add(config, case_plan.pre_cull, path);
}

void PathCulls::add(const config::Config& config, std::size_t pre_cull, const PathFrames& path) {
  culls_.resize(config.pre_culls.size());
  if (!culls_[pre_cull]) culls_[pre_cull] = pre_cull_on(config, pre_cull, path);
}

std::vector<std::uint32_t> most_kept_lights(const config::Config& config, const GroupPlan& group,
                                            const PathFrames& path, const PathCulls& culls,
                                            const std::vector<Method>& methods) {
  std::vector<std::uint32_t> most(methods.size(), 0);
  const bool culls_any =
      std::ranges::any_of(methods, [&](const Method& method) { return !culls.of(method).is_none(); });
  if (!culls_any) return most;
  GridOfFrames grids(config.grids[group.grid]);
  cull::FrameCull found;
  for (int index = 0; index < path.count(); ++index) {
    const view::Frame frame = path.frame(index);
    grids.update(path, frame);
    const grid::Grid& grid = grids.grid();
    const FrameLights lights(config.precisions, view::lights_in(frame, grid::space_of(grid, frame)));
    for (std::size_t i = 0; i < methods.size(); ++i) {
      if (culls.of(methods[i]).is_none()) continue;
      culls.of(methods[i]).cull(frame, grid, lights.in_precision(methods[i].precision), found);
      most[i] = std::max(most[i], static_cast<std::uint32_t>(found.kept.size()));
    }
  }
  return most;
}

std::uint32_t GroupCulls::max_lights_of(const Method& method) const {
  return most_lights[static_cast<std::size_t>(std::ranges::find(methods, method) - methods.begin())];
}

void CulledRun::build(const grid::Grid& grid, const assign::LightKinds& kinds) {
  grid_ = &grid;
  run_.build(grid, kinds);
}

void CulledRun::assign(const view::Frame& frame, const view::LightArrays& lights, const depth::DepthImage* depth) {
  if (pre_cull_->is_none()) return run_.assign({frame, lights, depth});
  pre_cull_->cull(frame, *grid_, lights, cull_);
  cull::PreCull::give_source(lights, cull_);
  run_.assign({frame, cull_.lights, depth});
}

const assign::Lists& CulledRun::cell_lists(assign::ListOrder order) const {
  if (pre_cull_->is_none()) return run_.cell_lists(order);
  mapped_lists_ = run_.cell_lists(order);
  assign::map_lights(mapped_lists_.lights, cull_.kept);
  return mapped_lists_;
}

const assign::Lists& CulledRun::lists_for(assign::Storage& storage) const {
  if (!pre_cull_->is_none()) storage.set_types(cull_.lights);
  return *run_.filled_lists();
}

std::optional<assign::MappedStructure> CulledRun::mapped(const assign::LightStructure& structure) const {
  if (pre_cull_->is_none()) return std::nullopt;
  return assign::MappedStructure(structure, cull_.kept);
}

}  // namespace clusterbench::run
