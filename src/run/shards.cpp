#include "run/shards.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "run/cases/frame_work.h"
#include "run/cases/path_frames.h"
#include "run/runner.h"

namespace clusterbench::run {
namespace {

// Rough times of one thread, of which only the proportions count: those of a machine would divide a run in another way
// on each.
constexpr double k_ns_per_light = 300.0;       // of a frame, for each method and for the truth
constexpr double k_ns_per_true_pair = 60.0;    // decided
constexpr double k_ns_per_listed_pair = 10.0;  // listed, compared and stored
constexpr double k_ns_per_tested_pair = 3.0;   // by methods that test every light against every cell
constexpr double k_ns_per_sample = 60.0;       // for each light that it loops over, and for its lookup
constexpr double k_ns_per_cold_frame = 8e6;    // with the sweep of the caches
constexpr double k_rounds_by_time = 1.5;       // duration of a round / its least time

struct FrameCounts {
  double lights = 0.0, cells = 0.0, pairs = 0.0, reaching = 0.0;  // `reaching`: lights at a point
};

// Lights that reach a point, computed once for a view.
class LightsReaching {
 public:
  LightsReaching(const config::Config& config, const Plan& plan) : config_(config), plan_(plan) {}

  double in(const GroupPlan& group) {
    const SceneData& data = plan_.scenes[group.scene];
    if (group.camera < data.lights_at_points.size()) return data.lights_at_points[group.camera];
    const auto [found, is_new] = known_.try_emplace({group.scene, group.camera, group.viewport});
    if (is_new) found->second = lights_at_a_point(path_of(config_, plan_, group), config_.seed);
    return found->second;
  }

 private:
  const config::Config& config_;
  const Plan& plan_;
  std::map<std::array<std::size_t, 3>, double> known_;
};

FrameCounts frame_counts(const Plan& plan, const GroupPlan& group, double reaching) {
  FrameCounts counts;
  counts.lights = static_cast<double>(plan.scenes[group.scene].scene.lights.size());
  counts.cells = static_cast<double>(group.cells);
  counts.reaching = reaching;
  counts.pairs = static_cast<double>(true_pairs_about(group.cells, reaching));
  return counts;
}

double samples_of_frame(const config::Config& config, const GroupPlan& group) {
  double samples = 0.0;
  for (const config::SampleSetRequest& request : config.sample_sets)
    samples += request.most_samples(config.viewports[group.viewport]);
  return samples;
}

double counting_work(const config::Config& config, const Plan& plan, const GroupPlan& group, double reaching) {
  const FrameCounts counts = frame_counts(plan, group, reaching);
  double frame = config.accuracy.check && compares_cells(config, group)
                     ? k_ns_per_light * counts.lights + k_ns_per_true_pair * counts.pairs
                     : 0.0;
  for (const Method& method : methods_of(group)) {
    const bool tests_all = assign::find_assigner(config.assigners[method.assigner].name)->all_pairs;
    frame += k_ns_per_light * counts.lights + k_ns_per_listed_pair * counts.pairs +
             (tests_all ? k_ns_per_tested_pair * counts.lights * counts.cells : 0.0);
  }
  frame += k_ns_per_sample * samples_of_frame(config, group) * (1.0 + counts.reaching) *
           static_cast<double>(group.cases.size());
  const double steps = config.stability ? config.stability->steps : 0;
  return frame * (static_cast<double>(plan.scenes[group.scene].paths[group.camera].shots.size()) + steps);
}

// Of the processor, then of a device: rounds of about the same time each.
double timing_work(const config::Config& config, const GroupPlan& group) {
  if (!config.timing.measure) return 0.0;
  const double round =
      k_rounds_by_time * 1e6 * config.timing.min_time_ms + (config.timing.cold ? k_ns_per_cold_frame : 0.0);
  const std::size_t methods =
      methods_of(timed_cases(config, group)).size() + methods_of(device_cases(config, group)).size();
  return round * config.timing.rounds * static_cast<double>(methods);
}

// The ends of shards that take as many groups as `most` allows, and leave a group for each shard after them.
std::vector<std::size_t> filled_shards(std::span<const std::uint64_t> work, std::uint64_t shards, std::uint64_t most) {
  std::vector<std::size_t> ends;
  std::size_t next = 0;
  for (std::uint64_t left = shards; left > 0; --left) {
    std::uint64_t sum = 0;
    for (const std::size_t begin = next; next < work.size() && sum + work[next] <= most; ++next) {
      if (next > begin && work.size() - next < left) break;
      sum += work[next];
    }
    ends.push_back(next);
  }
  return ends;
}

bool is_enough(std::span<const std::uint64_t> work, std::uint64_t shards, std::uint64_t most) {
  std::uint64_t used = 1, sum = 0;
  for (const std::uint64_t one : work) {
    if (sum + one > most) {
      ++used;
      sum = 0;
    }
    sum += one;
  }
  return used <= shards;
}

}  // namespace

std::vector<double> predicted_counting(const config::Config& config, const Plan& plan) {
  LightsReaching reaching(config, plan);
  std::vector<double> work;
  for (const GroupPlan& group : plan.groups)
    work.push_back(std::max(1.0, counting_work(config, plan, group, reaching.in(group))));
  return work;
}

std::vector<std::uint64_t> predicted_work(const config::Config& config, const Plan& plan) {
  constexpr double k_most = 1e14;  // of k_most_cases groups the sum fits into 64 bits
  std::vector<double> counting = predicted_counting(config, plan);
  std::vector<std::uint64_t> work;
  for (std::size_t i = 0; i < plan.groups.size(); ++i)
    work.push_back(static_cast<std::uint64_t>(
        std::llround(std::clamp(counting[i] + timing_work(config, plan.groups[i]), 1.0, k_most))));
  return work;
}

std::vector<std::size_t> shard_ends(std::span<const std::uint64_t> work, std::uint64_t shards) {
  std::uint64_t least = 0, most = 0;
  for (const std::uint64_t one : work) {
    least = std::max(least, one);
    most += one;
  }
  while (least < most) {
    const std::uint64_t middle = least + (most - least) / 2;
    if (is_enough(work, shards, middle))
      most = middle;
    else
      least = middle + 1;
  }
  return filled_shards(work, shards, most);
}

Plan part_of(Plan plan, std::size_t begin, std::size_t end) {
  plan.groups.erase(plan.groups.begin() + static_cast<std::ptrdiff_t>(end), plan.groups.end());
  plan.groups.erase(plan.groups.begin(), plan.groups.begin() + static_cast<std::ptrdiff_t>(begin));
  return plan;
}

}  // namespace clusterbench::run
