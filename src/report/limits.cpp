#include "report/limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string_view>

#include "core/pattern.h"
#include "core/text.h"
#include "report/baseline_cases.h"
#include "report/case_filter.h"
#include "report/json_values.h"
#include "report/percent_change.h"
#include "report/sample_sets.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// A figure of a case: the number at `value`, by that at `divisor` or by `unit`. All are JSON pointers; "": none. It is
// divided once, so that it is the double nearest to it, as the number of a budget is.
struct FigureRow {
  const char* name;
  const char* value;
  double unit = 1.0;
  const char* frame = "";
  const char* cell = "";
  const char* divisor = "";
  // Where older results lack `value`: the sum of what is at these.
  std::array<const char*, 3> parts = {};
};
constexpr double k_ns_per_us = 1000.0;
constexpr FigureRow k_figure_rows[] = {
    {"frame_us", "/timing/frame_ns/median", k_ns_per_us},
    {"frame_us.max", "/timing/worst_frame/ns", k_ns_per_us, "/timing/worst_frame/frame"},
    {"frame_cost_us", "/cost/frame_ns", k_ns_per_us},
    {"assign_us", "/timing/assign_ns/median", k_ns_per_us},
    {"convert_us", "/timing/convert_ns/median", k_ns_per_us},
    {"build_us", "/timing/build_ns/median", k_ns_per_us},
    {"index_entries", "/buffers/index_entries/high_water", 1.0, "/buffers/worst_frame", "/buffers/worst_cell"},
    {"bytes", "/buffers/bytes/high_water", 1.0, "/buffers/worst_frame", "/buffers/worst_cell"},
    {"upload_bytes", "/buffers/upload_bytes/max"},
    {"scratch_bytes", "/buffers/scratch_bytes"},
    {"longest", "/occupancy/lights_per_cell/max", 1.0, "/occupancy/worst_frame", "/occupancy/worst_cell"},
    {"pairs", "/occupancy/pairs/max"},
    {"pairs.mean", "/occupancy/pairs/mean"},
    {"dropped", "/buffers/overflow/dropped_pairs"},
    {"missed", "/error/false_negatives", 1.0, "/error/deepest/frame", "/error/deepest/cell"},
    {"excess", "/error/false_positives", 1.0, "", "", "/error/true_pairs"},
    {"excess", "/error/excess_ratio"},
    {"undecided", "/error/undecided"},
    {"instructions",
     "/count/instructions_per_frame/frame",
     1.0,
     "",
     "",
     "",
     {"/count/instructions_per_frame/pre_cull", "/count/instructions_per_frame/assign",
      "/count/instructions_per_frame/convert"}},
    {"assign_instructions", "/count/instructions_per_frame/assign"},
    {"convert_instructions", "/count/instructions_per_frame/convert"},
    {"lights", "/lights"},
    {"lights_lit", "/lights_lit"},
    {"lights_seen", "/lights_seen"},
    {"lights_seen.mean", "/lights_in_view/shining_mean"},
    {"lights_in_view", "/lights_in_view/max", 1.0, "/lights_in_view/worst_frame"},
};

// Figures at samples: pointers in the counts of a set.
constexpr FigureRow k_rows_at_samples[] = {
    {"unlit", "/missed", 1.0, "/worst_frame/frame", "", "/needed"},
    {"lost_irradiance", "/lost_irradiance"},
    {"overshade", "/overshade"},
    {"needed", "/needed", 1.0, "", "", "/samples"},
};

// With where it is so, and of which samples.
struct Found {
  Quotient quotient = {};
  std::string location, samples = {};

  double value() const { return quotient.value(); }
};
std::optional<double> sum_of_parts(const Json& result_case, const FigureRow& row) {
  std::optional<double> sum;
  for (const char* part : row.parts)
    if (const std::optional<double> value = part != nullptr ? number_at(result_case, part) : std::nullopt)
      sum = sum.value_or(0.0) + *value;
  return sum;
}

std::string worst_location(const Json& result_case, const FigureRow& row) {
  std::string text;
  for (const auto& [word, pointer] : {std::pair("frame ", row.frame), std::pair("cell ", row.cell)})
    if (const Json* found = *pointer != '\0' ? value_at(result_case, pointer) : nullptr; found != nullptr)
      text += (text.empty() ? "" : ", ") + std::string(word) + found->dump();
  return text;
}

std::optional<Found> found_by(const FigureRow& row, const Json& from) {
  std::optional<double> value = number_at(from, row.value);
  if (!value) value = sum_of_parts(from, row);
  if (!value) return {};
  const double whole = *row.divisor == '\0' ? row.unit : number_at(from, row.divisor).value_or(0.0);
  if (!(whole > 0.0)) return {};  // a share of nothing
  return Found{{*value, whole}, worst_location(from, row)};
}

const FigureRow* row_at_samples(const std::string& figure) {
  const auto* const row = std::ranges::find(k_rows_at_samples, figure, &FigureRow::name);
  return row == std::end(k_rows_at_samples) ? nullptr : row;
}

// Of several sets the one where it is largest: what is lacking in one is not made up for in another. Overshade of sets
// that have weights is that of all of them, as a frame shades them.
std::optional<Found> found_at_samples(const Json& result_case, const FigureRow& row,
                                      const std::vector<std::string>& sets, bool is_of_ranking) {
  std::optional<Found> most;
  if (is_of_ranking && row.name == std::string_view("overshade") &&
      value_at(result_case, "/cost/overshade") != nullptr) {
    const std::optional<double> weighted = number_at(result_case, "/cost/overshade");
    const Json* is_lit = value_at(result_case, "/cost/lit");  // older results have the ratio beside a false one
    if (!weighted || (is_lit != nullptr && *is_lit == false)) return {};
    return Found{{*weighted, 1.0}, words_of_sets(sets), joined(sets)};
  }
  for (const std::string& set : sets) {
    const Json* counts = samples_of_set(result_case, set);
    if (counts == nullptr) continue;
    // Where no light reaches a set, none is unlit, and as many are needed: 0.
    if (number_at(*counts, "/needed") == 0.0 && row.name != std::string_view("needed")) continue;
    std::optional<Found> found = found_by(row, *counts);
    if (!found || (most && most->value() >= found->value())) continue;
    found->location = words_of_set(set) + (found->location.empty() ? "" : ", ") + found->location;
    found->samples = joined(sets);
    most = std::move(found);
  }
  return most;
}

std::optional<Found> found_in(const Json& result_case, const std::string& name) {
  const config::FigureAtSamples parts = config::figure_at_samples(name);
  if (const FigureRow* row = row_at_samples(parts.figure))
    return parts.set.empty() ? found_at_samples(result_case, *row, ranking_set_names(result_case), true)
                             : found_at_samples(result_case, *row, {parts.set}, false);
  for (const FigureRow& row : k_figure_rows)
    if (row.name == name)
      if (std::optional<Found> found = found_by(row, result_case)) return found;
  return {};
}

// Why a case may lack a figure.
std::string reason_for_none(const std::string& figure) {
  const auto row = std::find_if(std::begin(k_figure_rows), std::end(k_figure_rows),
                                [&](const FigureRow& candidate) { return candidate.name == figure; });
  const std::string_view pointer = row == std::end(k_figure_rows) ? "" : row->value;
  if (pointer.starts_with("/timing/")) return " (--no-timing or timing.measure: false leaves times out)";
  if (const config::FigureAtSamples parts = config::figure_at_samples(figure); row_at_samples(parts.figure)) {
    const std::string without = parts.set.empty() || parts.set == "volume"
                                    ? "shading.samples: 0 leaves them out, and methods of visible surfaces have none"
                                    : "samples." + parts.set + ": {} takes such samples";
    if (parts.figure == "overshade")
      return " (there is none where more than 0.1 % of the lights are unlit or fewer than 100 reach the samples; " +
             without + ")";
    return " (no light reaches the samples; " + without + ")";
  }
  if (pointer.starts_with("/error/"))
    return " (accuracy.check: false leaves errors out; structures without cells have none)";
  if (pointer.starts_with("/count/")) return " (--count counts instructions)";
  if (pointer.starts_with("/lights")) return " (a result of an older version tells none)";
  if (pointer.starts_with("/occupancy/")) return " (structures without cells have none)";
  return "";
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
  void add(const Json& result_case, const std::string& sentence) {
    auto said = std::ranges::find(said_, sentence, &Said::sentence);
    if (said == said_.end()) said = said_.insert(said_.end(), {sentence, result_case["name"].get<std::string>(), 0});
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
  RuleCheck(const Json& result, const config::LimitRule& rule, const BaselineCases* baseline, LimitFindings& findings)
      : rule_(rule), quoted_("'" + rule.text() + "'"), baseline_(baseline), findings_(findings) {
    const Pattern pattern(rule.cases, "");
    for (const Json& result_case : result["cases"])
      if (is_selected(pattern, result_case)) cases_.push_back(&result_case);
  }

  void check(const Json& result) {
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
  void add_none(const Json& result) {
    std::vector<std::string> names;
    for (const Json& result_case : result["cases"]) names.push_back(result_case["name"].get<std::string>());
    findings_.broken.push_back(quoted_ + " could not be checked: " +
                               (names.empty() ? "there is no case"
                                              : "its '" + rule_.cases + "' matches no case's name" +
                                                    pattern_hint(rule_.cases) + "; there are: " + listed_names(names)));
  }

  void check_values() {
    std::vector<std::string> without;
    for (const Json* result_case : cases_) {
      bool has_none = true;
      for (const std::string& figure : figures_of({result_case}))
        if (const std::optional<Found> found = found_in(*result_case, figure)) {
          has_none = false;
          judge(*result_case, rule_.is_broken_by(found->value()), found->value(), is_text(rule_, *found));
        }
      if (has_none) without.push_back((*result_case)["name"].get<std::string>());
    }
    add_without(without);
  }

  // Of lights needed at several sets each by itself: what one of them has lost the largest one would hide. Sets of now
  // and before.
  std::vector<std::string> figures_of(const std::vector<const Json*>& cases) const {
    if (rule_.figure != "needed") return {rule_.figure};
    std::vector<std::string> figures;
    for (const Json* result_case : cases)
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
    std::vector<std::string> not_in_base, without;
    std::string obstacle;
    for (const Json* result_case : cases_) {
      const std::string name = (*result_case)["name"].get<std::string>();
      const Json* before = baseline_->case_of(*result_case);
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
      if (has_none || lacks_one) without.push_back(name);
    }
    add_unmatched(not_in_base, without, obstacle);
  }

  void judge_change(const Json& result_case, const Found& now, const Found& then) {
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
    for (const Json* base_case : baseline_->gone_cases())
      if (is_selected(pattern, *base_case)) gone.push_back((*base_case)["name"].get<std::string>());
    if (!gone.empty())
      findings_.broken.push_back(begin + " for " + number_of(gone.size(), "case") + " of " + baseline_->name() +
                                 " that this result does not have: " + listed_names(gone) +
                                 "; measure the baseline again, or name cases before a colon");
  }

  bool is_instructions() const { return rule_.figure.ends_with("instructions"); }

  void judge(const Json& result_case, bool is_broken, double value, const std::string& text) {
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
  std::vector<const Json*> cases_;
  SaidOfCases broken_, near_;
};

// What stands between a relative budget and its baseline beside the figure itself, each answer once.
void add_changes_since(const Json& result, const BaselineCases& baseline, LimitFindings& findings) {
  std::map<std::string, std::vector<std::string>> names;
  for (const Json& result_case : result["cases"])
    if (const std::string changes = baseline.what_changed(result_case); !changes.empty())
      names[changes].push_back(result_case["name"].get<std::string>());
  for (const auto& [changes, changed_cases] : names)
    findings.warnings.push_back("changed since " + baseline.name() + " (" + number_of(changed_cases.size(), "case") +
                                "): " + changes + "; " + listed_names(changed_cases));
}

}  // namespace

std::optional<double> limit_figure(const Json& result_case, const std::string& name) {
  const std::optional<Found> found = found_in(result_case, name);
  return found ? std::optional(found->value()) : std::nullopt;
}

std::string limit_figure_location(const Json& result_case, const std::string& name) {
  const std::optional<Found> found = found_in(result_case, name);
  return found ? found->location : "";
}

LimitFindings limit_findings(const Json& result, std::span<const config::LimitRule> rules,
                             const BaselineCases* baseline) {
  LimitFindings findings;
  for (const config::LimitRule& rule : rules) RuleCheck(result, rule, baseline, findings).check(result);
  const bool is_relative = std::ranges::any_of(rules, [](const config::LimitRule& rule) { return rule.is_relative; });
  if (is_relative && baseline != nullptr) add_changes_since(result, *baseline, findings);
  return findings;
}

}  // namespace clusterbench::report
