#include "report/exports/metrics.h"

#include <algorithm>
#include <optional>

#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using enum Better;

constexpr bool k_headline = true, k_detail = false;

constexpr Metric k_metrics[] = {
    {"frame_time", "ns", "/timing/frame_ns/median", "/timing/frame_ns/ci95", smaller, k_headline},
    {"worst_frame_time", "ns", "/timing/worst_frame/ns", "/timing/worst_frame/ci95", smaller, k_headline},
    {"assign_time", "ns", "/timing/assign_ns/median", "/timing/assign_ns/ci95", smaller, k_headline},
    {"convert_time", "ns", "/timing/convert_ns/median", "/timing/convert_ns/ci95", smaller, k_headline},
    {"frame_cost", "ns", "/cost/frame_ns", "", smaller, k_headline},
    {"frame_instructions", "instructions", "/count/instructions_per_frame/frame", "", smaller, k_headline},
    {"assign_instructions", "instructions", "/count/instructions_per_frame/assign", "", smaller, k_headline},
    {"speedup", "ratio", "/timing/against_first/ratio", "/timing/against_first/ci95", bigger, k_headline, 1.0},
    {"pair_rate", "pairs/s", "/timing/ns_per_pair", "", bigger, k_headline, 1e9},
    {"list_bytes", "bytes", "/buffers/bytes/high_water", "", smaller, k_headline},
    {"excess_ratio", "ratio", "/error/excess_ratio", "", smaller, k_headline},
    {"missed_pairs", "pairs", "/error/false_negatives", "", smaller, k_headline},
    {"unlit", "ratio", "/shading/unlit", "", smaller, k_headline},
    {"dropped_pairs", "pairs", "/buffers/overflow/dropped_pairs", "", smaller, k_headline},
    {"overshade", "ratio", "/shading/overshade", "", smaller, k_headline},
    {"lights", "lights", "/lights", "", neither, k_headline},
    {"lights_lit", "lights", "/lights_lit", "", neither, k_headline},
    {"lights_seen", "lights", "/lights_seen", "", neither, k_headline},
    {"lights_in_view_max", "lights", "/lights_in_view/max", "", neither, k_headline},

    {"tests_done", "tests", "/tests_done", "", smaller, k_detail},
    {"fallbacks", "pairs", "/fallbacks", "", smaller, k_detail},
    {"lights_seen_mean", "lights", "/lights_in_view/shining_mean", "", neither, k_detail},
    {"lights_in_view_mean", "lights", "/lights_in_view/mean", "", neither, k_detail},
    {"pairs_mean", "pairs", "/occupancy/pairs/mean", "", neither, k_detail},
    {"pairs_max", "pairs", "/occupancy/pairs/max", "", neither, k_detail},
    {"lights_per_cell_mean", "lights", "/occupancy/lights_per_cell/mean", "", neither, k_detail},
    {"lights_per_cell_p99", "lights", "/occupancy/lights_per_cell/p99", "", neither, k_detail},
    {"lights_per_cell_max", "lights", "/occupancy/lights_per_cell/max", "", neither, k_detail},
    {"occupied_fraction", "ratio", "/occupancy/occupied_fraction/mean", "", neither, k_detail},
    {"entries_high_water", "entries", "/buffers/index_entries/high_water", "", smaller, k_detail},
    {"entries_recommended", "entries", "/buffers/index_entries/recommended", "", smaller, k_detail},
    {"bytes_recommended", "bytes", "/buffers/bytes/recommended", "", smaller, k_detail},
    {"upload_bytes_mean", "bytes", "/buffers/upload_bytes/mean", "", smaller, k_detail},
    {"gpu_cost", "ns", "/cost/gpu_ns", "", smaller, k_detail},
    {"traffic_bytes_mean", "bytes", "/buffers/traffic_bytes/mean", "", smaller, k_detail},
    {"upload_bytes_max", "bytes", "/buffers/upload_bytes/max", "", smaller, k_detail},
    {"scratch_bytes", "bytes", "/buffers/scratch_bytes", "", smaller, k_detail},
    {"true_pairs", "pairs", "/error/true_pairs", "", neither, k_detail},
    {"reported_pairs", "pairs", "/error/reported_pairs", "", neither, k_detail},
    {"false_positives", "pairs", "/error/false_positives", "", smaller, k_detail},
    {"miss_ratio", "ratio", "/error/miss_ratio", "", smaller, k_detail},
    {"deepest_miss", "ratio", "/error/deepest_miss", "", smaller, k_detail},
    {"undecided", "pairs", "/error/undecided", "", smaller, k_detail},
    {"samples_needed", "lights", "/shading/needed", "", neither, k_detail},
    {"samples_missed", "lights", "/shading/missed", "", smaller, k_detail},
    {"samples_missed_outside", "lights", "/shading/missed_outside", "", smaller, k_detail},
    {"lost_irradiance", "ratio", "/shading/lost_irradiance", "", smaller, k_detail},
    {"changed_pairs", "pairs", "/stability/changed/method/mean", "", smaller, k_detail},
    {"flickers", "pairs", "/stability/flickers/method", "", smaller, k_detail},
    {"extra_pairs", "pairs", "/precision/extra_pairs/mean", "", smaller, k_detail},
    {"build_time", "ns", "/timing/build_ns/median", "/timing/build_ns/ci95", smaller, k_detail},
    {"pairs_timed", "pairs", "/timing/pairs/mean", "", neither, k_detail},
    {"builds_per_frame", "builds", "/timing/builds_per_frame", "", smaller, k_detail},
    {"time_per_pair", "ns", "/timing/ns_per_pair", "", smaller, k_detail},
    {"write_floor", "ns", "/timing/write_floor_ns", "", neither, k_detail},
    {"floor_ratio", "ratio", "/timing/floor_ratio", "", smaller, k_detail},
    {"build_instructions", "instructions", "/count/instructions_per_build", "", smaller, k_detail},
    {"convert_instructions", "instructions", "/count/instructions_per_frame/convert", "", smaller, k_detail},
    {"assign_cycles", "cycles", "/count/cycles_per_frame/assign", "", smaller, k_detail},
    {"convert_cycles", "cycles", "/count/cycles_per_frame/convert", "", smaller, k_detail},
};

bool is_interval(const Json& value) {
  return value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
}

// A quotient by nothing is not a figure.
std::optional<double> figure(const Metric& metric, double value) {
  if (metric.dividend == 0.0) return value;
  return value > 0.0 ? std::optional(metric.dividend / value) : std::nullopt;
}

std::optional<Measured> measured_by(const Json& result_case, const Metric& metric) {
  const std::optional<double> found = number_at(result_case, std::string(metric.pointer));
  if (!found) return {};
  const std::optional<double> value = figure(metric, *found);
  if (!value) return {};
  Measured out{&metric, *value, {}};
  const Json* interval = metric.interval.empty() ? nullptr : value_at(result_case, std::string(metric.interval));
  if (interval == nullptr || !is_interval(*interval)) return out;
  const double a = figure(metric, (*interval)[0].get<double>()).value_or(*value);
  const double b = figure(metric, (*interval)[1].get<double>()).value_or(*value);
  out.ci95 = {std::min(a, b), std::max(a, b)};
  return out;
}

}  // namespace

Basis basis_of(const Metric& metric) {
  constexpr std::string_view k_derived[] = {"/timing/frame_ns/median", "/timing/worst_frame/ns", "/timing/ns_per_pair",
                                            "/timing/floor_ratio", "/cost/frame_ns"};
  if (std::find(std::begin(k_derived), std::end(k_derived), metric.pointer) != std::end(k_derived))
    return Basis::derived;
  if (metric.pointer == "/timing/pairs/mean" || metric.pointer == "/timing/builds_per_frame") return Basis::count;
  if (metric.pointer.starts_with("/timing/")) return Basis::time;
  return metric.pointer.starts_with("/count/") ? Basis::instructions : Basis::count;
}

std::span<const Metric> export_metrics() {
  return k_metrics;
}

std::vector<Measured> measured(const Json& result_case, bool all) {
  std::vector<Measured> out;
  for (const Metric& metric : k_metrics)
    if (metric.is_headline || all)
      if (const std::optional<Measured> found = measured_by(result_case, metric)) out.push_back(*found);
  return out;
}

}  // namespace clusterbench::report
