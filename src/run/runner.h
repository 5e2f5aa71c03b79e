#pragma once
// Runs a plan: truth, error, occupancy, buffers, then time.

#include <atomic>
#include <functional>
#include <optional>
#include <span>

#include "gpu/device/device_facts.h"
#include "run/cases/plan.h"
#include "run/findings/run_result.h"
#include "run/passes/count_pass.h"

namespace clusterbench::run {

struct Progress {
  std::size_t cases_done = 0, cases_total = 0;
  double cost_done = 0.0, cost_total = 0.0;  // an estimate of work, for the remaining time
  std::string doing;                         // case name and stage
};

// Approximate time of a group, in nanoseconds: counting, timing, timing of what runs on a device, and readings.
struct GroupCost {
  double counting_ns = 0.0, timing_ns = 0.0, device_ns = 0.0, reading_ns = 0.0;
};

// A group's cases that the processor's clock times: not those that run on a device, and of the presets only those of
// engines that assign on the CPU.
GroupPlan timed_cases(const config::Config& config, GroupPlan group);
// Those that run on a device, and the others.
GroupPlan device_cases(const config::Config& config, GroupPlan group);
GroupPlan processor_cases(const config::Config& config, GroupPlan group);

// The device, if a case of the plan runs on it or is read on it.
std::optional<gpu::DeviceFacts> device_of(const config::Config& config, const Plan& plan);

// Callbacks of the runner while it works. All are optional.
struct Listener {
  std::function<void(const Progress&)> on_progress;
  std::function<void(const SceneResult&)> on_scene;
  std::function<void(const CaseResult&)> on_case;  // after every case, its group's timing included
  std::function<void(const result::BrokenCase&)> on_broken;
};

// A group whose lists have been counted, to be timed.
struct GroupToTime {
  const GroupPlan* group = nullptr;
  std::vector<int> fullest_frames;  // of LaunchRequest
};

// One launch: another process of this program times groups of one scene, `rounds` rounds each. Returns samples in the
// order of the groups; fewer once `stop` is true. `on_group` is called before each group. Throws assign::MethodError
// for a method of a plug-in that fails there.
using Launcher = std::function<std::vector<GroupSamples>(std::span<const GroupToTime> groups, int launch, int rounds,
                                                         const std::function<void(std::size_t group)>& on_group)>;

// `done`: ids of cases that an earlier, interrupted run has finished; they are skipped. `counts`: instruction counts of
// cases, for their results. `launcher`: without one this process times all rounds itself, in one launch. `stop` is
// checked between steps; once it is true the runner returns the complete cases. `costs`: of the plan's groups
// (run/estimate.h), for the displayed progress; without them it uses rough constants.
Result run_plan(const config::Config& config, const Plan& plan, const std::vector<std::string>& done,
                const Listener& listener, const std::atomic<bool>& stop, const Counts& counts = {},
                const Launcher& launcher = {}, std::span<const GroupCost> costs = {});

}  // namespace clusterbench::run
