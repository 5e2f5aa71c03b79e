#include "run/runner.h"

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <utility>

#include "config/config_plugins.h"
#include "config/presets/preset_library.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"
#include "core/turns.h"
#include "core/work_in_order.h"
#include "gpu/device/device.h"
#include "os/call_notes.h"
#include "os/machine.h"
#include "run/case_result.h"
#include "run/cases/path_frames.h"
#include "run/counted_group.h"
#include "run/findings/broken_cases.h"
#include "run/findings/gate.h"
#include "run/passes/accuracy_pass.h"
#include "run/passes/device_pass.h"
#include "run/passes/reading_pass.h"
#include "run/passes/timing_pass.h"
#include "run/progress_costs.h"
#include "run/scene_facts.h"

namespace clusterbench::run {
namespace {

// Per method of the group: the frame in which it has most pairs. A method without cells uses the frame of the first one
// with cells.
std::vector<int> fullest_frames(const GroupPlan& group, const AccuracyResult& counted) {
  const auto measures_of = [&](const Method& method) -> const MethodMeasures& {
    return *std::find_if(counted.methods.begin(), counted.methods.end(),
                         [&](const MethodMeasures& measures) { return measures.method == method; });
  };
  int known = -1;
  for (const Method& method : methods_of(group))
    if (known < 0 && measures_of(method).has_cells) known = measures_of(method).occupancy.fullest_frame;
  std::vector<int> frames;
  for (const Method& method : methods_of(group))
    frames.push_back(measures_of(method).has_cells ? measures_of(method).occupancy.fullest_frame : known);
  return frames;
}

// Methods that emulate an engine's shader or rasteriser are not timed: their time here says nothing about the engine's.
bool emulates_gpu(const CasePlan& case_plan) {
  const config::Preset* preset = config::find_preset(case_plan.preset);
  return preset != nullptr && preset->assigns_on_gpu();
}

bool is_timed(const config::Config& config, const CasePlan& case_plan) {
  return !emulates_gpu(case_plan) && !method_of(config, case_plan).on_device;
}

// A group whose counts are complete but whose times are missing.
struct CountedGroup : GroupCounts {
  GroupPlan group;
  GroupPlan timed;                                       // its timed cases
  std::vector<std::optional<DeviceTimes>> device_times;  // by case
  std::vector<ReadCase> readings;                        // by case; empty if not requested
};

// What counting a group came to: neither, if it was stopped.
struct Counting {
  std::optional<GroupCounts> counts;
  std::exception_ptr failure;
};

class Run {
 public:
  Run(const config::Config& config, const Plan& plan, const std::vector<std::string>& done, const Listener& listener,
      const std::atomic<bool>& stop, const Counts& counts, const Launcher& launcher, std::span<const GroupCost> costs)
      : config_(config),
        plan_(plan),
        done_(done.begin(), done.end()),
        listener_(listener),
        stop_(stop),
        counts_(counts),
        launcher_(launcher),
        costs_(config, plan, costs),
        on_one_thread_(config) {
    on_one_thread_.threads = 1;
    progress_.cases_total = plan.case_count();
    for (const GroupPlan& group : plan.groups) {
      const GroupPlan left = unfinished_part(group);
      progress_.cases_done += group.cases.size() - left.cases.size();
      if (left.cases.empty()) continue;
      progress_.cost_total += costs_.all(left);
    }
  }

  Result result() {
    Result out;
    out.config_name = config_.name;
    out.tool = tool_facts();
    out.plugins = config::plugins_of(config_);
    out.machine = machine_facts();
    out.device = device_of(config_, plan_);
    if (out.device) out.arithmetic = known_arithmetic();
    if (config_.timing.measure) note_beginning(out);
    out.config = config_.resolved;
    out.shard = plan_.shard;
    out.skipped = plan_.skipped;
    for (std::size_t i = 0; i < plan_.scenes.size(); ++i) {
      out.scenes.push_back(scene_result(plan_.scenes[i], config_.scenes[i], config_.viewports, config_.threads));
      if (listener_.on_scene) listener_.on_scene(out.scenes.back());
    }
    for (const GroupPlan& group : plan_.groups)
      for (const CasePlan& case_plan : group.cases) out.planned_ids.push_back(case_plan.id);
    run_groups(out);
    if (!stop_) time_waiting(out);
    if (out.machine.load) out.machine.load->end = os::load_now().value_or(out.machine.load->begin);
    return out;
  }

 private:
  // None if the device fails at it; what runs on it then says why it fails.
  static std::optional<gpu::Arithmetic> known_arithmetic() {
    try {
      return gpu::arithmetic_of_device();
    } catch (const gpu::DeviceError&) {
      gpu::close_device();
      return std::nullopt;
    }
  }

  // Facts that times can depend on. Without times a result has no date, so that it is the same every time.
  static void note_beginning(Result& out) {
    out.date = os::utc_now();
    out.machine.clock = os::clock_now();
    if (const std::optional<double> load = os::load_now()) out.machine.load = LoadFacts{*load, *load};
  }

  GroupPlan unfinished_part(GroupPlan group) const {
    std::erase_if(group.cases, [&](const CasePlan& case_plan) { return done_.contains(case_plan.id); });
    return group;
  }

  // For whoever has to tell in which work a plug-in broke down.
  static void note(const GroupPlan& group, const char* stage) {
    os::note_group(group.cases.front().id);
    os::note_pass(stage);
  }

  void report_progress(const GroupPlan& group, const char* stage, double cost) {
    const std::lock_guard lock(reporting_);
    progress_.cost_done += cost;
    costs_reported_[group.cases.front().id] += cost;
    const std::string& name = group.cases.front().name;
    progress_.doing = name.substr(0, name.find('/', name.find('/', name.find('/') + 1) + 1)) + ": " + stage;
    if (listener_.on_progress) listener_.on_progress(progress_);
  }
  // Of a group that is measured again.
  void take_back_progress(const GroupPlan& group) {
    const std::lock_guard lock(reporting_);
    progress_.cost_done -= std::exchange(costs_reported_[group.cases.front().id], 0.0);
  }
  // Changes the progress; then reports it.
  template <class Change>
  void change_progress(const Change& change) {
    const std::lock_guard lock(reporting_);
    change(progress_);
    if (listener_.on_progress) listener_.on_progress(progress_);
  }

  std::size_t threads() const { return static_cast<std::size_t>(config_.threads); }

  // Groups that may be counted at the same time, one after another; and those that may not, each alone.
  void run_groups(Result& out) {
    std::vector<GroupPlan> together;
    const std::size_t most = (config_.timing.measure ? k_timed_groups_of_thread : k_groups_of_thread) * threads();
    for (const GroupPlan& planned : plan_.groups) {
      GroupPlan group = unfinished_part(planned);
      if (stop_ || group.cases.empty()) continue;
      const bool is_alone = config_.threads == 1 || runs_elsewhere(config_, group);
      if (is_alone || together.size() == most) run_together(std::exchange(together, {}), out);
      if (is_alone)
        run_group(group, out);
      else
        together.push_back(std::move(group));
    }
    run_together(together, out);
  }

  // Counts groups on several threads. They are timed and added in their order: where something is timed after all are
  // counted, so that it runs alone; else at once, so that an interrupted run loses little.
  void run_together(const std::vector<GroupPlan>& groups, Result& out) {
    if (stop_ || groups.empty()) return;
    if (groups.size() == 1) return run_group(groups.front(), out);
    std::vector<Counting> countings(groups.size());
    const auto finish = [&](std::size_t i) { finish_group(groups[i], std::exchange(countings[i], {}), out); };
    std::atomic<bool> has_failed = false;
    const Stop stop(stop_, has_failed);
    InOrder in_order(groups.size(), finish);
    ThreadPool pool(config_.threads);
    make_first_path(groups);
    each_in_order(pool, groups.size(), [&](std::size_t i) {
      const config::Config& config = is_near_end(i, groups.size(), pool) ? config_ : on_one_thread_;
      countings[i] = counted_beside_others(groups[i], config, stop);
      if (config_.timing.measure || stop) return;
      try {
        in_order.ready(i);
      } catch (...) {
        has_failed = true;
        throw;
      }
    });
    for (std::size_t i = 0; config_.timing.measure && i < groups.size() && !stop_; ++i) finish(i);
  }

  // Its lights, before the groups share the threads, since all would only wait for them. What it throws, the first
  // group throws again.
  void make_first_path(const std::vector<GroupPlan>& groups) {
    try {
      path_of(config_, plan_, groups.front());
    } catch (const Error&) {
    }
  }

  Counting counted_beside_others(const GroupPlan& group, const config::Config& config, const Stop& stop) {
    Counting out;
    try {
      const PathFrames path = path_of(config_, plan_, group);
      const BudgetShare share(lists_, most_list_bytes(config, group, path), stop);
      if (share.has_it() && !stop) out.counts = counted(config, group, path, stop);
    } catch (...) {
      out.failure = std::current_exception();
    }
    return out;
  }

  std::optional<GroupCounts> counted(const config::Config& config, const GroupPlan& group, const PathFrames& path,
                                     const Stop& stop) {
    const bool notes = runs_elsewhere(config_, group);
    const double costs[] = {costs_.counting(group), costs_.stability(group), costs_.details(group)};
    const auto on_counting = [&](CountingStage stage, double share) {
      if (notes) note(group, name_of(stage));
      if (share > 0.0) report_progress(group, name_of(stage), share * costs[static_cast<std::size_t>(stage)]);
    };
    return count_group(config, plan_.scenes[group.scene], group, path, on_counting, stop);
  }

  void run_group(const GroupPlan& group, Result& out) {
    attempt(group, out, [&] {
      const PathFrames path = path_of(config_, plan_, group);
      std::optional<GroupCounts> counts = counted(config_, group, path, stop_);
      if (counts) conclude(group, std::move(*counts), out);
    });
  }

  void finish_group(const GroupPlan& group, Counting counting, Result& out) {
    attempt(group, out, [&] {
      if (counting.failure) std::rethrow_exception(counting.failure);
      if (counting.counts) conclude(group, std::move(*counting.counts), out);
    });
  }

  // With a launcher, several groups of a scene wait until they are timed together: each launch then starts only once
  // for all of them, some time after the previous launch.
  template <class Work>
  void attempt(const GroupPlan& group, Result& out, const Work& work) {
    if (group.cases.empty()) return;
    if (!waiting_.empty() && (waiting_.front().group.scene != group.scene || waiting_cost() > k_most_waiting_ns))
      time_waiting(out);
    if (stop_) return;
    try {
      work();
    } catch (const gpu::ShaderFault& fault) {
      take_back_progress(group);
      run_apart(group, fault.message(), true, out);
    } catch (const gpu::DeviceError& error) {
      gpu::close_device();
      if (stop_) return;  // it may have been left at work
      take_back_progress(group);
      run_apart(group, error.message(), false, out);
    } catch (const assign::MethodError& error) {
      take_back_progress(group);
      run_without_broken(group, error, out);
    } catch (const Error& error) {
      throw error_at(group, error);
    }
  }

  // After a failure of the device: the group without its cases, then each method on the device alone. One that fails
  // alone is skipped.
  void run_apart(const GroupPlan& group, const std::string& reason, bool is_fault, Result& out) {
    std::vector<GroupPlan> parts(1, processor_cases(config_, group));
    const GroupPlan on_device = device_cases(config_, group);
    for (const Method& method : methods_of(on_device)) {
      GroupPlan part = on_device;
      std::erase_if(part.cases, [&](const CasePlan& case_plan) { return case_plan.method() != method; });
      parts.push_back(std::move(part));
    }
    std::erase_if(parts, [](const GroupPlan& part) { return part.cases.empty(); });
    if (parts.size() > 1) {
      double cost = 0.0;
      for (const GroupPlan& part : parts) cost += costs_.all(part);
      change_progress([&](Progress& now) { now.cost_total += cost - costs_.all(group); });
      for (const GroupPlan& part : parts) run_group(part, out);
      return;
    }
    change_progress([&](Progress& now) { now.cost_total -= costs_.all(group); });
    for (const CasePlan& case_plan : group.cases) {
      if (is_fault)
        add_broken(case_plan, {"failed", reason, os::CallStep::assign, -1, "", ""}, out);
      else
        out.skipped.push_back({case_plan.name, reason, false, case_plan.preset});
    }
    if (!is_fault) change_progress([&](Progress& now) { now.cases_done += group.cases.size(); });
  }

  // After a failure of a plug-in: its cases are broken, and the others of the group are measured again.
  void run_without_broken(const GroupPlan& group, const assign::MethodError& error, Result& out) {
    const std::uint64_t label = os::last_call().label;
    const auto is_of_method = [&](const CasePlan& case_plan) {
      return method_of(config_, case_plan).name == error.method();
    };
    const auto has_label = [&](const CasePlan& case_plan) { return label_of(case_plan.method()) == label; };
    const bool is_known =
        std::ranges::any_of(group.cases, [&](const CasePlan& one) { return has_label(one) && is_of_method(one); });
    GroupPlan rest = group;
    std::erase_if(rest.cases, [&](const CasePlan& one) { return is_of_method(one) && (!is_known || has_label(one)); });
    for (const CasePlan& one : group.cases)
      if (std::ranges::find(rest.cases, one.id, &CasePlan::id) == rest.cases.end())
        add_broken(one, breakdown_of(error, method_of(config_, one).plugin), out);
    if (rest.cases.size() == group.cases.size()) throw assign::MethodError(error);
    const double cost = rest.cases.empty() ? 0.0 : costs_.all(rest);
    change_progress([&](Progress& now) { now.cost_total += cost - costs_.all(group); });
    run_group(rest, out);
  }

  void add_broken(const CasePlan& case_plan, const Breakdown& breakdown, Result& out) {
    out.broken.push_back(broken_case(config_, plan_, case_plan, breakdown));
    const std::lock_guard lock(reporting_);
    ++progress_.cases_done;
    if (listener_.on_broken) listener_.on_broken(out.broken.back());
  }

  double waiting_cost() const {
    double cost = 0.0;
    for (const CountedGroup& counted_group : waiting_) cost += costs_.timing(counted_group.group);
    return cost;
  }

  // What is left to do once a group is counted: times, and its results.
  void conclude(const GroupPlan& group, GroupCounts counts, Result& out) {
    CountedGroup counted_group{std::move(counts), group, timed_cases(config_, group), {}, {}};
    if (!config_.timing.measure) return add_cases(counted_group, {}, out);
    const PathFrames path = path_of(config_, plan_, group);
    if (!time_on_device(group, path, counted_group)) return;
    if (!config_.reading_sets.empty()) {
      report_timing(group, "reading on the device", costs_.reading(group));
      counted_group.readings = reading_pass(config_, plan_.scenes[group.scene], group, path, stop_);
      if (counted_group.readings.empty()) return;
    }
    if (counted_group.timed.cases.empty()) return add_cases(counted_group, {}, out);
    if (launcher_) return waiting_.push_back(std::move(counted_group));
    time_here(counted_group, path, out);
  }

  // Of work on the calling thread, beside which there is none.
  void report_timing(const GroupPlan& group, const char* stage, double cost) {
    note(group, stage);
    report_progress(group, stage, cost);
  }

  // False if it was stopped.
  bool time_on_device(const GroupPlan& group, const PathFrames& path, CountedGroup& out) {
    const GroupPlan on_device = device_cases(config_, group);
    if (on_device.cases.empty()) return true;
    const int launches = launcher_ ? config_.timing.launches : 1;
    const double per_round = costs_.device(group) / (launches * rounds_per_launch(config_.timing, launches));
    std::vector<std::optional<DeviceTimes>> times = device_pass(
        config_, on_device, path, launches, [&] { report_timing(group, "time on the device", per_round); }, stop_);
    if (times.empty()) return false;
    auto next = times.begin();
    for (const CasePlan& case_plan : group.cases) {
      out.device_times.emplace_back();
      if (method_of(config_, case_plan).on_device) out.device_times.back() = std::move(*next++);
    }
    return true;
  }

  void time_here(CountedGroup& counted_group, const PathFrames& path, Result& out) {
    const LaunchRequest request{0, config_.timing.rounds, fullest_frames(counted_group.timed, counted_group.counted)};
    const double per_round = costs_.timing(counted_group.group) / request.rounds;
    note(counted_group.group, "time");
    const GroupSamples samples = measure_launch(
        config_, counted_group.timed, path, request,
        [&](int) { report_timing(counted_group.group, "time", per_round); }, stop_);
    begin_session();
    if (!samples.methods.empty())
      add_cases(counted_group, timing_results(config_, counted_group.timed, std::span(&samples, 1)), out);
  }

  void time_waiting(Result& out) {
    while (!waiting_.empty()) {
      std::size_t timed = 0;
      try {
        return time_waiting(out, timed);
      } catch (const assign::MethodError& error) {
        const GroupPlan group = waiting_[timed].group;
        take_back_progress(group);
        waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(timed));
        run_without_broken(group, error, out);
      }
    }
  }

  // `timed`: the group that a launch measures.
  void time_waiting(Result& out, std::size_t& timed) {
    std::vector<GroupToTime> groups;
    for (const CountedGroup& counted_group : waiting_)
      groups.push_back({&counted_group.timed, fullest_frames(counted_group.timed, counted_group.counted)});
    const int launches = config_.timing.launches, rounds = rounds_per_launch(config_.timing, launches);
    std::vector<std::vector<GroupSamples>> samples(groups.size());
    for (int launch = 0; launch < launches; ++launch) {
      const std::string stage = "time, launch " + std::to_string(launch + 1) + " of " + std::to_string(launches);
      std::vector<GroupSamples> measured = launcher_(groups, launch, rounds, [&](std::size_t group) {
        timed = group;
        report_timing(*groups[group].group, stage.c_str(), costs_.timing(*groups[group].group) / launches);
      });
      if (stop_ || measured.size() != groups.size()) return;
      for (std::size_t i = 0; i < groups.size(); ++i) samples[i].push_back(std::move(measured[i]));
    }
    begin_session();
    for (std::size_t i = 0; i < waiting_.size(); ++i)
      add_cases(waiting_[i], timing_results(config_, waiting_[i].timed, samples[i]), out);
    waiting_.clear();
  }

  // A name that no other session has, of any run on any machine.
  void begin_session() {
    std::random_device random;
    constexpr std::size_t k_digits = 12;
    session_ = sha256_hex(os::utc_now() + std::to_string(random()) + std::to_string(random())).substr(0, k_digits);
  }

  // `timings`: of the timed cases.
  void add_cases(CountedGroup& counted, const std::vector<TimingResult>& timings, Result& out) {
    std::size_t next_timed = 0;
    for (std::size_t i = 0; i < counted.group.cases.size(); ++i) {
      CaseResult finished = case_result(config_, plan_, counted.group.cases[i], counted.frames, counted.counted, i);
      if (counted.unfitted) finished.fit = fit_result(counted, i);
      if (counted.tile_moves) finished.reaction = reaction_result(counted, i);
      if (!counted.stabilities.empty()) finished.stability = counted.stabilities[i];
      if (!counted.details.empty()) finished.details = std::move(counted.details[i]);
      if (!counted.device_times.empty()) finished.device = std::move(counted.device_times[i]);
      if (!counted.readings.empty()) {
        finished.reading = std::move(counted.readings[i].reading);
        finished.unread = std::move(counted.readings[i].obstacle);
        finished.failures = failures_of(finished, config_.limits);
      }
      if (!timings.empty() && is_timed(config_, counted.group.cases[i])) {
        finished.timing = timings[next_timed++];
        finished.timing->session = session_;
        finished.timing->shadow_culls = finished.shadow_culls;
      }
      if (const auto count = counts_.find(finished.id); count != counts_.end()) finished.count = count->second;
      {
        const std::lock_guard lock(reporting_);
        ++progress_.cases_done;
        if (listener_.on_case) listener_.on_case(finished);
      }
      out.cases.push_back(std::move(finished));
    }
  }

  CaseSide method_side(const AccuracyResult& counted, const Method& of, std::size_t index, bool compares_cells) const {
    const MethodMeasures& method = *std::ranges::find(counted.methods, of, &MethodMeasures::method);
    CaseSide side = structure_side(counted.structures[index]);
    if (method.has_cells) side.pairs_mean = method.occupancy.pairs.mean;
    if (method.has_cells && compares_cells) {
      side.true_pairs = method.error.true_pairs;
      side.false_positives = method.error.false_positives;
    }
    side.list_changes = method.list_changes;
    return side;
  }

  FitResult fit_result(const CountedGroup& counted, std::size_t index) const {
    const CasePlan& plan = counted.group.cases[index];
    const bool compares = compares_cells(config_, counted.group);
    FitResult out;
    out.fit = *config_.grids[plan.grid].slices.fit;
    const std::vector<float>& boundaries = counted.unfitted->last_grid.screen().slices.boundaries;
    out.range = {static_cast<double>(boundaries.front()), static_cast<double>(boundaries.back())};
    out.moves = *counted.counted.moves;
    out.fitted = method_side(counted.counted, plan.method(), index, compares);
    out.unfitted = method_side(*counted.unfitted, plan.method(), index, compares);
    return out;
  }

  ReactionResult reaction_result(const CountedGroup& counted, std::size_t index) const {
    const CasePlan& plan = counted.group.cases[index];
    const bool compares = compares_cells(config_, counted.group);
    ReactionResult out{*config_.grids[plan.grid].reaction, *counted.tile_moves, counted.cells,
                       method_side(counted.counted, plan.method(), index, compares), std::nullopt};
    if (counted.fixed) out.fixed = method_side(*counted.fixed, plan.method(), index, compares);
    return out;
  }

  const config::Config& config_;
  const Plan& plan_;
  std::set<std::string> done_;
  const Listener& listener_;
  const std::atomic<bool>& stop_;
  const Counts& counts_;
  const Launcher& launcher_;
  ProgressCosts costs_;
  static constexpr double k_most_waiting_ns = 2e10;
  // That are counted together. All but the last of them use one thread each.
  static constexpr std::size_t k_groups_of_thread = 128, k_timed_groups_of_thread = 4;
  config::Config on_one_thread_;
  Budget lists_{static_cast<double>(memory_limit())};  // of groups that are counted at the same time, in bytes
  std::vector<CountedGroup> waiting_;
  std::string session_;  // of the cases that are being added
  std::mutex reporting_;
  Progress progress_;
  std::map<std::string, double> costs_reported_;  // of groups, by the id of their first case
};

}  // namespace

GroupPlan timed_cases(const config::Config& config, GroupPlan group) {
  std::erase_if(group.cases, [&](const CasePlan& case_plan) { return !is_timed(config, case_plan); });
  return group;
}

std::optional<gpu::DeviceFacts> device_of(const config::Config& config, const Plan& plan) {
  const auto runs_on_it = [&](const GroupPlan& group) { return !device_cases(config, group).cases.empty(); };
  const bool is_used = !config.reading_sets.empty() || std::ranges::any_of(plan.groups, runs_on_it);
  if (!is_used || !gpu::device_obstacle().empty()) return std::nullopt;
  return gpu::device().facts();
}

GroupPlan device_cases(const config::Config& config, GroupPlan group) {
  std::erase_if(group.cases, [&](const CasePlan& case_plan) { return !method_of(config, case_plan).on_device; });
  return group;
}

GroupPlan processor_cases(const config::Config& config, GroupPlan group) {
  std::erase_if(group.cases, [&](const CasePlan& case_plan) { return method_of(config, case_plan).on_device; });
  return group;
}

Result run_plan(const config::Config& config, const Plan& plan, const std::vector<std::string>& done,
                const Listener& listener, const std::atomic<bool>& stop, const Counts& counts, const Launcher& launcher,
                std::span<const GroupCost> costs) {
  return Run(config, plan, done, listener, stop, counts, launcher, costs).result();
}

}  // namespace clusterbench::run
