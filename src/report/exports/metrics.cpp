#include "report/exports/metrics.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "result/at.h"

namespace clusterbench::report {
namespace {

using enum Basis;
using enum Better;
using result::AgainstFirst;
using result::Buffers;
using result::Case;
using result::Changed;
using result::Churn;
using result::Cost;
using result::Count;
using result::ExtraPairs;
using result::Flickers;
using result::FrameBytes;
using result::HighWater;
using result::LightsInView;
using result::LightsPerCell;
using result::ListError;
using result::number;
using result::Occupancy;
using result::Overflow;
using result::part;
using result::PerFrame;
using result::Precision;
using result::SampleSet;
using result::Spread;
using result::Stability;
using result::Time;
using result::TimedPairs;
using result::Timing;
using result::WorstTimedFrame;

constexpr bool k_headline = true, k_detail = false;

constexpr Metric k_metrics[] = {
    {"frame_time", "ns", smaller, derived, k_headline, number<&Case::timing, &Timing::frame_ns, &Time::median>,
     part<&Case::timing, &Timing::frame_ns, &Time::ci95>},
    {"worst_frame_time", "ns", smaller, derived, k_headline,
     number<&Case::timing, &Timing::worst_frame, &WorstTimedFrame::ns>,
     part<&Case::timing, &Timing::worst_frame, &WorstTimedFrame::ci95>},
    {"assign_time", "ns", smaller, time, k_headline, number<&Case::timing, &Timing::assign_ns, &Time::median>,
     part<&Case::timing, &Timing::assign_ns, &Time::ci95>},
    {"convert_time", "ns", smaller, time, k_headline, number<&Case::timing, &Timing::convert_ns, &Time::median>,
     part<&Case::timing, &Timing::convert_ns, &Time::ci95>},
    {"frame_cost", "ns", smaller, derived, k_headline, number<&Case::cost, &Cost::frame_ns>},
    {"frame_instructions", "instructions", smaller, instructions, k_headline,
     number<&Case::count, &Count::instructions_per_frame, &PerFrame::frame>},
    {"assign_instructions", "instructions", smaller, instructions, k_headline,
     number<&Case::count, &Count::instructions_per_frame, &PerFrame::assign>},
    {"speedup", "ratio", bigger, time, k_headline, number<&Case::timing, &Timing::against_first, &AgainstFirst::ratio>,
     part<&Case::timing, &Timing::against_first, &AgainstFirst::ci95>, 1.0},
    {"pair_rate", "pairs/s", bigger, derived, k_headline, number<&Case::timing, &Timing::ns_per_pair>, nullptr, 1e9},
    {"list_bytes", "bytes", smaller, count, k_headline,
     number<&Case::buffers, &Buffers::bytes, &HighWater::high_water>},
    {"excess_ratio", "ratio", smaller, count, k_headline, number<&Case::error, &ListError::excess_ratio>},
    {"missed_pairs", "pairs", smaller, count, k_headline, number<&Case::error, &ListError::false_negatives>},
    {"unlit", "ratio", smaller, count, k_headline, number<&Case::shading, &SampleSet::unlit>},
    {"dropped_pairs", "pairs", smaller, count, k_headline,
     number<&Case::buffers, &Buffers::overflow, &Overflow::dropped_pairs>},
    {"overshade", "ratio", smaller, count, k_headline, number<&Case::shading, &SampleSet::overshade>},
    {"lights", "lights", neither, count, k_headline, number<&Case::lights>},
    {"lights_lit", "lights", neither, count, k_headline, number<&Case::lights_lit>},
    {"lights_seen", "lights", neither, count, k_headline, number<&Case::lights_seen>},
    {"lights_in_view_max", "lights", neither, count, k_headline, number<&Case::lights_in_view, &LightsInView::max>},

    {"tests_done", "tests", smaller, count, k_detail, number<&Case::tests_done>},
    {"fallbacks", "pairs", smaller, count, k_detail, number<&Case::fallbacks>},
    {"lights_seen_mean", "lights", neither, count, k_detail,
     number<&Case::lights_in_view, &LightsInView::shining_mean>},
    {"lights_in_view_mean", "lights", neither, count, k_detail, number<&Case::lights_in_view, &LightsInView::mean>},
    {"pairs_mean", "pairs", neither, count, k_detail, number<&Case::occupancy, &Occupancy::pairs, &Spread::mean>},
    {"pairs_max", "pairs", neither, count, k_detail, number<&Case::occupancy, &Occupancy::pairs, &Spread::max>},
    {"lights_per_cell_mean", "lights", neither, count, k_detail,
     number<&Case::occupancy, &Occupancy::lights_per_cell, &LightsPerCell::mean>},
    {"lights_per_cell_p99", "lights", neither, count, k_detail,
     number<&Case::occupancy, &Occupancy::lights_per_cell, &LightsPerCell::p99>},
    {"lights_per_cell_max", "lights", neither, count, k_detail,
     number<&Case::occupancy, &Occupancy::lights_per_cell, &LightsPerCell::max>},
    {"occupied_fraction", "ratio", neither, count, k_detail,
     number<&Case::occupancy, &Occupancy::occupied_fraction, &Spread::mean>},
    {"entries_high_water", "entries", smaller, count, k_detail,
     number<&Case::buffers, &Buffers::index_entries, &HighWater::high_water>},
    {"entries_recommended", "entries", smaller, count, k_detail,
     number<&Case::buffers, &Buffers::index_entries, &HighWater::recommended>},
    {"bytes_recommended", "bytes", smaller, count, k_detail,
     number<&Case::buffers, &Buffers::bytes, &HighWater::recommended>},
    {"upload_bytes_mean", "bytes", smaller, count, k_detail,
     number<&Case::buffers, &Buffers::upload_bytes, &FrameBytes::mean>},
    {"gpu_cost", "ns", smaller, count, k_detail, number<&Case::cost, &Cost::gpu_ns>},
    {"traffic_bytes_mean", "bytes", smaller, count, k_detail,
     number<&Case::buffers, &Buffers::traffic_bytes, &FrameBytes::mean>},
    {"upload_bytes_max", "bytes", smaller, count, k_detail,
     number<&Case::buffers, &Buffers::upload_bytes, &FrameBytes::max>},
    {"scratch_bytes", "bytes", smaller, count, k_detail, number<&Case::buffers, &Buffers::scratch_bytes>},
    {"true_pairs", "pairs", neither, count, k_detail, number<&Case::error, &ListError::true_pairs>},
    {"reported_pairs", "pairs", neither, count, k_detail, number<&Case::error, &ListError::reported_pairs>},
    {"false_positives", "pairs", smaller, count, k_detail, number<&Case::error, &ListError::false_positives>},
    {"miss_ratio", "ratio", smaller, count, k_detail, number<&Case::error, &ListError::miss_ratio>},
    {"deepest_miss", "ratio", smaller, count, k_detail, number<&Case::error, &ListError::deepest_miss>},
    {"undecided", "pairs", smaller, count, k_detail, number<&Case::error, &ListError::undecided>},
    {"samples_needed", "lights", neither, count, k_detail, number<&Case::shading, &SampleSet::needed>},
    {"samples_missed", "lights", smaller, count, k_detail, number<&Case::shading, &SampleSet::missed>},
    {"samples_missed_outside", "lights", smaller, count, k_detail, number<&Case::shading, &SampleSet::missed_outside>},
    {"lost_irradiance", "ratio", smaller, count, k_detail, number<&Case::shading, &SampleSet::lost_irradiance>},
    {"changed_pairs", "pairs", smaller, count, k_detail,
     number<&Case::stability, &Stability::changed, &Changed::method, &Churn::mean>},
    {"flickers", "pairs", smaller, count, k_detail, number<&Case::stability, &Stability::flickers, &Flickers::method>},
    {"extra_pairs", "pairs", smaller, count, k_detail,
     number<&Case::precision, &Precision::extra_pairs, &ExtraPairs::mean>},
    {"build_time", "ns", smaller, time, k_detail, number<&Case::timing, &Timing::build_ns, &Time::median>,
     part<&Case::timing, &Timing::build_ns, &Time::ci95>},
    {"pairs_timed", "pairs", neither, count, k_detail, number<&Case::timing, &Timing::pairs, &TimedPairs::mean>},
    {"builds_per_frame", "builds", smaller, count, k_detail, number<&Case::timing, &Timing::builds_per_frame>},
    {"time_per_pair", "ns", smaller, derived, k_detail, number<&Case::timing, &Timing::ns_per_pair>},
    {"write_floor", "ns", neither, time, k_detail, number<&Case::timing, &Timing::write_floor_ns>},
    {"floor_ratio", "ratio", smaller, derived, k_detail, number<&Case::timing, &Timing::floor_ratio>},
    {"build_instructions", "instructions", smaller, instructions, k_detail,
     number<&Case::count, &Count::instructions_per_build>},
    {"convert_instructions", "instructions", smaller, instructions, k_detail,
     number<&Case::count, &Count::instructions_per_frame, &PerFrame::convert>},
    {"assign_cycles", "cycles", smaller, instructions, k_detail,
     number<&Case::count, &Count::cycles_per_frame, &PerFrame::assign>},
    {"convert_cycles", "cycles", smaller, instructions, k_detail,
     number<&Case::count, &Count::cycles_per_frame, &PerFrame::convert>},
};

// A quotient by nothing is not a figure.
std::optional<double> figure(const Metric& metric, double value) {
  if (metric.dividend == 0.0) return value;
  return value > 0.0 ? std::optional(metric.dividend / value) : std::nullopt;
}

std::optional<Measured> measured_by(const Case& result_case, const Metric& metric) {
  const std::optional<double> found = metric.value(result_case);
  if (!found) return {};
  const std::optional<double> value = figure(metric, *found);
  if (!value) return {};
  Measured out{&metric, *value, {}};
  const result::Interval* ends = metric.interval == nullptr ? nullptr : metric.interval(result_case);
  if (ends == nullptr || !std::isfinite((*ends)[0]) || !std::isfinite((*ends)[1])) return out;
  const double a = figure(metric, (*ends)[0]).value_or(*value), b = figure(metric, (*ends)[1]).value_or(*value);
  out.ci95 = {std::min(a, b), std::max(a, b)};
  return out;
}

}  // namespace

std::span<const Metric> export_metrics() {
  return k_metrics;
}

std::vector<Measured> measured(const Case& result_case, bool all) {
  std::vector<Measured> out;
  for (const Metric& metric : k_metrics)
    if (metric.is_headline || all)
      if (const std::optional<Measured> found = measured_by(result_case, metric)) out.push_back(*found);
  return out;
}

}  // namespace clusterbench::report
