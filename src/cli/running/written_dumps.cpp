#include "cli/running/written_dumps.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "cli/output/output.h"
#include "cli/output/output_folder.h"
#include "core/error.h"
#include "core/text.h"
#include "dump/write_dump.h"
#include "pictures/file_names.h"
#include "run/cases/frame_lights.h"
#include "run/cases/path_culls.h"
#include "run/cases/path_frames.h"

namespace clusterbench::cli {
namespace {

// Lights that a storage had no room for.
struct CutOff {
  std::uint64_t lists = 0, pairs = 0;

  CutOff& operator+=(const assign::StructureUse& use) {
    lists += use.overflowing_cells;
    pairs += use.dropped_pairs;
    return *this;
  }
};

// The lists in the case's storage, or as `packed` where dumps have no words for it.
layout::Described described_lists(const config::Config& config, const run::CasePlan& plan, const assign::Lists& lists,
                                  const grid::Grid& grid, const view::LightRanges& lights, CutOff& cut_off) {
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
  if (auto described = shader ? layout::describe(*shader) : std::nullopt) {
    cut_off += storage->use();
    return *std::move(described);
  }
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

// Writes the cases of a plan, and says which have no dump.
class DumpWriter {
 public:
  DumpWriter(const config::Config& config, const std::string& folder) : config_(config), folder_(folder) {}

  void write_group(const run::Plan& plan, const run::GroupPlan& group, int frames) {
    const run::PathFrames path = run::path_of(config_, plan, group);
    const run::PathCulls culls(config_, group, path);
    run::GridOfFrames grids(config_.grids[group.grid]);
    for (const int index : run::evenly_spaced(frames, path.count())) {
      const view::Frame frame = path.frame(index);
      grids.update(path, frame);
      const run::FrameLights lights(config_.precisions, view::lights_in(frame, grid::space_of(grids.grid(), frame)));
      const auto depths = run::depths_for(config_, group, path, frame);
      for (const run::CasePlan& case_plan : group.cases) {
        run::CulledRun run(config_, case_plan.method(), culls.of(case_plan.method()));
        if (!run.has_cells() || run.has_occupied_cells()) {
          leave_out(case_plan.name, "its structure has no lists of the grid's cells");
          continue;
        }
        const view::LightArrays& packed = lights.in_precision(case_plan.method().precision);
        run.build(grids.grid(), assign::kinds_of(packed));
        run.assign(frame, packed, depths.get());
        write_case(case_plan, frame, grids.grid(), run.cell_lists());
      }
    }
    for (const run::CasePlan& case_plan : group.cases) tell_cut_off(case_plan.name);
  }
  const WrittenDumps& written() const { return written_; }

 private:
  void tell_cut_off(const std::string& case_name) {
    const CutOff& found = cut_off_[case_name];
    if (found.lists > 0)
      written_.remarks.push_back(case_name + ": " + number_of(found.lists, "list") +
                                 (found.lists == 1 ? " is" : " are") + " cut off where the storage has no room, by " +
                                 number_of(found.pairs, "light") +
                                 " in all, which `check` finds lost: give the storage a larger cap");
  }

  void leave_out(const std::string& case_name, const std::string& reason) {
    add_once(case_name + ": no dump: " + reason, written_.remarks);
  }

  void write_case(const run::CasePlan& plan, const view::Frame& frame, const grid::Grid& grid,
                  const assign::Lists& lists) {
    std::optional<dump::MadeDump> made;
    try {
      made = dump::make_dump(frame, grid,
                             described_lists(config_, plan, lists, grid, frame.ranges(), cut_off_[plan.name]));
    } catch (const Error& error) {
      return leave_out(plan.name, error.message());
    }
    made->record.name = plan.name + ", frame " + std::to_string(frame.index);
    made->record.engine = "clusterbench";
    dump::write_dump(std::move(*made), folder_, dump_name(plan.name, frame.index));
    ++written_.count;
  }

  const config::Config& config_;
  const std::string& folder_;
  WrittenDumps written_;
  std::map<std::string, CutOff> cut_off_;  // by case, of all its frames
};

}  // namespace

void refuse_beside_dumps(const RunFlags& flags) {
  const auto has_fail_if = [](const config::FlagValue& flag) { return flag.name == "--fail-if"; };
  const std::pair<const char*, bool> excluded[] = {
      {"-o", !flags.output.empty()},
      {"--export", !flags.exports.empty()},
      {"--images", !flags.images.folder.empty()},
      {"--fail-if", std::ranges::any_of(flag_values(flags.inputs), has_fail_if)},
      {"--baseline", !flags.gates.baseline.empty()},
      {"--baseline-binary", !flags.baseline.binary.empty()},
      {"--count", !flags.count.empty()},
      {"--resume", flags.resume},
  };
  for (const auto& [flag, is_given] : excluded)
    if (is_given)
      throw Error("", "--write-dump",
                  std::string("does not go with ") + flag +
                      ": it writes lists and measures nothing; give it a command of its own");
}

void warn_of_budgets(const config::Config& config) {
  const std::size_t budgets = config.limits.fail_if.size();
  if (budgets > 0)
    print_message("warning: --write-dump measures nothing and does not look at limits.fail_if (" +
                  number_of(budgets, "budget") + ")");
  if (!config.limits.baseline.empty())
    print_message("warning: --write-dump measures nothing and does not look at limits.baseline");
}

WrittenDumps write_dumps(const config::Config& config, const run::Plan& plan, const std::string& folder, int frames) {
  const OutputFolder made(folder);
  DumpWriter writer(config, folder);
  for (const run::GroupPlan& group : plan.groups) writer.write_group(plan, group, frames);
  if (writer.written().count == 0)
    throw Error(
        "", "--write-dump",
        "has written no dump" + (writer.written().remarks.empty() ? std::string(": the plan has no cases")
                                                                  : "; " + joined(writer.written().remarks, "; ")));
  return writer.written();
}

}  // namespace clusterbench::cli
