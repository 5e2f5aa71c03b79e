#pragma once
// The answers of `recommend` as a document and as text.

#include <string>
#include <vector>

#include "config/config.h"
#include "report/choosing/question.h"
#include "result/documents/recommendation.h"

namespace clusterbench::report {

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

}  // namespace clusterbench::report
