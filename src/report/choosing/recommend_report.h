#pragma once
// What `recommend` asks of cases, and its answer as a document, as text and as a configuration.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/limit_rules.h"
#include "result/documents/recommendation.h"
#include "result/figure_table.h"
#include "search/recommend.h"

namespace clusterbench::report {

// The figures that a choice can make smallest.
std::vector<const result::Figure*> objective_figures();

struct Constraint {
  config::LimitRule rule;
  bool is_given = true;  // else it holds unless another one of its figure is given
};
// Those of a configuration's and the command line's budgets; and that no light is missed, dropped or unlit.
std::vector<Constraint> constraints_of(const std::vector<config::LimitRule>& given);
bool needs_times(const result::Figure& objective, const std::vector<Constraint>& constraints);

struct Question {
  const result::Figure* objective = nullptr;
  std::vector<Constraint> constraints;
  double within = 0.05;
  int runners_up = 5;
};

// Judges by the cases as a result has them. Of several cameras a figure is the worst one of high-water marks, the sum
// of counts, else the mean by frames; a constraint holds for each camera. A case that a run would fail for is out,
// under the constraint after the last of the question's; under the one after that a method that could lose lights
// elsewhere, unless the question allows losses.
search::Evaluate judge_of(const Question& question, const nlohmann::json& config);

// One answer: docs/recommend.md.
result::Answer answer_of(const config::Config& config, const run::Plan& plan, const search::View& view,
                         const search::Found& found, const Question& question);
// All answers of one configuration.
result::Recommendation recommendation_of(const config::Config& config, const Question& question,
                                         const std::vector<result::Answer>& answers);
// `next`: a line that stands before the conclusions, what to do with the choice; ""
std::string recommendation_text(const result::Recommendation& recommendation, const std::string& next = "");
// Of a search that was stopped: the candidates that were measured on the most frames and break nothing there, the best
// first.
std::string unfinished_text(const search::View& view, const search::Found& found, const Question& question);

// Whether each answer has a choice.
bool all_satisfied(const result::Recommendation& recommendation);

// What `run` measures the choice with, and the first `runners_up` behind it: they are of one product of grids,
// assigners and storages, and so more cases may come with them. `file`: where it will lie. Throws Error if there is no
// choice.
nlohmann::ordered_json recommended_config(const config::Config& config, const search::View& view,
                                          const result::Answer& answer, const Question& question, int runners_up,
                                          const std::string& file);

}  // namespace clusterbench::report
