#pragma once
// What `recommend` asks of cases, and its answer as JSON, as text and as a configuration.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/limit_rules.h"
#include "result/figure_table.h"
#include "search/recommend.h"

namespace clusterbench::report {

inline constexpr int k_recommendation_version = 1;

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

// One answer: docs/recommend.md, `clusterbench schema recommendation`.
nlohmann::ordered_json answer_to_json(const config::Config& config, const run::Plan& plan, const search::View& view,
                                      const search::Found& found, const Question& question);
// All answers of one configuration.
nlohmann::ordered_json recommendation_to_json(const config::Config& config, const Question& question,
                                              const nlohmann::ordered_json& answers);
// `next`: a line that stands before the conclusions, what to do with the choice; ""
std::string recommendation_text(const nlohmann::ordered_json& recommendation, const std::string& next = "");
// Of a search that was stopped: the candidates that were measured on the most frames and break nothing there, the best
// first.
std::string unfinished_text(const search::View& view, const search::Found& found, const Question& question);

// Whether each answer has a choice.
bool all_satisfied(const nlohmann::ordered_json& recommendation);

// A configuration with which `run` measures the choice, and the first `runners_up` after it. It is one product of
// grids, assigners and storages, so it may contain more cases. `file`: its future path. Throws Error if there is no
// choice.
nlohmann::ordered_json recommended_config(const config::Config& config, const search::View& view,
                                          const nlohmann::ordered_json& answer, const Question& question,
                                          int runners_up, const std::string& file);

}  // namespace clusterbench::report
