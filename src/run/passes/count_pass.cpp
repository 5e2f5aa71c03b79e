#include "run/passes/count_pass.h"

#include "assign/lists/list_builder.h"
#include "core/error.h"
#include "os/call_notes.h"
#include "run/timing/timed_work.h"

namespace clusterbench::run {
namespace {

template <class Work>
Counted counted(InstructionCounter& counter, Work work) {
  counter.start();
  work();
  return counter.stop();
}

void check_threads(const config::MethodRequest& assigner, const InstructionCounter& counter) {
  if (!counter.counts_all_threads() && is_threaded(assigner))
    throw Error("", std::string("--count=") + counter.source(),
                "counts one thread, and " + assigner.label() + " takes several; take --count=callgrind, or one thread");
}

// The counts of one method's cases, in the order of its storages.
std::vector<CountResult> count_method(TimedWork& work, InstructionCounter& counter) {
  CountResult result;
  result.source = counter.source();
  result.simd_target = assign::simd_target_name();
  result.frames = static_cast<int>(work.frame_count());
  result.build = counted(counter, [&] { work.build(); });
  if (work.culls()) result.pre_cull = counted(counter, [&] { work.cull(); });
  work.assign();  // so that memory has grown
  result.assign = counted(counter, [&] { work.assign(); });
  if (!work.converts()) return {result};
  std::vector<CountResult> results;
  for (std::size_t store = 0; store < work.case_indices().size(); ++store) {
    work.convert(store);
    result.convert = counted(counter, [&] { work.convert(store); });
    results.push_back(result);
  }
  return results;
}

}  // namespace

void count_pass(const config::Config& config, const Plan& plan, const std::function<bool(const CasePlan&)>& is_wanted,
                InstructionCounter& counter, const std::function<void(const CasePlan&, const CountResult&)>& on_case,
                const std::atomic<bool>& stop) {
  for (GroupPlan group : plan.groups) {
    std::erase_if(group.cases, [&](const CasePlan& case_plan) {
      return !is_wanted(case_plan) || method_of(config, case_plan).on_device;
    });
    if (group.cases.empty()) continue;
    os::note_group(group.cases.front().id);
    os::note_pass("count of instructions");
    const PathFrames path = path_of(config, plan, group);
    const std::vector<TimedFrame> frames = timed_frames(config, group, path, mean_frames(config, path));
    for (const Method& method : methods_of(group)) {
      if (stop) return;
      check_threads(config.assigners[method.assigner], counter);
      TimedWork work(config, group, method, frames);
      const std::vector<CountResult> results = count_method(work, counter);
      for (std::size_t i = 0; i < results.size(); ++i) on_case(group.cases[work.case_indices()[i]], results[i]);
    }
  }
}

}  // namespace clusterbench::run
