#include "run/estimate.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "assign/contract/method_error.h"
#include "core/error.h"
#include "core/work_in_order.h"
#include "gpu/device/device.h"
#include "gpu/reading/reading.h"
#include "os/call_notes.h"
#include "run/cases/frame_depths.h"
#include "run/cases/frame_samples.h"
#include "run/passes/accuracy_pass.h"
#include "run/passes/device_pass.h"
#include "run/shards.h"
#include "run/timing/cache_sweep.h"
#include "run/timing/repeated.h"
#include "run/timing/timed_work.h"

namespace clusterbench::run {
namespace {

template <class Once>
double duration_ns(const Once& once) {
  const double start = wall_ns();
  once();
  return wall_ns() - start;
}

// What a group takes on this machine. Depths are cast once for all groups of a path.
struct SampledCost {
  GroupCost cost;  // without depths that are cast here
  double casting_ns = 0.0;
};

// The time that some frames' depths take, from the last one's; `path`: with one frame or two, whose depths are cast
// then. 0 if they were before.
double casting_ns(const config::Config& config, const SceneData& data, const GroupPlan& group, const PathFrames& path) {
  std::vector<config::SampleSetRequest> of_surfaces = config.sample_sets;
  std::erase_if(of_surfaces, [](const auto& request) { return request.set == measure::SampleSet::volume; });
  const FrameSamples samples(config, of_surfaces, data, path);
  const auto prepare = [&](int frame) {
    depths_for(config, group, path, path.frame(frame));
    samples.of(path.frame(frame));
  };
  for (int frame = 0; frame + 1 < path.count(); ++frame) prepare(frame);
  const double cold = duration_ns([&] { prepare(path.count() - 1); });
  return std::max(0.0, cold - duration_ns([&] { prepare(path.count() - 1); }));
}

// Truth, lists, samples and buffers of so many frames, estimated from two of them: memory grows in the first, and what
// the others share is made there.
double counting_ns(const config::Config& config, const SceneData& data, const GroupPlan& group, const PathFrames& some,
                   int frames) {
  const std::atomic<bool> stop{false};
  double first = 0.0, last = 0.0;  // when they began
  const auto on_frame = [&](int) {
    last = wall_ns();
    if (first == 0.0) first = last;
  };
  accuracy_pass(config, data, group, some, on_frame, stop);
  return last - first + (wall_ns() - last) * (frames - some.count() + 1);
}

// For an even number of values, the lower one of the two in the middle; 0 without values.
double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// The time of measure_launch() for all methods and launches, from the time of one frame.
double timing_ns(const config::Config& config, const GroupPlan& group, const PathFrames& path, double sweep_ns,
                 const EstimateLimits& limits) {
  const auto frames = static_cast<double>(mean_frames(config, path).size());
  const std::vector<TimedFrame> middle_frame = timed_frames(config, group, path, {path.count() / 2});
  const double min_ns = 1e6 * config.timing.min_time_ms, launches = config.timing.launches;
  const int rounds = rounds_per_launch(config.timing, config.timing.launches);
  const int warm_rounds = config.timing.cold ? std::min(rounds, limits.warm_rounds) : rounds;
  const std::uint64_t bytes = sweep_bytes(config.timing.sweep_mib);
  const int cold = config.timing.cold ? cold_rounds(rounds, static_cast<std::size_t>(frames) + 1, bytes) : 0;
  double all = 0.0;
  for (const Method& method : methods_of(group)) {
    TimedWork work(config, group, method, middle_frame);
    const double build = duration_ns([&] { work.build(); }), assign = duration_ns([&] { work.assign(); });
    double start = build + (frames + 1.0) * assign, warm = build + frames * assign + std::max(min_ns, frames * assign);
    double converts = 0.0, cold_frames = 1.0;
    for (std::size_t store = 0; work.converts() && store < work.case_indices().size(); ++store) {
      const double convert = duration_ns([&] { work.convert(store); });
      warm += 2.0 * std::max(min_ns / 10.0, frames * convert);
      converts += convert;
      cold_frames = static_cast<double>(store) + 1.0;  // each storage has a frame of its own
    }
    warm += min_ns / 10.0;  // the copy of the lists
    if (!config.timing.cold) warm += std::max(min_ns / 10.0, frames * (assign + converts));
    constexpr double k_cold_by_warm = 2.0;
    const double swept =
        (frames + 1.0) * (cold_frames * (sweep_ns + k_cold_by_warm * assign) + k_cold_by_warm * converts);
    all += launches * (start + warm_rounds * warm + cold * swept);
  }
  return all;
}

double sweep_duration_ns(const config::TimingRequest& timing) {
  const std::uint64_t bytes = sweep_bytes(timing.sweep_mib);
  sweep_caches(bytes);  // the first call gets the memory
  return duration_ns([&] { sweep_caches(bytes); });
}

// The time of device_pass() for all methods, launches and rounds, from one frame of it.
double device_ns(config::Config config, const GroupPlan& on_device, const PathFrames& path) {
  const auto frames = static_cast<double>(mean_frames(config, path).size());
  const double launches = config.timing.launches, rounds = rounds_per_launch(config.timing, config.timing.launches);
  const std::atomic<bool> stop{false};
  config.timing.frames = 1;
  config.timing.rounds = 2;
  double round = 0.0, last = 0.0;  // the second round, and when one ended
  const auto on_round = [&] {
    const double now = wall_ns();
    round = now - last;
    last = now;
  };
  const auto pass_ns = [&] { return duration_ns([&] { device_pass(config, on_device, path, 1, on_round, stop); }); };
  pass_ns();
  gpu::close_device();
  const double opening = pass_ns(), again = pass_ns();  // in each launch shaders are compiled
  const double preparation = std::max(0.0, again - 2.0 * round);
  return launches * (std::max(0.0, opening - again) + frames * (preparation + rounds * round));
}

// The time of reading_pass(), roughly: on the host, which counts each walk, and on the device.
double reading_ns(const config::Config& config, const GroupPlan& group, const PathFrames& path) {
  constexpr double k_host_ns = 300.0, k_software_ns = 20.0, k_gpu_ns = 0.1;  // of a sample
  if (config.reading_sets.empty() || !gpu::reading_obstacle().empty()) return 0.0;
  double samples = 0.0;
  for (const config::SampleSetRequest& request : config.reading_sets) samples += request.most_samples(path.viewport());
  const auto walks = static_cast<double>(config.reading->walks.size() * group.cases.size());
  const double device_ns = gpu::device().facts().is_software() ? k_software_ns : k_gpu_ns;
  constexpr double k_cold_and_warm_with_exact = 4.0;
  return std::min(config.reading->frames, path.count()) * samples * walks *
         (k_host_ns + k_cold_and_warm_with_exact * config.reading->rounds * device_ns);
}

// `config`: with one thread; `threads`: that the run has.
SampledCost cost_of_group(const config::Config& config, int threads, const Plan& plan, const GroupPlan& group,
                          double sweep_ns, const EstimateLimits& limits) {
  if (runs_elsewhere(config, group)) {
    os::note_group(group.cases.front().id);
    os::note_pass("estimate of the duration");
  }
  const PathFrames path = path_of(config, plan, group);
  const int steps = config.stability ? config.stability->steps : 0;
  const int frames = limits.counts_one_frame ? 1 : path.count() + steps;
  const PathFrames some =
      path.only(frames == 1 ? std::vector{path.count() / 2} : std::vector{path.count() / 3, 2 * path.count() / 3});
  const SceneData& data = plan.scenes[group.scene];
  SampledCost sampled;
  sampled.casting_ns = casting_ns(config, data, group, some) * frames / threads;
  GroupCost& cost = sampled.cost;
  cost.counting_ns = counting_ns(config, data, group, some, frames) / threads;
  const GroupPlan timed = timed_cases(config, group);
  if (config.timing.measure && !timed.cases.empty()) cost.timing_ns = timing_ns(config, timed, path, sweep_ns, limits);
  const GroupPlan on_device = device_cases(config, group);
  if (config.timing.measure && !on_device.cases.empty()) cost.device_ns = device_ns(config, on_device, path);
  cost.reading_ns = reading_ns(config, group, path);
  return sampled;
}

// If a device fails at it, that of the cases without one; if these fail, too, or anything else does, none: the run
// itself says what has failed, in the order of its cases.
std::optional<SampledCost> cost_of_what_runs(const config::Config& config, int threads, const Plan& plan,
                                             const GroupPlan& group, double sweep_ns, const EstimateLimits& limits) {
  for (GroupPlan left = group; !left.cases.empty();) {
    try {
      return cost_of_group(config, threads, plan, left, sweep_ns, limits);
    } catch (const gpu::DeviceError&) {
      gpu::close_device();
      GroupPlan others = processor_cases(config, left);
      if (others.cases.size() == left.cases.size()) break;
      left = std::move(others);
    } catch (const assign::MethodError&) {
      break;
    } catch (const Error&) {
      break;
    }
  }
  return std::nullopt;
}

// Groups whose costs are sampled at the same time: one, where something is timed.
std::size_t sampled_at_once(const config::Config& config, const Plan& plan) {
  const bool is_alone = config.timing.measure || std::ranges::any_of(plan.groups, [&](const GroupPlan& group) {
                          return runs_elsewhere(config, group);
                        });
  return is_alone ? 1 : static_cast<std::size_t>(config.threads);
}

// What sampled groups say of the others: counting follows the predicted work, timing the methods.
class SampledMeans {
 public:
  SampledMeans(const config::Config& config, const Plan& plan, const EstimateLimits& limits)
      : work_(predicted_counting(config, plan)) {
    const double steps = config.stability ? config.stability->steps : 0;
    for (std::size_t i = 0; i < work_.size(); ++i) {
      const GroupPlan& group = plan.groups[i];
      const auto frames = static_cast<double>(plan.scenes[group.scene].paths[group.camera].shots.size());
      if (limits.counts_one_frame) work_[i] /= frames + steps;
      timed_methods_.push_back(static_cast<double>(methods_of(timed_cases(config, group)).size()));
    }
  }

  void add(std::size_t group, const GroupCost& cost) {
    counted_ns_ += cost.counting_ns;
    counted_work_ += work_[group];
    if (timed_methods_[group] > 0.0) timing_of_method_.push_back(cost.timing_ns / timed_methods_[group]);
    on_device_.push_back(cost.device_ns);
    reading_.push_back(cost.reading_ns);
  }

  GroupCost cost_of(std::size_t group) const {
    return {counting_ns(work_[group]), median(timing_of_method_) * timed_methods_[group], median(on_device_),
            median(reading_)};
  }
  double all_counting_ns() const { return counting_ns(std::accumulate(work_.begin(), work_.end(), 0.0)); }
  double all_timing_ns() const {
    return median(timing_of_method_) * std::accumulate(timed_methods_.begin(), timed_methods_.end(), 0.0);
  }

 private:
  double counting_ns(double work) const { return counted_work_ > 0.0 ? counted_ns_ * work / counted_work_ : 0.0; }

  std::vector<double> work_, timed_methods_;  // by group
  double counted_ns_ = 0.0, counted_work_ = 0.0;
  std::vector<double> timing_of_method_, on_device_, reading_;  // of the sampled groups
};

// Whether sampling has taken long enough, also in comparison with the counting and the timing that it is about.
bool is_enough(double passed_ns, const EstimateLimits& limits, double counting_ns, double timing_ns) {
  constexpr double k_share = 0.1, k_share_of_timing = 0.03;
  return passed_ns > k_share * limits.times_counted * counting_ns + k_share_of_timing * timing_ns ||
         passed_ns >= 1e9 * limits.most_s;
}

}  // namespace

std::vector<GroupCost> estimated_costs(const config::Config& config, const Plan& plan, const EstimateLimits& limits) {
  const double sweep_ns = config.timing.measure && config.timing.cold ? sweep_duration_ns(config.timing) : 0.0;
  // Samples groups across all scenes and grids: each step advances by about the golden section of the list.
  const std::size_t groups = plan.groups.size();
  std::size_t stride = std::max<std::size_t>(1, groups * 618 / 1000), sampled = 0;
  while (std::gcd(stride, groups) != 1) ++stride;
  std::vector<std::optional<SampledCost>> costs(groups);
  SampledMeans means(config, plan, limits);
  const std::size_t at_once = sampled_at_once(config, plan);
  ThreadPool pool(static_cast<int>(at_once));
  config::Config on_one_thread = config;
  on_one_thread.threads = 1;
  const int threads = std::min(config.threads, processors());
  for (const double start = wall_ns();
       sampled < groups &&
       (sampled == 0 || !is_enough(wall_ns() - start, limits, means.all_counting_ns(), means.all_timing_ns()));) {
    const std::size_t first = sampled;
    sampled = std::min(groups, first + at_once);
    each_in_order(pool, sampled - first, [&](std::size_t i) {
      const std::size_t index = (first + i) * stride % groups;
      costs[index] = cost_of_what_runs(on_one_thread, threads, plan, plan.groups[index], sweep_ns, limits);
    });
    for (std::size_t i = first; i < sampled; ++i)
      if (const std::size_t index = i * stride % groups; costs[index]) means.add(index, costs[index]->cost);
  }
  std::vector<GroupCost> all;
  for (std::size_t i = 0; i < groups; ++i) {
    all.push_back(costs[i] ? costs[i]->cost : means.cost_of(i));
    if (costs[i]) all.back().counting_ns += costs[i]->casting_ns;
  }
  return all;
}

double sum_s(std::span<const GroupCost> costs) {
  double ns = 0.0;
  for (const GroupCost& cost : costs) ns += cost.counting_ns + cost.timing_ns + cost.device_ns + cost.reading_ns;
  return 1e-9 * ns;
}

double sum_of_timing_s(std::span<const GroupCost> costs) {
  double ns = 0.0;
  for (const GroupCost& cost : costs) ns += cost.timing_ns + cost.device_ns + cost.reading_ns;
  return 1e-9 * ns;
}

double estimated_s(const config::Config& config, const Plan& plan) {
  return sum_s(estimated_costs(config, plan));
}

}  // namespace clusterbench::run
