#include "result/figures/case_figure.h"

#include <algorithm>
#include <vector>

#include "core/text.h"
#include "result/at.h"
#include "result/sample_sets.h"

namespace clusterbench::result {
namespace {

constexpr double k_ns_per_us = 1000.0;

std::string text_of_place(std::optional<double> frame, const CellIndex* cell) {
  std::string text;
  if (frame) {
    if (*frame == static_cast<double>(k_found_frame)) return "";
    text = "frame " + std::to_string(static_cast<std::uint64_t>(*frame));
  }
  if (cell != nullptr) text += (text.empty() ? "" : ", ") + std::string("cell ") + Json(*cell).dump();
  return text;
}

// None if the whole is 0.
template <class Record>
std::optional<Quotient> quotient_of(const Share<Record>& share, const Record& record) {
  const std::optional<double> count = share.count(record);
  const double whole = share.whole == nullptr ? 1.0 : share.whole(record).value_or(0.0);
  return count && whole > 0.0 ? std::optional(Quotient{*count, whole}) : std::nullopt;
}

// Kept as a quotient: its only division gives the double nearest to the exact value, like the number of a budget.
std::optional<Quotient> recorded(const Figure& figure, const Case& result_case) {
  if (figure.share.count != nullptr)
    if (const std::optional<Quotient> share = quotient_of(figure.share, result_case)) return share;
  const std::optional<double> value = figure.recorded(result_case);
  if (!value) return {};
  if (figure.dividend == 0.0) return Quotient{*value, figure.is_in_us ? k_ns_per_us : 1.0};
  return *value > 0.0 ? std::optional(Quotient{figure.dividend, *value}) : std::nullopt;
}

std::optional<FigureValue> value_in_case(const Figure& figure, const Case& result_case) {
  const std::optional<Quotient> found = recorded(figure, result_case);
  if (!found) return {};
  const Place<Case>& worst = figure.worst;
  return FigureValue{*found, text_of_place(worst.frame != nullptr ? worst.frame(result_case) : std::nullopt,
                                           worst.cell != nullptr ? worst.cell(result_case) : nullptr)};
}

// The value of the set with the largest one: a good set must not compensate for a bad one.
std::optional<FigureValue> largest_of_sets(const Figure& figure, const Case& result_case,
                                           const std::vector<std::string>& sets) {
  std::optional<FigureValue> most;
  for (const std::string& set : sets) {
    const SampleSet* counts = samples_of_set(result_case, set);
    if (counts == nullptr || (figure.samples.is_of_needed && counts->needed == 0)) continue;
    const std::optional<Quotient> found = quotient_of(figure.samples.share, *counts);
    if (!found || (most && most->value() >= found->value())) continue;
    const std::string frame =
        text_of_place(figure.samples.worst_frame != nullptr ? figure.samples.worst_frame(*counts) : std::nullopt, {});
    most = FigureValue{*found, words_of_set(set) + (frame.empty() ? "" : ", ") + frame, joined(sets)};
  }
  return most;
}

std::optional<FigureValue> value_of_ranking_sets(const Figure& figure, const Case& result_case) {
  const std::vector<std::string> sets = ranking_set_names(result_case);
  const auto of_all_sets = [&](double value) { return FigureValue{{value, 1.0}, words_of_sets(sets), joined(sets)}; };
  if (figure.samples.over == OverSets::mean) {
    const std::optional<double> mean = mean_at_samples(result_case, figure.samples.share.count);
    return mean ? std::optional(of_all_sets(*mean)) : std::nullopt;
  }
  // With weights, overshade is the weighted value over all sets, as a frame shades them.
  if (figure.name == "overshade" && part<&Case::cost, &Cost::overshade>(result_case) != nullptr) {
    const std::optional<double> weighted = number<&Case::cost, &Cost::overshade>(result_case);
    // Older results have the ratio although a set lacks lights.
    return weighted && result_case.cost->lit ? std::optional(of_all_sets(*weighted)) : std::nullopt;
  }
  return largest_of_sets(figure, result_case, sets);
}

}  // namespace

FigureAtSamples figure_at_samples(const std::string& name) {
  const std::size_t point = name.find('.');
  if (point == std::string::npos || !is_sample_set(name.substr(0, point))) return {"", name};
  return {name.substr(0, point), name.substr(point + 1)};
}

const Figure* figure_named(const std::string& name) {
  const FigureAtSamples parts = figure_at_samples(name);
  const Figure* figure = find_figure(parts.figure);
  return figure == nullptr || (!parts.set.empty() && !figure->is_at_samples()) ? nullptr : figure;
}

bool is_at_samples(const std::string& name) {
  const Figure* figure = figure_named(name);
  return figure != nullptr && figure->is_at_samples();
}

std::optional<FigureValue> figure_value(const Case& result_case, const std::string& name) {
  const Figure* figure = figure_named(name);
  if (figure == nullptr) return {};
  if (!figure->is_at_samples()) return value_in_case(*figure, result_case);
  const std::string set = figure_at_samples(name).set;
  return set.empty() ? value_of_ranking_sets(*figure, result_case) : largest_of_sets(*figure, result_case, {set});
}

std::optional<double> figure_of(const Case& result_case, const std::string& name) {
  const std::optional<FigureValue> found = figure_value(result_case, name);
  return found ? std::optional(found->value()) : std::nullopt;
}

std::string why_no_figure(const std::string& name) {
  const Figure* figure = figure_named(name);
  if (figure == nullptr) return "";
  if (!figure->is_at_samples()) return std::string(figure->none);
  const std::string set = figure_at_samples(name).set;
  const std::string without = set.empty() || set == "volume"
                                  ? "shading.samples: 0 leaves them out, and methods of visible surfaces have none"
                                  : "samples." + set + ": {} takes such samples";
  if (figure->name == "overshade")
    return " (there is none where more than 0.1 % of the lights are unlit or fewer than 100 reach the samples; " +
           without + ")";
  if (figure->samples.over == OverSets::mean) return " (" + without + ")";
  return " (no light reaches the samples; " + without + ")";
}

std::optional<double> figure_over(std::span<const Case> cases, const std::string& name) {
  const Figure* figure = figure_named(name);
  if (figure == nullptr) return {};
  const OverCameras over = figure->over_cameras;
  double all = 0.0, weights = 0.0;
  for (const Case& result_case : cases) {
    const std::optional<double> value = figure_of(result_case, name);
    if (!value && figure->is_at_samples() && sum_at_samples(result_case, number<&SampleSet::samples>) == 0.0) continue;
    if (!value) return {};
    const double weight = over == OverCameras::mean ? static_cast<double>(result_case.frames) : 1.0;
    all = over == OverCameras::largest ? std::max(all, *value) : all + weight * *value;
    weights += weight;
  }
  if (weights == 0.0) return {};
  return over == OverCameras::mean ? all / weights : all;
}

}  // namespace clusterbench::result
