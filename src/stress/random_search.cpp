#include "stress/random_search.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <set>
#include <tuple>

#include "core/work_in_order.h"
#include "gpu/device/device.h"
#include "os/call_notes.h"
#include "stress/random_setting.h"
#include "stress/stress_run.h"

namespace clusterbench::stress {
namespace {

constexpr std::size_t k_most_seeds = 16;

// Faults of one kind, method, grid and type of light count as one fault, even if many settings show it.
std::tuple<FaultKind, std::string, grid::Kind, bool, scene::LightType> class_of(const RandomFault& fault) {
  return {fault.fault.kind, fault.fault.method, fault.grid, fault.orthographic, fault.fault.type};
}

void collect(const SettingReport& report, std::uint64_t seed, const Trial& trial, RandomSearch& search) {
  search.counts.add(report.counts);
  for (const SettingFault& fault : report.faults) {
    RandomFault found{fault, trial.grid.kind, trial.scene.cameras[0].projection.orthographic, 0, {}, trial};
    auto same = std::find_if(search.faults.begin(), search.faults.end(),
                             [&](const RandomFault& other) { return class_of(other) == class_of(found); });
    if (same == search.faults.end()) same = search.faults.insert(same, found);
    ++same->settings;
    if (same->seeds.size() < k_most_seeds) same->seeds.push_back(seed);
  }
}

void shrink(RandomFault& found, std::span<const StressMethod> methods) {
  if (found.fault.is_of_device) return;
  found.scene = shrunk(found.scene, found.fault, methods);
  for (const SettingFault& fault : check_setting(found.scene, methods).faults)
    if (fault.kind == found.fault.kind && fault.method == found.fault.method && fault.type == found.fault.type)
      found.fault = fault;
}

}  // namespace

const char* type_name(scene::LightType type) {
  return type == scene::LightType::box ? "box" : type == scene::LightType::spot ? "spot" : "point";
}

std::string RandomFault::name() const {
  std::string text = std::string(fault_kind_name(fault.kind)) + "-";
  for (const char c : fault.method.empty() ? "" : fault.method + "-")
    if (c != ')') text += c == '(' || c == ',' || c == ' ' ? '-' : c;
  text += grid::kind_name(grid);
  text += orthographic ? "-orthographic" : "";
  return text + "-" + type_name(fault.type);
}

// Tells of the settings at work, each 64: after a crash it is one from that seed on.
class SettingsAtWork {
 public:
  using Tell = std::function<void(std::uint64_t settings, const std::string& doing)>;
  SettingsAtWork(std::uint64_t first, const Tell& tell) : first_(first), next_told_(first), tell_(tell) {}

  void begin(std::uint64_t seed) {
    const std::lock_guard lock(lock_);
    seeds_.insert(seed);
    const std::uint64_t least = *seeds_.begin();
    if (least < next_told_) return;
    tell_(least - first_, "settings from seed " + std::to_string(least) + " on");
    next_told_ = least + 64;
  }
  void end(std::uint64_t seed) {
    const std::lock_guard lock(lock_);
    seeds_.erase(seed);
  }

 private:
  std::mutex lock_;
  std::uint64_t first_, next_told_;
  std::set<std::uint64_t> seeds_;
  const Tell& tell_;
};

RandomSearch search_at_random(std::span<const StressMethod> methods, const StressRequest& request,
                              const std::function<void(std::uint64_t settings, const std::string& doing)>& on_progress,
                              const std::atomic<bool>& stop) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto is_over = [&](std::uint64_t settings) {
    const double passed = std::chrono::duration<double>(Clock::now() - begin).count();
    return stop || settings >= request.random || (request.seconds > 0.0 && passed >= request.seconds);
  };
  RandomSearch search;
  search.first_seed = request.seed;
  ThreadPool threads(request.threads);
  // All threads wait for the last setting of a batch. A device that fails is opened anew after its batch.
  const bool is_on_device = std::ranges::any_of(methods, [](const auto& method) { return method.assigner->on_device; });
  const std::uint64_t most = is_on_device ? 64 : 1024;
  SettingsAtWork at_work(request.seed, on_progress);
  while (!is_over(search.counts.settings)) {
    const std::uint64_t first = search.counts.settings, count = std::min(most, request.random - first);
    std::vector<Trial> trials(count);
    std::vector<std::optional<SettingReport>> reports(count);
    each_in_order(threads, count, [&](std::size_t i) {
      if (is_over(first + i)) return;
      const std::uint64_t seed = request.seed + first + i;
      at_work.begin(seed);
      if (stop) return;
      os::note_setting("--random 1 --seed " + std::to_string(seed));
      trials[i] = random_setting(seed);
      reports[i] = check_setting(trials[i], methods);
      at_work.end(seed);
    });
    const auto is_of_failed_device = [](const std::optional<SettingReport>& report) {
      return report && std::ranges::any_of(report->faults, &SettingFault::is_of_device);
    };
    const bool has_failed = std::ranges::any_of(reports, is_of_failed_device);
    if (stop)  // a signal leaves a device's work behind, which is no fault
      for (std::optional<SettingReport>& report : reports)
        if (is_of_failed_device(report)) report.reset();
    if (has_failed) gpu::close_device();  // of which nothing is left now; the next settings open it anew
    // Stops at the first unfinished one, so that the first seed and the number identify the checked seeds.
    for (std::size_t i = 0; i < count && reports[i]; ++i)
      collect(*reports[i], request.seed + first + i, trials[i], search);
  }
  on_progress(search.counts.settings, "shrinking " + std::to_string(search.faults.size()) + " faults");
  if (!stop) each_in_order(threads, search.faults.size(), [&](std::size_t i) { shrink(search.faults[i], methods); });
  return search;
}

}  // namespace clusterbench::stress
