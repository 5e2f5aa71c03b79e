#include "run/passes/device_pass.h"

#include <algorithm>
#include <memory>

#include "gpu/device/device.h"
#include "run/passes/timing_pass.h"
#include "run/timing/timed_work.h"

namespace clusterbench::run {
namespace {

// Methods of tests run without any.
std::string name_of_device() {
  if (!gpu::device_obstacle().empty()) return "";
  const gpu::DeviceFacts& facts = gpu::device().facts();
  return facts.name + ", " + facts.driver;
}

// One method with its samples: one of each round, per frame.
class DeviceTrack {
 public:
  DeviceTrack(const config::Config& config, const GroupPlan& group, const Method& method,
              std::span<const TimedFrame> frames)
      : device_(name_of_device()), method_(method), work_(config, group, method, frames) {}

  void round() {
    assign::DeviceSpans spans;
    double floor_ns = 0.0;
    for (std::size_t frame = 0; frame < work_.frame_count(); ++frame) {
      work_.assign_frame(frame);
      spans += work_.device_spans();
      floor_ns += work_.device_floor_ns();
    }
    const auto frames = static_cast<double>(work_.frame_count());
    run_ns_.push_back(spans.run_ns / frames);
    upload_ns_.push_back(spans.upload_ns / frames);
    readback_ns_.push_back(spans.readback_ns / frames);
    dispatches_ = spans.dispatches / frames;
    floor_ns_.push_back(floor_ns / frames);
  }

  const Method& method() const { return method_; }
  // None if the device has no clock.
  std::optional<DeviceTimes> times(std::uint64_t seed) const {
    if (std::ranges::all_of(run_ns_, [](double ns) { return ns == 0.0; })) return {};
    const auto stats = [&](const std::vector<double>& samples) { return measure::time_stats(samples, seed, 1); };
    return DeviceTimes{device_,
                       static_cast<int>(work_.frame_count()),
                       stats(run_ns_),
                       stats(upload_ns_),
                       stats(readback_ns_),
                       dispatches_,
                       stats(floor_ns_),
                       measure::paired_ratio(run_ns_, floor_ns_, seed, 1).ratio};
  }

 private:
  std::string device_;
  Method method_;
  TimedWork work_;
  std::vector<double> run_ns_, upload_ns_, readback_ns_, floor_ns_;
  double dispatches_ = 0.0;
};

}  // namespace

std::vector<std::optional<DeviceTimes>> device_pass(const config::Config& config, const GroupPlan& group,
                                                    const PathFrames& path, const std::function<void()>& on_round,
                                                    const std::atomic<bool>& stop) {
  const std::vector<TimedFrame> frames = timed_frames(config, group, path, mean_frames(config, path));
  std::vector<std::unique_ptr<DeviceTrack>> tracks;
  for (const Method& method : methods_of(group))
    tracks.push_back(std::make_unique<DeviceTrack>(config, group, method, frames));
  for (int round = 0; round < config.timing.rounds; ++round) {
    for (const std::size_t track : method_order(tracks.size(), config.seed, 0, round)) {
      if (stop) return {};
      tracks[track]->round();
    }
    on_round();
  }
  std::vector<std::optional<DeviceTimes>> times;
  for (const CasePlan& case_plan : group.cases)
    for (const auto& track : tracks)
      if (track->method() == case_plan.method()) times.push_back(track->times(config.seed));
  return times;
}

}  // namespace clusterbench::run
