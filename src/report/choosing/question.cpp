#include "report/choosing/question.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/samples/shading.h"
#include "report/cases/case_costs.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "report/cases/json_values.h"
#include "result/at.h"
#include "result/figures/case_figure.h"
#include "result/sample_sets.h"
#include "run/findings/gate.h"
#include "run/records/records.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::Figure;

// Lights that no surface of the path needs may be needed by moving objects.
constexpr const char* k_unlit_in_view = "volume.unlit";

// Whether a broken constraint stays broken with more frames: marks and counts only grow, and a share above 0 stays
// above 0.
bool stays_broken(const config::LimitRule& rule) {
  const Figure& figure = *result::figure_named(rule.figure);
  return figure.only_grows ||
         (rule.limit == 0.0 && figure.better == result::Better::smaller && !figure.rests_on_times());
}

bool has_such_samples(const Case& result_case, const std::string& figure) {
  const std::string set = result::figure_at_samples(figure).set;
  return set.empty() ? !ranking_set_names(result_case).empty() : samples_of_set(result_case, set) != nullptr;
}

// A count over the samples of a figure: "opaque.unlit" is of one set, "unlit" of those that rank.
double sum_at_samples_of(const std::string& figure, const Case& result_case, result::SampleFigure count) {
  const std::string set = result::figure_at_samples(figure).set;
  if (set.empty()) return sum_at_samples(result_case, count);
  const result::SampleSet* counts = samples_of_set(result_case, set);
  return counts == nullptr ? 0.0 : count(*counts).value_or(0.0);
}

bool sees_samples(const std::vector<Case>& cases, const std::string& figure) {
  return std::ranges::any_of(cases, [&](const Case& result_case) {
    return sum_at_samples_of(figure, result_case, result::number<&result::SampleSet::samples>) > 0.0;
  });
}

// Whether no camera has a sample of the figure, and it is no loss: only further frames can have such samples.
bool is_unknown(const std::vector<Case>& cases, const std::string& name) {
  const Figure& figure = *result::figure_named(name);
  return figure.is_at_samples() && !is_loss(figure) && !sees_samples(cases, name) &&
         std::ranges::all_of(cases, [&](const Case& result_case) { return has_such_samples(result_case, name); });
}

// Whether a camera cannot break a limit on a figure of samples although it has no value: it sees no surface, or no
// light reaches what it sees. Then it loses no light, and has no part in the means of the other cameras.
bool holds_without_value(const Case& result_case, const std::string& name) {
  const Figure& figure = *result::figure_named(name);
  if (!figure.is_at_samples() || !has_such_samples(result_case, name)) return false;
  const auto sum = [&](result::SampleFigure count) { return sum_at_samples_of(name, result_case, count); };
  return sum(result::number<&result::SampleSet::samples>) == 0.0 ||
         (is_loss(figure) && sum(result::number<&result::SampleSet::needed>) == 0.0);
}

// The largest figure that breaks a constraint; none if it holds. A given constraint on a figure that a case does not
// have (a structure without lists has no longest one) is not satisfied: NaN.
std::optional<double> breaking_figure(const std::vector<Case>& cases, const Constraint& constraint) {
  std::optional<double> largest;
  for (const Case& result_case : cases) {
    const std::optional<double> value = figure_of(result_case, constraint.rule.figure);
    if (!value && holds_without_value(result_case, constraint.rule.figure)) continue;
    if (!value && constraint.is_given) return std::numeric_limits<double>::quiet_NaN();
    if (!constraint.is_given && constraint.rule.figure == k_unlit_in_view &&
        ranking_set_names(result_case) == std::vector<std::string>{"volume"})
      continue;
    if (value && constraint.rule.is_broken_by(*value)) largest = std::max(*value, largest.value_or(*value));
  }
  return largest;
}

// Whether a run would fail for it, or it is cheaper because it misses lights.
bool fails(const std::vector<Case>& cases, bool is_cost) {
  return std::ranges::any_of(cases, [&](const Case& result_case) {
    return !result_case.failures.empty() || (is_cost && result_case.cost && !result_case.cost->lit);
  });
}

// Whether it fails for a reason that stays with more frames: counts of pairs only grow, and a method without samples in
// the view has none in any frame. Lights lost at samples can be held against a share, which can fall.
bool stays_failed(const std::vector<Case>& cases, bool is_cost) {
  const std::string_view at_samples = run::name_of(run::Failure::Kind::lost_at_samples);
  const auto stays = [&](const result::Failure& failure) { return failure.kind != at_samples; };
  const auto is_unlit = [](const result::SampleSet* set) { return set->unlit > measure::k_most_unlit; };
  return std::ranges::any_of(cases, [&](const Case& result_case) {
    const bool lacks_a_set = is_cost && result_case.cost && !result_case.cost->lit &&
                             std::ranges::none_of(ranking_samples(result_case), is_unlit);
    return lacks_a_set || std::ranges::any_of(result_case.failures, stays);
  });
}

std::string rule_text_of(const config::LimitRule& rule) {
  if (rule.limit == 0.0 && !rule.is_inclusive) return rule.figure + " = 0";
  return rule.figure + (rule.is_inclusive ? " < " : " <= ") + amount_text(rule.limit);
}

// If the question allows lost lights, methods that can lose lights are allowed.
bool takes_sound_methods_only(const Question& question) {
  return std::ranges::none_of(question.constraints, [](const Constraint& constraint) {
    return constraint.is_given && constraint.rule.figure == "unlit";
  });
}

// Methods that draw lights have no lists whose size, time or reads could be compared: only costs of pixels rank them.
bool takes_what_draws(const Question& question) {
  return rests_on_samples(*question.objective) && question.objective->name != "read_bytes";
}

// Whether a constraint (an index of constraint_texts()) that is broken by a figure (NaN: it has none) on some frames
// can hold on more frames.
bool may_hold(const Question& question, std::size_t constraint, double by) {
  const std::size_t count = question.constraints.size();
  if (constraint == count + 3) return rests_on_samples(*question.objective);
  if (constraint >= count) return constraint == count;  // the others are of the method
  const config::LimitRule& rule = question.constraints[constraint].rule;
  return std::isnan(by) ? result::is_at_samples(rule.figure) : !stays_broken(rule);
}

}  // namespace

std::vector<const Figure*> objective_figures() {
  std::vector<const Figure*> all;
  for (const Figure& figure : result::figures())
    if (figure.is_choosable) all.push_back(&figure);
  return all;
}

std::vector<Constraint> constraints_of(const std::vector<config::LimitRule>& given) {
  std::vector<Constraint> all;
  for (const config::LimitRule& rule : given) all.push_back({rule, true});
  const auto is_given = [&](const std::string& figure) {
    return std::ranges::find(given, figure, &config::LimitRule::figure) != given.end();
  };
  for (const char* figure : {"missed", "dropped", "unlit"})
    if (!is_given(figure)) all.push_back({{figure, false, 0.0}, false});
  if (!is_given("unlit") && !is_given(k_unlit_in_view)) all.push_back({{k_unlit_in_view, false, 0.0}, false});
  return all;
}

bool needs_times(const Figure& objective, const std::vector<Constraint>& constraints) {
  return objective.rests_on_times() || std::ranges::any_of(constraints, [](const Constraint& constraint) {
           return result::figure_named(constraint.rule.figure)->rests_on_times();
         });
}

std::vector<std::string> constraint_texts(const Question& question) {
  std::vector<std::string> texts;
  for (const Constraint& constraint : question.constraints) texts.push_back(rule_text_of(constraint.rule));
  texts.emplace_back("a run of it does not fail");
  texts.emplace_back("conservative or exact (--unlit allows others)");
  texts.emplace_back("has lists (methods that draw lights are ranked by cost alone)");
  texts.emplace_back("a known " + std::string(question.objective->name) + " on these frames");
  return texts;
}

bool may_hold_on_more_frames(const Question& question, const search::Verdict& verdict) {
  if (verdict.is_final) return false;
  for (std::size_t i = 0; i < verdict.broken.size(); ++i)
    if (!may_hold(question, verdict.broken[i], verdict.broken_by[i])) return false;
  return true;
}

std::vector<Case> records_of(std::span<const run::CaseResult> cases, const nlohmann::ordered_json& config) {
  std::vector<Case> out;
  for (const run::CaseResult& case_result : cases) out.push_back(run::record_of(case_result));
  add_costs(out, config);
  return out;
}

bool is_loss(const Figure& figure) {
  return figure.samples.is_of_needed && figure.name != "overshade";
}

bool rests_on_samples(const Figure& objective) {
  return objective.is_modelled_cost || objective.is_at_samples();
}

search::Evaluate judge_of(const Question& question, const nlohmann::json& config) {
  return [question, resolved = nlohmann::ordered_json(config)](std::span<const run::CaseResult> results) {
    const std::vector<Case> cases = records_of(results, resolved);
    search::Verdict verdict;
    verdict.objective = result::figure_over(cases, std::string(question.objective->name))
                            .value_or(std::numeric_limits<double>::quiet_NaN());
    verdict.bytes = result::figure_over(cases, "bytes").value_or(0.0);
    for (std::size_t i = 0; i < question.constraints.size(); ++i) {
      const config::LimitRule& rule = question.constraints[i].rule;
      if (question.constraints[i].is_given && is_unknown(cases, rule.figure)) verdict.unknown.push_back(i);
      const std::optional<double> by = breaking_figure(cases, question.constraints[i]);
      if (!by) continue;
      verdict.broken.push_back(i);
      verdict.broken_by.push_back(*by);
      verdict.is_final = verdict.is_final || (!std::isnan(*by) && stays_broken(rule));
    }
    const auto break_by_no_figure = [&](std::size_t constraint) {
      verdict.broken.push_back(constraint);
      verdict.broken_by.push_back(std::numeric_limits<double>::quiet_NaN());
    };
    if (verdict.broken.empty() && fails(cases, question.objective->is_modelled_cost))
      break_by_no_figure(question.constraints.size());
    verdict.is_final = verdict.is_final || stays_failed(cases, question.objective->is_modelled_cost);
    if (takes_sound_methods_only(question) && !std::ranges::all_of(results, run::is_sound)) {
      break_by_no_figure(question.constraints.size() + 1);
      verdict.is_final = true;
    }
    if (!takes_what_draws(question) && std::ranges::any_of(cases, draws_lights)) {
      break_by_no_figure(question.constraints.size() + 2);
      verdict.is_final = true;
    }
    if (verdict.broken.empty() && !std::isfinite(verdict.objective))
      break_by_no_figure(question.constraints.size() + 3);
    return verdict;
  };
}

}  // namespace clusterbench::report
