#include "cli/size_limits.h"

#include "run/path_frames.h"
#include "run/reaction_meter.h"

namespace clusterbench::cli {
namespace {

bool grows_for_lists(const grid::GridSpec& spec) {
  return spec.reaction && spec.reaction->to == grid::Reaction::To::entries;
}

}  // namespace

config::Config without_engine_limits(config::Config config) {
  for (cull::PreCullSpec& spec : config.pre_culls)
    std::erase_if(spec.steps, [](const cull::Step& step) { return std::holds_alternative<cull::MostStep>(step); });
  for (grid::GridSpec& spec : config.grids)
    if (grows_for_lists(spec)) spec = spec.unreacting();
  return config;
}

std::vector<report::GrownTiles> grown_tiles(const config::Config& limited, const run::Plan& plan) {
  std::vector<report::GrownTiles> out;
  for (const run::GroupPlan& group : plan.groups) {
    const grid::GridSpec& spec = limited.grids[group.grid];
    if (!grows_for_lists(spec)) continue;
    const run::TileMoves moves = run::tile_moves(spec, run::path_of(limited, plan, group));
    for (const run::CasePlan& case_plan : group.cases)
      out.push_back({case_plan.name,
                     spec.reaction->most,
                     static_cast<std::uint64_t>(moves.frames),
                     static_cast<std::uint64_t>(moves.reacted),
                     static_cast<std::uint64_t>(moves.over),
                     static_cast<std::uint64_t>(moves.amount.greatest),
                     {moves.requested.x, moves.requested.y},
                     {moves.fewest.x, moves.fewest.y}});
  }
  return out;
}

}  // namespace clusterbench::cli
