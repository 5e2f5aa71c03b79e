#include "run/progress_costs.h"

#include <algorithm>

namespace clusterbench::run {

double list_cost(const config::Config& config, const GroupPlan& group, std::size_t lights, int frames, double samples) {
  constexpr double k_ns_per_light = 2000.0, k_ns_per_brute_pair = 3.0, k_cells = 8000.0, k_ns_per_sample = 1000.0;
  double per_frame = static_cast<double>(lights) * k_ns_per_light + k_ns_per_sample * samples;
  for (const Method& method : methods_of(group))
    per_frame += assign::find_assigner(config.assigners[method.assigner].name)->all_pairs
                     ? static_cast<double>(lights) * k_cells * k_ns_per_brute_pair
                     : 1e5;
  return per_frame * frames;
}

double timing_cost(const config::Config& config, const GroupPlan& group) {
  if (!config.timing.measure) return 0.0;
  constexpr double k_ns_per_cold_frame = 2e6;
  const double warm = 1.5e6 * config.timing.min_time_ms, cold = config.timing.cold ? 4.0 * k_ns_per_cold_frame : 0.0;
  return (warm + cold) * config.timing.rounds * static_cast<double>(methods_of(group).size());
}

double device_cost(const config::Config& config, const GroupPlan& on_device, double frames) {
  constexpr double k_ns_per_frame = 2e6;
  const double timed = config.timing.frames == 0 ? frames : std::min(frames, static_cast<double>(config.timing.frames));
  return k_ns_per_frame * timed * config.timing.rounds * static_cast<double>(methods_of(on_device).size());
}

double reading_cost(const config::Config& config, const GroupPlan& group) {
  constexpr double k_ns_per_reading = 2e6;
  return k_ns_per_reading * config.reading->frames * config.reading->rounds *
         static_cast<double>(config.reading_sets.size() * config.reading->walks.size() * group.cases.size());
}

}  // namespace clusterbench::run
