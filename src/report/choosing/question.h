#pragma once
// The question of `recommend`: the figure to make smallest, and the constraints of candidates.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/limit_rules.h"
#include "result/case.h"
#include "result/figures/figure_table.h"
#include "search/recommend.h"

namespace clusterbench::report {

// The figures that a choice can make smallest.
std::vector<const result::Figure*> objective_figures();

struct Constraint {
  config::LimitRule rule;
  bool is_given = true;  // false: applies unless another constraint on its figure is given
};
// The constraints of the configuration's and the command line's budgets; and that no light is missed, dropped or unlit.
std::vector<Constraint> constraints_of(const std::vector<config::LimitRule>& given);
bool needs_times(const result::Figure& objective, const std::vector<Constraint>& constraints);

struct Question {
  const result::Figure* objective = nullptr;
  std::vector<Constraint> constraints;
  double within = 0.05;
  int runners_up = 5;
};

// Evaluates cases as in a result. Over several cameras a figure is the maximum for high-water marks, the sum for
// counts, else the mean weighted by frames; a constraint must hold for each camera. The index after the question's
// constraints stands for a case that a run would fail for, the next one for a method that could lose lights elsewhere,
// unless the question allows losses.
search::Evaluate judge_of(const Question& question, const nlohmann::json& config);

// The cases as a result has them, with their modelled costs.
std::vector<result::Case> records_of(std::span<const run::CaseResult> cases, const nlohmann::ordered_json& config);

// The constraints in words: the question's, then the four that always hold, in the order of a verdict.
std::vector<std::string> constraint_texts(const Question& question);

// A loss of lights at samples: there is none where no sample needs a light. Other figures of samples are unknown where
// there are no samples.
bool is_loss(const result::Figure& figure);

// Whether a candidate that was measured on some frames can satisfy all constraints on more frames: each one that it
// breaks can still hold.
bool may_hold_on_more_frames(const Question& question, const search::Verdict& verdict);

// Whether the objective needs samples: a modelled cost, or a figure of samples.
bool rests_on_samples(const result::Figure& objective);

}  // namespace clusterbench::report
