#include "report/limits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "core/pattern.h"
#include "core/text.h"
#include "report/baseline_cases.h"
#include "report/case_filter.h"
#include "report/found_frames.h"
#include "report/percent_change.h"
#include "report/sample_sets.h"
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

// With where it is so, and of which samples.
struct Found {
  Quotient quotient = {};
  std::string location, samples = {};

  double value() const { return quotient.value(); }
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
std::optional<Found> found_by(const FigureRow<Record>& row, const Record& from) {
  const std::optional<double> value = row.value(from);
  const double whole = row.divisor == nullptr ? row.unit : row.divisor(from).value_or(0.0);
  if (!value || !(whole > 0.0)) return {};  // a share of nothing
  return Found{{*value, whole}, text_of_place(row.worst, from)};
}

const FigureRow<SampleSet>* row_at_samples(const std::string& figure) {
  const auto* const row = std::ranges::find(k_rows_at_samples, figure, &FigureRow<SampleSet>::name);
  return row == std::end(k_rows_at_samples) ? nullptr : row;
}

// Of several sets the one where it is largest: what is lacking in one is not made up for in another. Overshade of sets
// that have weights is that of all of them, as a frame shades them.
std::optional<Found> found_at_samples(const Case& result_case, const FigureRow<SampleSet>& row,
                                      const std::vector<std::string>& sets, bool is_of_ranking) {
  const bool is_weighted = is_of_ranking && row.name == std::string_view("overshade");
  if (const auto weighted = number<&Case::cost, &Cost::overshade>(result_case); is_weighted && weighted) {
    if (!result_case.cost->lit) return {};  // older results have the ratio all the same
    return Found{{*weighted, 1.0}, words_of_sets(sets), joined(sets)};
  }
  std::optional<Found> most;
  for (const std::string& set : sets) {
    const SampleSet* counts = samples_of_set(result_case, set);
    if (counts == nullptr) continue;
    // Where no light reaches a set, none is unlit, and as many are needed: 0.
    if (counts->needed == 0 && row.name != std::string_view("needed")) continue;
    std::optional<Found> found = found_by(row, *counts);
    if (!found || (most && most->value() >= found->value())) continue;
    found->location = words_of_set(set) + (found->location.empty() ? "" : ", ") + found->location;
    found->samples = joined(sets);
    most = std::move(found);
  }
  return most;
}

std::optional<Found> found_in(const Case& result_case, const std::string& name) {
  const config::FigureAtSamples parts = config::figure_at_samples(name);
  if (const FigureRow<SampleSet>* row = row_at_samples(parts.figure))
    return parts.set.empty() ? found_at_samples(result_case, *row, ranking_set_names(result_case), true)
                             : found_at_samples(result_case, *row, {parts.set}, false);
  for (const FigureRow<Case>& row : k_figure_rows)
    if (row.name == name)
      if (std::optional<Found> found = found_by(row, result_case)) return found;
  return {};
}

// Why a case may lack a figure.
std::string reason_for_none(const std::string& figure) {
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

std::string listed_names(const std::vector<std::string>& names) {
  constexpr std::size_t k_most = 3;
  const std::size_t shown_names = std::min(names.size(), k_most);
  return joined(std::span(names).first(shown_names)) + (names.size() > k_most ? " ..." : "");
}

std::string is_text(const config::LimitRule& rule, const Found& found) {
  return rule.figure + " is " + config::budget_number(found.value()) +
         (found.location.empty() ? "" : " (" + found.location + ")");
}

// What is said of cases, each sentence once: figures of a scene or of a view are those of many cases.
class SaidOfCases {
 public:
  void add(const Case& result_case, const std::string& sentence) {
    auto said = std::ranges::find(said_, sentence, &Said::sentence);
    if (said == said_.end()) said = said_.insert(said_.end(), {sentence, result_case.name, 0});
    ++said->cases;
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> out;
    for (const Said& said : said_)
      out.push_back(said.first_case +
                    (said.cases > 1 ? " and " + number_of(said.cases - 1, "other case") + ": " : ": ") + said.sentence);
    return out;
  }

 private:
  struct Said {
    std::string sentence, first_case;
    std::size_t cases = 0;
  };
  std::vector<Said> said_;
};

// One budget held against the cases that it names.
class RuleCheck {
 public:
  RuleCheck(const result::Result& result, const config::LimitRule& rule, const BaselineCases* baseline,
            LimitFindings& findings)
      : rule_(rule), quoted_("'" + rule.text() + "'"), baseline_(baseline), findings_(findings) {
    const Pattern pattern(rule.cases, "");
    for (const Case& result_case : result.cases)
      if (is_selected(pattern, result_case)) cases_.push_back(&result_case);
  }

  void check(const result::Result& result) {
    if (cases_.empty())
      add_none(result);
    else if (rule_.is_relative)
      check_changes();
    else
      check_values();
    for (const std::string& text : broken_.texts()) findings_.broken.push_back(text);
    for (const std::string& text : near_.texts()) findings_.near.push_back(text);
  }

 private:
  void add_none(const result::Result& result) {
    std::vector<std::string> names;
    for (const Case& result_case : result.cases) names.push_back(result_case.name);
    findings_.broken.push_back(quoted_ + " could not be checked: " +
                               (names.empty() ? "there is no case"
                                              : "its '" + rule_.cases + "' matches no case's name" +
                                                    pattern_hint(rule_.cases) + "; there are: " + listed_names(names)));
  }

  void check_values() {
    std::vector<std::string> without;
    for (const Case* result_case : cases_) {
      bool has_none = true;
      for (const std::string& figure : figures_of({result_case}))
        if (const std::optional<Found> found = found_in(*result_case, figure)) {
          has_none = false;
          judge(*result_case, rule_.is_broken_by(found->value()), found->value(), is_text(rule_, *found));
        }
      if (has_none) without.push_back(result_case->name);
    }
    add_without(without);
  }

  // Of lights needed at several sets each by itself: what one of them has lost the largest one would hide. Sets of now
  // and before.
  std::vector<std::string> figures_of(const std::vector<const Case*>& cases) const {
    if (rule_.figure != "needed") return {rule_.figure};
    std::vector<std::string> figures;
    for (const Case* result_case : cases)
      for (const std::string& set : ranking_set_names(*result_case))
        if (const std::string figure = set + ".needed"; std::ranges::find(figures, figure) == figures.end())
          figures.push_back(figure);
    return figures.size() > 1 ? figures : std::vector{rule_.figure};
  }

  // Whoever names cases means them; a budget of all is held against those that can have the figure.
  void add_without(const std::vector<std::string>& without) {
    const std::string hint = reason_for_none(rule_.figure);
    if (without.size() == cases_.size())
      findings_.broken.push_back(quoted_ + " could not be checked: no case has " + rule_.figure + hint);
    else if (!without.empty())
      (rule_.cases.empty() ? findings_.unchecked : findings_.broken)
          .push_back(quoted_ + " was not checked for " + number_of(without.size(), "case") + " without " +
                     rule_.figure + hint + ": " + without.front() + (without.size() > 1 ? " ..." : ""));
  }

  void check_changes() {
    if (baseline_ == nullptr) {
      findings_.broken.push_back(quoted_ + " could not be checked: there is no baseline (--baseline FILE)");
      return;
    }
    std::vector<std::string> not_in_base, without, in_one;
    std::string obstacle;
    for (const Case* result_case : cases_) {
      const std::string& name = result_case->name;
      const Case* before = baseline_->case_of(*result_case);
      if (before == nullptr) {
        not_in_base.push_back(name);
        continue;
      }
      const std::string why = is_instructions() ? baseline_->obstacle_to_instructions(*result_case) : "";
      bool has_none = true, lacks_one = false;
      for (const std::string& figure : figures_of({result_case, before})) {
        const std::optional<Found> now = found_in(*result_case, figure), then = found_in(*before, figure);
        has_none = has_none && !now && !then;
        if (!now || !then)
          lacks_one = lacks_one || now || then;
        else if (!why.empty())
          obstacle = why;
        else if (now->samples != then->samples)
          add_other_samples(name, *now, *then);
        else
          judge_change(*result_case, *now, *then);
      }
      if (has_none) without.push_back(name);
      if (lacks_one) in_one.push_back(name);
    }
    if (!in_one.empty())
      findings_.broken.push_back(quoted_ + " could not be checked for " + number_of(in_one.size(), "case") +
                                 ", since only one of this result and " + baseline_->name() + " has " + rule_.figure +
                                 reason_for_none(rule_.figure) + ": " + listed_names(in_one));
    add_unmatched(not_in_base, without, obstacle);
  }

  void judge_change(const Case& result_case, const Found& now, const Found& then) {
    const double percent = percent_change(then.quotient, now.quotient);
    const std::string change =
        std::isfinite(percent) ? percent_text(percent, rule_.limit) + " against " : std::string("was ");
    judge(result_case, is_broken_by_change(rule_, then.quotient, now.quotient), percent,
          is_text(rule_, now) + ", " + change + config::budget_number(then.value()) + " in " + baseline_->name());
  }

  void add_other_samples(const std::string& name, const Found& now, const Found& then) {
    findings_.broken.push_back(quoted_ + " could not be checked for " + name + ": " + rule_.figure +
                               " is at samples of " + now.samples + " here and of " + then.samples + " in " +
                               baseline_->name() + "; name one set, as in 'volume." + rule_.figure + "'");
  }

  void add_unmatched(const std::vector<std::string>& not_in_base, const std::vector<std::string>& without,
                     const std::string& obstacle) {
    const std::string begin = quoted_ + " could not be checked";
    if (!not_in_base.empty())
      findings_.broken.push_back(
          begin + " for " + number_of(not_in_base.size(), "case") + " that " + baseline_->name() +
          " does not have (of that camera, viewport, grid, method and structure): " + listed_names(not_in_base) +
          "; measure the baseline again, or name cases before a colon");
    const std::string hint = reason_for_none(rule_.figure);
    if (!without.empty() && without.size() == cases_.size())
      findings_.broken.push_back(begin + ": no case has " + rule_.figure + " here and in " + baseline_->name() + hint);
    else if (!without.empty())
      (rule_.cases.empty() ? findings_.unchecked : findings_.broken)
          .push_back(quoted_ + " was not checked for " + number_of(without.size(), "case") + " without " +
                     rule_.figure + " here or in " + baseline_->name() + hint + ": " + listed_names(without));
    if (!obstacle.empty())
      findings_.broken.push_back(begin + ": instructions do not compare, " + obstacle +
                                 "; measure the baseline in the same job");
    const Pattern pattern(rule_.cases, "");
    std::vector<std::string> gone;
    for (const Case* base_case : baseline_->gone_cases())
      if (is_selected(pattern, *base_case)) gone.push_back(base_case->name);
    if (!gone.empty())
      findings_.broken.push_back(begin + " for " + number_of(gone.size(), "case") + " of " + baseline_->name() +
                                 " that this result does not have: " + listed_names(gone) +
                                 "; measure the baseline again, or name cases before a colon");
  }

  bool is_instructions() const { return rule_.figure.ends_with("instructions"); }

  void judge(const Case& result_case, bool is_broken, double value, const std::string& text) {
    ++findings_.checked;
    if (is_broken)
      broken_.add(result_case, text + ", and fails with " + rule_.text());
    else if (rule_.is_near(value))
      near_.add(result_case, text + ", near the budget " + rule_.text());
  }

  const config::LimitRule& rule_;
  std::string quoted_;
  const BaselineCases* baseline_;
  LimitFindings& findings_;
  std::vector<const Case*> cases_;
  SaidOfCases broken_, near_;
};

// What stands between a relative budget and its baseline beside the figure itself, each answer once.
void add_changes_since(const result::Result& result, const BaselineCases& baseline, LimitFindings& findings) {
  std::map<std::string, std::vector<std::string>> names;
  for (const Case& result_case : result.cases)
    if (const std::string changes = baseline.what_changed(result_case); !changes.empty())
      names[changes].push_back(result_case.name);
  for (const auto& [changes, changed_cases] : names)
    findings.warnings.push_back("changed since " + baseline.name() + " (" + number_of(changed_cases.size(), "case") +
                                "): " + changes + "; " + listed_names(changed_cases));
}

}  // namespace

std::optional<double> limit_figure(const Case& result_case, const std::string& name) {
  const std::optional<Found> found = found_in(result_case, name);
  return found ? std::optional(found->value()) : std::nullopt;
}

std::string limit_figure_location(const Case& result_case, const std::string& name) {
  const std::optional<Found> found = found_in(result_case, name);
  return found ? found->location : "";
}

LimitFindings limit_findings(const result::Result& result, std::span<const config::LimitRule> rules,
                             const BaselineCases* baseline) {
  LimitFindings findings;
  for (const config::LimitRule& rule : rules) RuleCheck(result, rule, baseline, findings).check(result);
  const bool is_relative = std::ranges::any_of(rules, [](const config::LimitRule& rule) { return rule.is_relative; });
  if (is_relative && baseline != nullptr) add_changes_since(result, *baseline, findings);
  return findings;
}

}  // namespace clusterbench::report
