#include "report/cases/named_figures.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "config/limit_rules.h"
#include "core/text.h"
#include "report/cases/sample_sets.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using result::Buffers;
using result::Case;
using result::Cost;
using result::Count;
using result::DeepestMiss;
using result::HighWater;
using result::LightsInView;
using result::ListError;
using result::number;
using result::Occupancy;
using result::part;
using result::PerFrame;
using result::SampleSet;
using result::Spread;
using result::Time;
using result::Timing;
using result::WorstSampledFrame;
using result::WorstTimedFrame;

template <class Record>
using Number = std::optional<double> (*)(const Record& record);

// Frame and cell; null: a figure of no such place.
template <class Record>
struct Place {
  Number<Record> frame = nullptr;
  const result::CellIndex* (*cell)(const Record& record) = nullptr;
};

// A figure of a case, or of its counts at samples: `value`, by `divisor` or by `unit`. It is divided once, so that it
// is the double nearest to it, as the number of a budget is.
template <class Record>
struct FigureRow {
  const char* name;
  Number<Record> value;
  const char* hint = "";  // why a case may have none
  double unit = 1.0;
  Place<Record> worst = {};
  Number<Record> divisor = nullptr;
};

// Older results have the instructions of its parts alone.
std::optional<double> frame_instructions(const Case& result_case) {
  if (const auto frame = number<&Case::count, &Count::instructions_per_frame, &PerFrame::frame>(result_case))
    return frame;
  const auto pre_cull = number<&Case::count, &Count::instructions_per_frame, &PerFrame::pre_cull>(result_case),
             assign = number<&Case::count, &Count::instructions_per_frame, &PerFrame::assign>(result_case),
             convert = number<&Case::count, &Count::instructions_per_frame, &PerFrame::convert>(result_case);
  return assign ? std::optional(pre_cull.value_or(0.0) + *assign + convert.value_or(0.0)) : std::nullopt;
}

constexpr double k_ns_per_us = 1000.0;

constexpr const char* k_of_times = " (--no-timing or timing.measure: false leaves times out)";
constexpr const char* k_of_cells = " (structures without cells have none)";
constexpr const char* k_of_truth = " (accuracy.check: false leaves errors out; structures without cells have none)";
constexpr const char* k_of_counts = " (--count counts instructions)";
constexpr const char* k_of_lights = " (a result of an older version tells none)";

constexpr Place<Case> k_worst_buffers{number<&Case::buffers, &Buffers::worst_frame>,
                                      part<&Case::buffers, &Buffers::worst_cell>};

constexpr FigureRow<Case> k_figure_rows[] = {
    {"frame_us", number<&Case::timing, &Timing::frame_ns, &Time::median>, k_of_times, k_ns_per_us},
    {"frame_us.max",
     number<&Case::timing, &Timing::worst_frame, &WorstTimedFrame::ns>,
     k_of_times,
     k_ns_per_us,
     {number<&Case::timing, &Timing::worst_frame, &WorstTimedFrame::frame>}},
    {"frame_cost_us", number<&Case::cost, &Cost::frame_ns>, "", k_ns_per_us},
    {"assign_us", number<&Case::timing, &Timing::assign_ns, &Time::median>, k_of_times, k_ns_per_us},
    {"convert_us", number<&Case::timing, &Timing::convert_ns, &Time::median>, k_of_times, k_ns_per_us},
    {"build_us", number<&Case::timing, &Timing::build_ns, &Time::median>, k_of_times, k_ns_per_us},
    {"index_entries", number<&Case::buffers, &Buffers::index_entries, &HighWater::high_water>, "", 1.0,
     k_worst_buffers},
    {"bytes", number<&Case::buffers, &Buffers::bytes, &HighWater::high_water>, "", 1.0, k_worst_buffers},
    {"upload_bytes", number<&Case::buffers, &Buffers::upload_bytes, &result::FrameBytes::max>},
    {"scratch_bytes", number<&Case::buffers, &Buffers::scratch_bytes>},
    {"longest",
     number<&Case::occupancy, &Occupancy::lights_per_cell, &result::LightsPerCell::max>,
     k_of_cells,
     1.0,
     {number<&Case::occupancy, &Occupancy::worst_frame>, part<&Case::occupancy, &Occupancy::worst_cell>}},
    {"pairs", number<&Case::occupancy, &Occupancy::pairs, &Spread::max>, k_of_cells},
    {"pairs.mean", number<&Case::occupancy, &Occupancy::pairs, &Spread::mean>, k_of_cells},
    {"dropped", number<&Case::buffers, &Buffers::overflow, &result::Overflow::dropped_pairs>},
    {"missed",
     number<&Case::error, &ListError::false_negatives>,
     k_of_truth,
     1.0,
     {number<&Case::error, &ListError::deepest, &DeepestMiss::frame>,
      part<&Case::error, &ListError::deepest, &DeepestMiss::cell>}},
    {"excess",
     number<&Case::error, &ListError::false_positives>,
     k_of_truth,
     1.0,
     {},
     number<&Case::error, &ListError::true_pairs>},
    {"excess", number<&Case::error, &ListError::excess_ratio>, k_of_truth},
    {"undecided", number<&Case::error, &ListError::undecided>, k_of_truth},
    {"instructions", frame_instructions, k_of_counts},
    {"assign_instructions", number<&Case::count, &Count::instructions_per_frame, &PerFrame::assign>, k_of_counts},
    {"convert_instructions", number<&Case::count, &Count::instructions_per_frame, &PerFrame::convert>, k_of_counts},
    {"lights", number<&Case::lights>, k_of_lights},
    {"lights_lit", number<&Case::lights_lit>, k_of_lights},
    {"lights_seen", number<&Case::lights_seen>, k_of_lights},
    {"lights_seen.mean", number<&Case::lights_in_view, &LightsInView::shining_mean>, k_of_lights},
    {"lights_in_view",
     number<&Case::lights_in_view, &LightsInView::max>,
     k_of_lights,
     1.0,
     {number<&Case::lights_in_view, &LightsInView::worst_frame>}},
};

constexpr FigureRow<SampleSet> k_rows_at_samples[] = {
    {"unlit",
     number<&SampleSet::missed>,
     "",
     1.0,
     {number<&SampleSet::worst_frame, &WorstSampledFrame::frame>},
     number<&SampleSet::needed>},
    {"lost_irradiance", number<&SampleSet::lost_irradiance>},
    {"overshade", number<&SampleSet::overshade>},
    {"needed", number<&SampleSet::needed>, "", 1.0, {}, number<&SampleSet::samples>},
};

template <class Record>
std::string text_of_place(const Place<Record>& place, const Record& from) {
  std::string text;
  if (const auto frame = place.frame != nullptr ? place.frame(from) : std::nullopt) {
    if (*frame == static_cast<double>(k_found_frame)) return "";
    text = "frame " + std::to_string(static_cast<std::uint64_t>(*frame));
  }
  if (const auto* cell = place.cell != nullptr ? place.cell(from) : nullptr; cell != nullptr)
    text += (text.empty() ? "" : ", ") + std::string("cell ") + nlohmann::ordered_json(*cell).dump();
  return text;
}

template <class Record>
std::optional<Figure> found_by(const FigureRow<Record>& row, const Record& from) {
  const std::optional<double> value = row.value(from);
  const double whole = row.divisor == nullptr ? row.unit : row.divisor(from).value_or(0.0);
  if (!value || !(whole > 0.0)) return {};  // a share of nothing
  return Figure{{*value, whole}, text_of_place(row.worst, from)};
}

const FigureRow<SampleSet>* row_at_samples(const std::string& figure) {
  const auto* const row = std::ranges::find(k_rows_at_samples, figure, &FigureRow<SampleSet>::name);
  return row == std::end(k_rows_at_samples) ? nullptr : row;
}

// Of several sets the one where it is largest: what is lacking in one is not made up for in another. Overshade of sets
// that have weights is that of all of them, as a frame shades them.
std::optional<Figure> found_at_samples(const Case& result_case, const FigureRow<SampleSet>& row,
                                       const std::vector<std::string>& sets, bool is_of_ranking) {
  const bool is_weighted = is_of_ranking && row.name == std::string_view("overshade");
  if (const auto weighted = number<&Case::cost, &Cost::overshade>(result_case); is_weighted && weighted) {
    if (!result_case.cost->lit) return {};  // older results have the ratio all the same
    return Figure{{*weighted, 1.0}, words_of_sets(sets), joined(sets)};
  }
  std::optional<Figure> most;
  for (const std::string& set : sets) {
    const SampleSet* counts = samples_of_set(result_case, set);
    if (counts == nullptr) continue;
    // Where no light reaches a set, none is unlit, and as many are needed: 0.
    if (counts->needed == 0 && row.name != std::string_view("needed")) continue;
    std::optional<Figure> found = found_by(row, *counts);
    if (!found || (most && most->value() >= found->value())) continue;
    found->location = words_of_set(set) + (found->location.empty() ? "" : ", ") + found->location;
    found->samples = joined(sets);
    most = std::move(found);
  }
  return most;
}

}  // namespace

std::optional<Figure> case_figure(const Case& result_case, const std::string& name) {
  const config::FigureAtSamples parts = config::figure_at_samples(name);
  if (const FigureRow<SampleSet>* row = row_at_samples(parts.figure))
    return parts.set.empty() ? found_at_samples(result_case, *row, ranking_set_names(result_case), true)
                             : found_at_samples(result_case, *row, {parts.set}, false);
  for (const FigureRow<Case>& row : k_figure_rows)
    if (row.name == name)
      if (std::optional<Figure> found = found_by(row, result_case)) return found;
  return {};
}

std::string why_no_figure(const std::string& figure) {
  const auto* const row = std::ranges::find(k_figure_rows, figure, &FigureRow<Case>::name);
  if (row != std::end(k_figure_rows)) return row->hint;
  const config::FigureAtSamples parts = config::figure_at_samples(figure);
  if (row_at_samples(parts.figure) == nullptr) return "";
  const std::string without = parts.set.empty() || parts.set == "volume"
                                  ? "shading.samples: 0 leaves them out, and methods of visible surfaces have none"
                                  : "samples." + parts.set + ": {} takes such samples";
  if (parts.figure == "overshade")
    return " (there is none where more than 0.1 % of the lights are unlit or fewer than 100 reach the samples; " +
           without + ")";
  return " (no light reaches the samples; " + without + ")";
}

std::optional<double> limit_figure(const Case& result_case, const std::string& name) {
  const std::optional<Figure> found = case_figure(result_case, name);
  return found ? std::optional(found->value()) : std::nullopt;
}

std::string limit_figure_location(const Case& result_case, const std::string& name) {
  const std::optional<Figure> found = case_figure(result_case, name);
  return found ? found->location : "";
}

}  // namespace clusterbench::report
