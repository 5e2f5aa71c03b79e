#include "report/gates/limits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "core/pattern.h"
#include "core/text.h"
#include "report/cases/case_filter.h"
#include "report/cases/case_samples.h"
#include "report/cases/percent_change.h"
#include "report/gates/baseline_cases.h"
#include "result/at.h"
#include "result/figures/case_figure.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::FigureValue;

std::string listed_names(const std::vector<std::string>& names) {
  constexpr std::size_t k_most = 3;
  const std::size_t shown_names = std::min(names.size(), k_most);
  return joined(std::span(names).first(shown_names)) + (names.size() > k_most ? " ..." : "");
}

std::string is_text(const config::LimitRule& rule, const FigureValue& found) {
  return rule.figure + " is " + config::budget_number(found.value()) +
         (found.location.empty() ? "" : " (" + found.location + ")");
}

// Sentences on cases, each once: figures of a scene or of a view are equal for many cases.
class SentencesOfCases {
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

// One budget, checked for the cases that it names.
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
        if (const std::optional<FigureValue> found = figure_value(*result_case, figure)) {
          has_none = false;
          const bool is_broken = rule_.is_broken_by(found->value());
          if (!add_cut_lists(*result_case, found->value(), is_broken))
            add_verdict(*result_case, is_broken, found->value(), is_text(rule_, *found));
        }
      if (has_none) without.push_back(result_case->name);
    }
    add_without(without);
  }

  // Lists that a method makes with room for some lights alone are no longer than that, however many lights a cell has:
  // only that they are too long, or long enough, is certain. False if the budget can be checked all the same.
  bool add_cut_lists(const Case& result_case, double longest, bool is_broken) {
    using Side = config::LimitRule::Side;
    const std::uint64_t dropped = result_case.buffers.overflow.dropped_pairs;
    const bool is_certain =
        !rule_.is_relative && ((rule_.side == Side::above && is_broken) || (rule_.side == Side::below && !is_broken));
    if (rule_.figure != "longest" || is_certain || result_case.storage != run::k_own_structure || dropped == 0)
      return false;
    findings_.broken.push_back(quoted_ + " could not be checked for " + shown(result_case.name) +
                               ": its lists end at " + config::budget_number(longest) +
                               " since the method itself dropped " + number_of(dropped, "pair") +
                               "; hold dropped, and see `clusterbench size`");
    return true;
  }

  // With several sets, needed lights are checked set by set: the largest set would hide a loss in another. Includes the
  // sets of now and before.
  std::vector<std::string> figures_of(const std::vector<const Case*>& cases) const {
    if (rule_.figure != "needed") return {rule_.figure};
    std::vector<std::string> figures;
    for (const Case* result_case : cases)
      for (const std::string& set : ranking_set_names(*result_case))
        if (const std::string figure = set + ".needed"; std::ranges::find(figures, figure) == figures.end())
          figures.push_back(figure);
    return figures.size() > 1 ? figures : std::vector{rule_.figure};
  }

  // A budget that names cases must apply to all of them; one for all cases applies to those that can have the figure.
  void add_without(const std::vector<std::string>& without) {
    const std::string hint = result::why_no_figure(rule_.figure);
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
    std::string obstacle, other_setting;
    for (const Case* result_case : cases_) {
      const std::string& name = result_case->name;
      const Case* before = baseline_->case_of(*result_case);
      if (before == nullptr) {
        not_in_base.push_back(name);
        continue;
      }
      const std::string why = is_of_instructions() ? baseline_->obstacle_to_instructions(*result_case) : "";
      bool has_none = true, lacks_one = false;
      for (const std::string& figure : figures_of({result_case, before})) {
        const std::optional<FigureValue> now = figure_value(*result_case, figure), then = figure_value(*before, figure);
        has_none = has_none && !now && !then;
        if (!now || !then)
          lacks_one = lacks_one || now || then;
        else if (!why.empty())
          obstacle = why;
        else if (const std::string setting = setting_that_differs(*now); !setting.empty())
          other_setting = setting;
        else if (samples_of(*result_case, *now) != samples_of(*before, *then))
          add_other_samples(name, samples_of(*result_case, *now), samples_of(*before, *then));
        else if (!add_cut_lists(*result_case, now->value(), false) && !add_cut_lists(*before, then->value(), false))
          add_verdict_on_change(*result_case, *now, *then);
      }
      if (has_none) without.push_back(name);
      if (lacks_one) in_one.push_back(name);
    }
    if (!in_one.empty())
      findings_.broken.push_back(quoted_ + " could not be checked for " + number_of(in_one.size(), "case") +
                                 ", since only one of this result and " + baseline_->name() + " has " + rule_.figure +
                                 result::why_no_figure(rule_.figure) + ": " + listed_names(in_one));
    if (!other_setting.empty())
      findings_.broken.push_back(quoted_ + " could not be checked: " + other_setting + "; measure the baseline again");
    add_unmatched(not_in_base, without, obstacle);
  }

  // A setting that the figure follows and that is another one in the baseline; "" if there is none. Means over several
  // sets of samples follow the sets' weights.
  std::string setting_that_differs(const FigureValue& now) const {
    const result::Figure& figure = *result::figure_named(rule_.figure);
    if (figure.is_modelled_cost) return baseline_->other_prices();
    if (figure.name.ends_with("_recommended")) return baseline_->other_margin();
    const bool has_sets = now.samples.find(',') != std::string::npos;
    const bool is_mean = figure.samples.over == result::OverSets::mean || figure.name == "overshade";
    return has_sets && is_mean ? baseline_->other_weights() : "";
  }

  // The names of the sets of samples that a figure is of; a modelled cost is of those with a weight.
  std::string samples_of(const Case& result_case, const FigureValue& value) const {
    if (!result::figure_named(rule_.figure)->is_modelled_cost || !result_case.cost) return value.samples;
    std::vector<std::string> names;
    for (const auto& [name, set] : result_case.cost->sets) names.push_back(name);
    return joined(names);
  }

  void add_verdict_on_change(const Case& result_case, const FigureValue& now, const FigureValue& then) {
    const double percent = percent_change(then.quotient, now.quotient);
    const std::string change =
        std::isfinite(percent) ? percent_text(percent, rule_.limit) + " against " : std::string("was ");
    add_verdict(result_case, is_broken_by_change(rule_, then.quotient, now.quotient), percent,
                is_text(rule_, now) + ", " + change + config::budget_number(then.value()) + " in " + baseline_->name());
  }

  void add_other_samples(const std::string& name, const std::string& now, const std::string& then) {
    const std::string hint = result::is_at_samples(rule_.figure) ? "; name one set, as in 'volume." + rule_.figure + "'"
                                                                 : "; measure the baseline again";
    findings_.broken.push_back(quoted_ + " could not be checked for " + name + ": " + rule_.figure +
                               " is at samples of " + now + " here and of " + then + " in " + baseline_->name() + hint);
  }

  void add_unmatched(const std::vector<std::string>& not_in_base, const std::vector<std::string>& without,
                     const std::string& obstacle) {
    const std::string begin = quoted_ + " could not be checked";
    if (!not_in_base.empty())
      findings_.broken.push_back(
          begin + " for " + number_of(not_in_base.size(), "case") + " that " + baseline_->name() +
          " does not have (of that camera, viewport, grid, method and structure): " + listed_names(not_in_base) +
          "; measure the baseline again, or name cases before a colon");
    const std::string hint = result::why_no_figure(rule_.figure);
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

  bool is_of_instructions() const { return result::figure_named(rule_.figure)->basis == result::Basis::instructions; }

  void add_verdict(const Case& result_case, bool is_broken, double value, const std::string& text) {
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
  SentencesOfCases broken_, near_;
};

// Changes since the baseline, other than the figure itself, that affect a relative budget; each once.
void add_changes_since(const result::Result& result, const BaselineCases& baseline, LimitFindings& findings) {
  std::map<std::string, std::vector<std::string>> names;
  for (const Case& result_case : result.cases)
    if (const std::string changes = baseline.changes_of(result_case); !changes.empty())
      names[changes].push_back(result_case.name);
  for (const auto& [changes, changed_cases] : names)
    findings.warnings.push_back("changed since " + baseline.name() + " (" + number_of(changed_cases.size(), "case") +
                                "): " + changes + "; " + listed_names(changed_cases));
}

}  // namespace

LimitFindings limit_findings(const result::Result& result, std::span<const config::LimitRule> rules,
                             const BaselineCases* baseline) {
  LimitFindings findings;
  for (const config::LimitRule& rule : rules) RuleCheck(result, rule, baseline, findings).check(result);
  const bool is_relative = std::ranges::any_of(rules, [](const config::LimitRule& rule) { return rule.is_relative; });
  if (is_relative && baseline != nullptr) add_changes_since(result, *baseline, findings);
  return findings;
}

}  // namespace clusterbench::report
