#include "cli/running/written_dumps.h"

#include <filesystem>

#include "cli/output/output.h"
#include "dump/write_dump.h"
#include "pictures/file_names.h"
#include "run/cases/frame_lights.h"
#include "run/cases/path_culls.h"
#include "run/cases/path_frames.h"

namespace clusterbench::cli {
namespace {

// The lists in the case's storage, or as `packed` where dumps have no words for it.
layout::Described described_lists(const config::Config& config, const run::CasePlan& plan, const assign::Lists& lists,
                                  const grid::Grid& grid, const view::LightRanges& lights) {
  const assign::StorageDescriptor* row = assign::find_storage("packed");
  assign::Params params(row->params);
  if (plan.storage) {
    row = assign::find_storage(config.storages[*plan.storage].name);
    params = config.storages[*plan.storage].params;
  }
  const auto storage = row->make(params);
  storage->start(grid, lights);
  storage->store(lists);
  const auto shader = storage->shader_buffers();
  if (auto described = shader ? layout::describe(*shader) : std::nullopt) return *std::move(described);
  const assign::StorageDescriptor& packed = *assign::find_storage("packed");
  const auto plain = packed.make(assign::Params(packed.params));
  plain->start(grid, lights);
  plain->store(lists);
  return *layout::describe(*plain->shader_buffers());
}

std::string dump_name(const std::string& case_name, int frame) {
  std::string name;
  for (std::size_t begin = 0; begin <= case_name.size();) {
    const std::size_t end = std::min(case_name.find('/', begin), case_name.size());
    name += (name.empty() ? "" : "_") + pictures::file_part(case_name.substr(begin, end - begin));
    begin = end + 1;
  }
  return name + "_frame-" + std::to_string(frame);
}

}  // namespace

std::size_t write_dumps(const config::Config& config, const run::Plan& plan, const std::string& folder, int frames) {
  std::filesystem::create_directories(folder);
  std::size_t written = 0;
  for (const run::GroupPlan& group : plan.groups) {
    const run::PathFrames path = run::path_of(config, plan, group);
    const run::PathCulls culls(config, group, path);
    run::GridOfFrames grids(config.grids[group.grid]);
    for (const int index : run::evenly_spaced(frames, path.count())) {
      const view::Frame frame = path.frame(index);
      grids.update(path, frame);
      const run::FrameLights lights(config.precisions, view::lights_in(frame, grid::space_of(grids.grid(), frame)));
      const auto depths = run::depths_for(config, group, path, frame);
      for (const run::CasePlan& case_plan : group.cases) {
        const run::Method method = case_plan.method();
        run::CulledRun run(config, method, culls.of(method));
        if (!run.has_cells() || run.has_occupied_cells()) {
          print_message(case_plan.name + ": no dump: its structure has no lists of the grid's cells");
          continue;
        }
        const view::LightArrays& packed = lights.in_precision(method.precision);
        run.build(grids.grid(), assign::kinds_of(packed));
        run.assign(frame, packed, depths.get());
        dump::MadeDump made = dump::make_dump(
            frame, grids.grid(), described_lists(config, case_plan, run.cell_lists(), grids.grid(), frame.ranges()));
        made.record.name = case_plan.name + ", frame " + std::to_string(frame.index);
        made.record.engine = "clusterbench";
        dump::write_dump(std::move(made), folder, dump_name(case_plan.name, frame.index));
        ++written;
      }
    }
  }
  return written;
}

}  // namespace clusterbench::cli
