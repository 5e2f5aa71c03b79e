#include "run/passes/reading_pass.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <memory>

#include "assign/contract/storage.h"
#include "core/error.h"
#include "gpu/device/device.h"
#include "gpu/reading/reading.h"
#include "gpu/reading/reading_check.h"
#include "measure/truth/truth.h"
#include "run/cases/frame_lights.h"
#include "run/cases/frame_samples.h"
#include "run/cases/path_culls.h"

namespace clusterbench::run {
namespace {

using gpu::ReadingOutput;
using gpu::ReadingStructure;
using gpu::Walking;

// Per round, summed over the frames.
struct RoundTimes {
  std::vector<double> warm_ns, cold_ns;

  void add(const gpu::ReadingTimes& more) {
    add_to(warm_ns, more.warm_ns);
    add_to(cold_ns, more.cold_ns);
  }

 private:
  static void add_to(std::vector<double>& sums, const std::vector<double>& more) {
    if (sums.empty()) sums.resize(more.size(), 0.0);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += more[i];
  }
};

// What is known of one case at one set of samples, over the frames so far.
struct SetMeter {
  gpu::ReadingWork work;
  double waiting_lights = 0.0;  // the sum of lights x divergence
  std::uint64_t exact_lights = 0, differing = 0;
  RoundTimes write, nothing;
  std::map<Walking, RoundTimes> own, exact;

  void add(const gpu::ReadingWork& more) {
    work.samples += more.samples;
    work.lights += more.lights;
    work.reads += more.reads;
    work.read_bytes += more.read_bytes;
    waiting_lights += more.divergence * static_cast<double>(more.lights);
  }
};

// A case's structure in the current frame.
struct FrameStructure {
  std::unique_ptr<assign::Storage> storage;  // none: the method's own
  std::unique_ptr<ReadingStructure> on_device;
  ReadingStructure* exact = nullptr;
};

// The methods and the exact lists of a frame, on the device.
class FrameStructures {
 public:
  FrameStructures(const config::Config& config, const GroupPlan& group, const PathFrames& path, const GroupCulls& culls,
                  const view::Frame& frame, const grid::Grid& grid)
      : config_(config),
        grid_(grid),
        frame_(frame),
        all_lights_(view::lights_in(frame, grid::space_of(grid, frame))),
        lights_(config.precisions, all_lights_),
        compares_(compares_cells(config, group)) {
    const std::shared_ptr<const depth::DepthImage> depth = depths_for(config, group, path, frame);
    for (const Method& method : culls.methods) {
      const view::LightArrays& lights = lights_.in_precision(method.precision);
      CulledRun& run = runs_.emplace_back(config, method, culls.path.of(method));
      run.build(grid, assign::kinds_of(lights));
      run.assign(frame, lights, depth.get());
    }
    for (const CasePlan& case_plan : group.cases) {
      const auto of_case = std::ranges::find(culls.methods, case_plan.method());
      add(case_plan, runs_[static_cast<std::size_t>(of_case - culls.methods.begin())], culls);
    }
  }

  std::vector<FrameStructure>& cases() { return cases_; }

 private:
  void add(const CasePlan& case_plan, const CulledRun& run, const GroupCulls& culls) {
    FrameStructure& made = cases_.emplace_back();
    if (case_plan.storage) {
      const std::uint32_t most = culls.max_lights_of(case_plan.method());
      made.storage = storage_of(*case_plan.storage);
      made.storage->start(grid_, run.cull() == nullptr ? frame_.ranges() : view::LightRanges(0, most));
      run.store(*made.storage);
    }
    const assign::LightStructure& structure = made.storage ? *made.storage : *run.own_structure();
    if (!structure.shader_buffers()) return;
    const view::LightArrays& lights =
        run.cull() == nullptr ? lights_.in_precision(case_plan.precision) : run.cull()->lights;
    made.on_device = std::make_unique<ReadingStructure>(structure, grid_, lights);
    if (compares_) made.exact = exact_in(case_plan.storage);
  }

  std::unique_ptr<assign::Storage> storage_of(const std::optional<std::size_t>& index) const {
    if (!index) {
      const assign::StorageDescriptor& packed = *assign::find_storage("packed");
      return packed.make(assign::Params(packed.params));
    }
    const config::MethodRequest& request = config_.storages[*index];
    return assign::find_storage(request.name)->make(request.params);
  }

  // The exact lists in the same storage; beside a method's own structure in `packed`.
  ReadingStructure* exact_in(const std::optional<std::size_t>& index) {
    Exact& exact = exact_[index];
    if (exact.on_device) return exact.on_device.get();
    if (truth_.begin.empty()) truth_ = measure::find_truth(frame_, grid_, config_.threads).lists;
    exact.storage = storage_of(index);
    exact.storage->start(grid_, frame_.ranges());
    exact.storage->store(truth_);
    exact.on_device = std::make_unique<ReadingStructure>(*exact.storage, grid_, all_lights_);
    return exact.on_device.get();
  }

  struct Exact {
    std::unique_ptr<assign::Storage> storage;
    std::unique_ptr<ReadingStructure> on_device;
  };

  const config::Config& config_;
  const grid::Grid& grid_;
  const view::Frame& frame_;
  view::LightArrays all_lights_;
  FrameLights lights_;
  bool compares_;
  std::deque<CulledRun> runs_;  // structures refer to them
  assign::Lists truth_;
  std::map<std::optional<std::size_t>, Exact> exact_;
  std::vector<FrameStructure> cases_;
};

// The readings of one set in one frame: tasks, and where their times belong.
class SetReader {
 public:
  SetReader(const FrameSampleSet& set, const grid::Grid& grid)
      : samples_(set.samples,
                 set.picture ? gpu::in_pixel_blocks(*set.picture) : gpu::in_given_order(set.samples.size()), grid) {}

  void add(const FrameStructure& structure, const std::vector<Walking>& walks, SetMeter& meter) {
    ReadingStructure& own = *structure.on_device;
    meters_.push_back(&meter);
    meter.add(gpu::work_of(own.on_host(), samples_, gpu::device().facts().subgroup_size));
    ReadingStructure* const alike = looking_up_.try_emplace(own.looked_up(), &own).first->second;
    plan({looking_up_.begin()->second, Walking::by_lane, ReadingOutput::write_only}, meter.write);
    plan({alike, Walking::by_lane, ReadingOutput::nothing}, meter.nothing);
    if (structure.exact != nullptr) meter.exact_lights += lights_of(*structure.exact);
    for (const Walking walking : walks) {
      if (!own.allows(walking)) continue;
      checks_.push_back({&own, walking, &meter});
      plan({&own, walking, ReadingOutput::lights}, meter.own[walking]);
      if (structure.exact == nullptr || !structure.exact->allows(walking)) continue;
      checks_.push_back({structure.exact, walking, &meter});
      plan({structure.exact, walking, ReadingOutput::lights}, meter.exact[walking]);
    }
  }

  // Holds every walk against the host, and every lookup.
  void check(const std::atomic<bool>& stop) {
    std::map<std::pair<ReadingStructure*, Walking>, std::uint64_t> differing;
    for (const Check& check : checks_) {
      if (stop) return;
      const auto [known, is_new] = differing.try_emplace({check.structure, check.walking}, 0);
      if (is_new) known->second = gpu::check_own_lookup(*check.structure, samples_, check.walking).differing;
      check.meter->differing += known->second;
    }
    for (const auto& [_, structure] : looking_up_) lost_ += gpu::check_lookup(*structure, samples_).unexplained;
    for (SetMeter* meter : meters_) meter->differing += lost_;
  }

  void read(int rounds, const std::atomic<bool>& stop) {
    gpu::ReadingPlan how;
    how.rounds = rounds;
    how.stop = &stop;
    const std::vector<gpu::ReadingTimes> times = gpu::read_in_turns(tasks_, samples_, how);
    for (std::size_t i = 0; i < times.size(); ++i)
      for (RoundTimes* sums : times_of_[i]) sums->add(times[i]);
  }

 private:
  struct Check {
    ReadingStructure* structure;
    Walking walking;
    SetMeter* meter;
  };

  // That the samples walk in exact lists, which several cases share.
  std::uint64_t lights_of(ReadingStructure& exact) {
    const auto [known, is_new] = exact_lights_.try_emplace(&exact, 0);
    if (is_new) known->second = gpu::work_of(exact.on_host(), samples_, 1).lights;
    return known->second;
  }

  // Equal readings, those of exact lists that several cases share, are done once.
  void plan(const gpu::ReadingTask& task, RoundTimes& times) {
    const auto same = std::ranges::find_if(tasks_, [&](const gpu::ReadingTask& other) {
      return other.structure == task.structure && other.walking == task.walking && other.output == task.output;
    });
    const auto index = static_cast<std::size_t>(same - tasks_.begin());
    if (same == tasks_.end()) {
      tasks_.push_back(task);
      times_of_.emplace_back();
    }
    times_of_[index].push_back(&times);
  }

  gpu::ReadingSamples samples_;
  std::map<ReadingStructure*, std::uint64_t> exact_lights_;
  std::map<assign::LookedUp, ReadingStructure*> looking_up_;  // of each way to look up one structure
  std::vector<gpu::ReadingTask> tasks_;
  std::vector<std::vector<RoundTimes*>> times_of_;
  std::vector<Check> checks_;
  std::vector<SetMeter*> meters_;
  std::uint64_t lost_ = 0;  // samples whose cell the device finds farther off than rounding explains
};

// One case over the frames.
struct CaseReading {
  bool is_read = false, is_compared = false;  // compared: with exact lists
  double bytes = 0.0, exact_bytes = 0.0;      // sums over the frames
  std::vector<SetMeter> sets = {};            // of the configuration

  void add(const FrameStructure& structure) {
    if (!structure.on_device) return;
    is_read = true;
    bytes += static_cast<double>(structure.on_device->bytes());
    if (structure.exact == nullptr) return;
    is_compared = true;
    exact_bytes += static_cast<double>(structure.exact->bytes());
  }
};

class Totals {
 public:
  Totals(std::uint64_t seed, int frames) : seed_(seed), frames_(frames) {}

  SetReading of(const config::SampleSetRequest& request, const std::vector<Walking>& walks,
                const SetMeter& meter) const {
    SetReading out;
    out.set = request.set;
    out.work = meter.work;
    if (meter.work.lights > 0) out.work.divergence = meter.waiting_lights / static_cast<double>(meter.work.lights);
    if (!meter.exact.empty()) out.exact_lights = meter.exact_lights;
    out.differing = meter.differing;
    out.write_ns = per_frame(meter.write.warm_ns);
    out.nothing_ns = per_frame(meter.nothing.warm_ns);
    for (const Walking walking : walks)
      if (const auto own = meter.own.find(walking); own != meter.own.end())
        out.walks.push_back(of(walking, own->second, meter));
    return out;
  }

 private:
  WalkReading of(Walking walking, const RoundTimes& own, const SetMeter& meter) const {
    WalkReading out;
    out.walking = walking;
    out.read_ns = per_frame(own.warm_ns);
    out.cold_ns = per_frame(own.cold_ns);
    out.nothing_ratio = measure::paired_ratio(own.warm_ns, meter.nothing.warm_ns, seed_);
    if (const auto exact = meter.exact.find(walking); exact != meter.exact.end()) {
      out.exact_ns = per_frame(exact->second.warm_ns);
      out.exact_ratio = measure::paired_ratio(own.warm_ns, exact->second.warm_ns, seed_);
    }
    return out;
  }

  measure::TimeStats per_frame(std::vector<double> sums_ns) const {
    for (double& ns : sums_ns) ns /= frames_;
    return measure::time_stats(sums_ns, seed_);
  }

  std::uint64_t seed_;
  int frames_;
};

// The readings of all cases of a group in the frames.
std::optional<std::vector<CaseReading>> read_cases(const config::Config& config, const SceneData& data,
                                                   const GroupPlan& group, const PathFrames& path,
                                                   const std::vector<int>& frames, const std::atomic<bool>& stop) {
  const GroupCulls culls(config, group, path);
  std::vector<CaseReading> cases(group.cases.size());
  for (CaseReading& one : cases) one.sets.resize(config.reading_sets.size());
  FrameSamples samples(config, config.reading_sets, data, path);
  GridOfFrames grids(config.grids[group.grid]);
  for (const int index : frames) {
    const view::Frame frame = path.frame(index);
    grids.update(path, frame);
    FrameStructures structures(config, group, path, culls, frame, grids.grid());
    const std::vector<FrameSampleSet> sets = samples.of(frame);
    for (std::size_t set = 0; set < sets.size(); ++set) {
      if (stop) return {};
      if (sets[set].samples.empty()) continue;
      SetReader reader(sets[set], grids.grid());
      for (std::size_t i = 0; i < cases.size(); ++i)
        if (structures.cases()[i].on_device)
          reader.add(structures.cases()[i], config.reading->walks, cases[i].sets[set]);
      reader.check(stop);
      reader.read(config.reading->rounds, stop);
      if (stop) return {};
    }
    for (std::size_t i = 0; i < cases.size(); ++i) cases[i].add(structures.cases()[i]);
  }
  return cases;
}

ReadCase result_of(const config::Config& config, const CasePlan& case_plan, const CaseReading& read, int frames) {
  if (!read.is_read) return {{}, "shaders do not read such a structure"};
  const gpu::DeviceFacts& facts = gpu::device().facts();
  const Totals totals(config.seed, frames);
  ReadingResult result{facts.name + ", " + facts.driver, facts.is_software(), frames, read.bytes / frames};
  result.set = config.reading->sets.front();
  result.walking = config.reading->walks.front();
  if (read.is_compared)
    result.exact = {case_plan.storage ? storage_label(config, case_plan) : "packed", read.exact_bytes / frames};
  for (std::size_t set = 0; set < config.reading_sets.size(); ++set)
    if (!read.sets[set].write.warm_ns.empty())
      result.sets.push_back(totals.of(config.reading_sets[set], config.reading->walks, read.sets[set]));
  if (result.sets.empty()) return {{}, "no set of reading.sets has a sample in the frames that are read"};
  if (std::ranges::all_of(result.sets, [](const SetReading& set) { return set.walks.empty(); }))
    return {{}, "its samples look up no cell, so they cannot walk cell by cell (reading.walks)"};
  return {std::move(result), ""};
}

std::vector<ReadCase> read_group(const config::Config& config, const SceneData& data, const GroupPlan& group,
                                 const PathFrames& path, const std::atomic<bool>& stop) {
  const std::vector<int> frames = evenly_spaced(config.reading->frames, path.count());
  const std::optional<std::vector<CaseReading>> cases = read_cases(config, data, group, path, frames, stop);
  std::vector<ReadCase> out;
  for (std::size_t i = 0; cases && i < cases->size(); ++i)
    out.push_back(result_of(config, group.cases[i], (*cases)[i], static_cast<int>(frames.size())));
  return out;
}

// What fails, as a reason; none if it was read, or stopped.
std::string failure_of(const std::function<void()>& read) {
  try {
    read();
  } catch (const gpu::DeviceError& error) {
    gpu::close_device();
    return error.message();
  } catch (const Error& error) {
    if (error.code() == ExitCode::internal) throw;
    return error.message();
  }
  return "";
}

}  // namespace

std::vector<ReadCase> reading_pass(const config::Config& config, const SceneData& data, const GroupPlan& group,
                                   const PathFrames& path, const std::atomic<bool>& stop) {
  std::vector<ReadCase> out(group.cases.size());
  const auto skip_all = [&](const std::string& reason) {
    for (ReadCase& one : out) one.obstacle = reason;
    return out;
  };
  if (const std::string obstacle = gpu::reading_obstacle(); !obstacle.empty()) return skip_all(obstacle);
  const std::string failure = failure_of([&] { out = read_group(config, data, group, path, stop); });
  if (failure.empty()) return out;
  if (stop) return {};  // it may have failed for that
  if (group.cases.size() == 1) return skip_all(failure);
  out.clear();
  for (const CasePlan& case_plan : group.cases) {
    GroupPlan alone = group;
    alone.cases = {case_plan};
    std::vector<ReadCase> read = reading_pass(config, data, alone, path, stop);
    if (read.empty()) return {};
    out.push_back(std::move(read.front()));
  }
  return out;
}

}  // namespace clusterbench::run
