#include "run/passes/device_pass.h"

#include <algorithm>
#include <memory>

#include "gpu/device/device.h"
#include "gpu/device/span_length.h"
#include "gpu/methods/clock_probe.h"
#include "run/passes/timing_pass.h"
#include "run/timing/timed_work.h"

namespace clusterbench::run {
namespace {

using assign::DeviceRepeats;
using Caches = DeviceRepeats::Caches;

// Methods of tests run without any.
bool has_device() {
  return gpu::device_obstacle().empty();
}

std::string name_of_device() {
  if (!has_device()) return "";
  const gpu::DeviceFacts& facts = gpu::device().facts();
  return facts.name + ", " + facts.driver;
}

// The samples of one method with the same caches: one of each round, per frame.
struct SpanSamples {
  std::vector<double> run_ns, upload_ns, readback_ns, floor_ns, build_ns;
  DeviceRepeats repeats;  // in the frame with fewest

  void add(const assign::DeviceSpans& sum, double floor_sum_ns, double frames) {
    run_ns.push_back(sum.run_ns / frames);
    upload_ns.push_back(sum.upload_ns / frames);
    readback_ns.push_back(sum.readback_ns / frames);
    floor_ns.push_back(floor_sum_ns / frames);
  }
};

// Of all launches.
struct MethodDeviceSamples {
  SpanSamples cold, warm;
  std::vector<double> clock_mhz;
  double dispatches = 0.0, builds_per_frame = 0.0;
  std::size_t frames = 0;
  std::vector<assign::ShaderStatistic> shaders;
};

// How often a frame's work is repeated, by what it takes alone.
struct FrameRepeats {
  DeviceRepeats cold, warm;
};

std::uint32_t warm_repeats(double once_ns, double period_ns) {
  constexpr double k_parts = 3.0;  // of a submission: upload, run, and once more
  return gpu::repeats_for(once_ns, period_ns, gpu::k_longest_submit_ns / k_parts);
}

void take_fewer(DeviceRepeats& of, const DeviceRepeats& other, bool is_first) {
  const DeviceRepeats before = is_first ? other : of;
  of = {other.caches, std::min(before.upload, other.upload), std::min(before.run, other.run),
        std::min(before.floor, other.floor), std::min(before.build, other.build)};
}

// One method in one launch.
class DeviceTrack {
 public:
  DeviceTrack(const config::Config& config, const GroupPlan& group, const Method& method,
              std::span<const TimedFrame> frames, MethodDeviceSamples& samples)
      : is_cold_(config.timing.cold), work_(config, group, method, frames), samples_(samples) {
    const bool is_first = samples.frames == 0;
    samples.frames = work_.frame_count();
    samples.builds_per_frame = static_cast<double>(work_.builds()) / static_cast<double>(work_.frame_count());
    samples.shaders = work_.shader_statistics();
    for (std::size_t frame = 0; frame < work_.frame_count(); ++frame) {
      repeats_.push_back(repeats_of(frame));
      take_fewer(samples.cold.repeats, repeats_.back().cold, is_first && frame == 0);
      take_fewer(samples.warm.repeats, repeats_.back().warm, is_first && frame == 0);
    }
  }

  void round(gpu::ClockProbe* clock) {
    if (is_cold_) pass(samples_.cold, &FrameRepeats::cold);
    pass(samples_.warm, &FrameRepeats::warm);
    if (clock == nullptr) return;
    if (const std::optional<double> mhz = clock->mhz()) samples_.clock_mhz.push_back(*mhz);
  }

 private:
  FrameRepeats repeats_of(std::size_t frame) const {
    FrameRepeats out{{.caches = Caches::cold}, {.caches = Caches::warm}};
    work_.repeat_on_device(out.warm);
    work_.assign_frame(frame);
    const assign::DeviceSpans once = work_.device_spans();
    if (once.dispatches == 0 || !has_device()) return out;
    const double floor_ns = work_.device_floor_ns(), build_ns = work_.device_build_ns().value_or(0.0);
    const double period_ns = gpu::device().facts().timestamp_period_ns;
    out.warm.upload = warm_repeats(once.upload_ns, period_ns);
    out.warm.run = warm_repeats(once.run_ns, period_ns);
    out.warm.floor = warm_repeats(floor_ns, period_ns);
    out.warm.build = warm_repeats(build_ns, period_ns);
    if (!is_cold_) return out;
    const std::uint64_t flushed = gpu::device().reserve_flushed();
    const auto cold = [&](double once_ns) { return gpu::cold_repeats_for(once_ns, period_ns, flushed); };
    out.cold.run = out.cold.upload = cold(once.upload_ns + once.run_ns);
    out.cold.floor = cold(floor_ns);
    out.cold.build = cold(build_ns);
    return out;
  }

  void pass(SpanSamples& out, DeviceRepeats FrameRepeats::*with) {
    assign::DeviceSpans spans;
    double floor_ns = 0.0;
    for (std::size_t frame = 0; frame < work_.frame_count(); ++frame) {
      work_.repeat_on_device(repeats_[frame].*with);
      work_.assign_frame(frame);
      spans += work_.device_spans();
      floor_ns += work_.device_floor_ns();
    }
    const auto frames = static_cast<double>(work_.frame_count());
    out.add(spans, floor_ns, frames);
    samples_.dispatches = spans.dispatches / frames;
    if (const std::optional<double> build_ns = work_.device_build_ns()) out.build_ns.push_back(*build_ns);
  }

  bool is_cold_;
  mutable TimedWork work_;
  MethodDeviceSamples& samples_;
  std::vector<FrameRepeats> repeats_;
};

// None if the device has no clock.
class DeviceStatistics {
 public:
  DeviceStatistics(int launches, std::uint64_t seed) : launches_(launches), seed_(seed) {}

  std::optional<DeviceTimes> of(const MethodDeviceSamples& method) const {
    if (std::ranges::all_of(method.warm.run_ns, [](double ns) { return ns == 0.0; })) return {};
    DeviceTimes out;
    out.device = name_of_device();
    out.is_software = has_device() && gpu::device().facts().is_software();
    out.frames_timed = static_cast<int>(method.frames);
    out.launches = launches_;
    out.dispatches = method.dispatches;
    if (!method.cold.run_ns.empty()) out.cold = of(method.cold);
    out.warm = of(method.warm);
    const std::vector<double>& build_ns = (out.cold ? method.cold : method.warm).build_ns;
    if (!build_ns.empty()) out.build_ns = stats(build_ns);
    out.builds_per_frame = method.builds_per_frame;
    out.clock_mhz = method.clock_mhz;
    out.shaders = method.shaders;
    return out;
  }

 private:
  measure::TimeStats stats(const std::vector<double>& samples) const {
    return measure::time_stats(samples, seed_, launches_);
  }
  DeviceSpanTimes of(const SpanSamples& samples) const {
    return {stats(samples.run_ns),
            stats(samples.upload_ns),
            stats(samples.readback_ns),
            stats(samples.floor_ns),
            measure::paired_ratio(samples.run_ns, samples.floor_ns, seed_, launches_).ratio,
            samples.repeats};
  }

  int launches_;
  std::uint64_t seed_;
};

// False if stopped.
bool run_launch(const config::Config& config, const GroupPlan& group, std::span<const TimedFrame> frames, int launch,
                int rounds, std::vector<MethodDeviceSamples>& samples, const std::function<void()>& on_round,
                const std::atomic<bool>& stop) {
  const std::vector<Method> methods = methods_of(group);
  std::vector<std::unique_ptr<DeviceTrack>> tracks;
  for (std::size_t i = 0; i < methods.size(); ++i)
    tracks.push_back(std::make_unique<DeviceTrack>(config, group, methods[i], frames, samples[i]));
  std::optional<gpu::ClockProbe> clock;  // a processor's cycles are counted at a fixed rate
  if (has_device() && !gpu::device().facts().is_software()) clock.emplace(gpu::device());
  for (int round = 0; round < rounds; ++round) {
    for (const std::size_t track : method_order(tracks.size(), config.seed, launch, round)) {
      if (stop) return false;
      tracks[track]->round(clock ? &*clock : nullptr);
    }
    on_round();
  }
  return true;
}

}  // namespace

std::vector<std::optional<DeviceTimes>> device_pass(const config::Config& config, const GroupPlan& group,
                                                    const PathFrames& path, int launches,
                                                    const std::function<void()>& on_round,
                                                    const std::atomic<bool>& stop) {
  const std::vector<TimedFrame> frames = timed_frames(config, group, path, mean_frames(config, path));
  const std::vector<Method> methods = methods_of(group);
  std::vector<MethodDeviceSamples> samples(methods.size());
  for (int launch = 0; launch < launches; ++launch) {
    if (launch > 0) gpu::close_device();
    if (!run_launch(config, group, frames, launch, rounds_per_launch(config.timing, launches), samples, on_round, stop))
      return {};
  }
  const DeviceStatistics statistics(launches, config.seed);
  std::vector<std::optional<DeviceTimes>> times;
  for (const CasePlan& case_plan : group.cases)
    times.push_back(statistics.of(
        samples[static_cast<std::size_t>(std::ranges::find(methods, case_plan.method()) - methods.begin())]));
  return times;
}

}  // namespace clusterbench::run
