#pragma once
// The recommendation of an answer of `recommend`, in the words of conclusion.h.

#include <optional>
#include <string>

#include "result/documents/recommendation.h"

namespace clusterbench::report {

// None if it has no such figure.
std::optional<double> candidate_figure(const result::Candidate& candidate, const std::string& name);

// "nothing to recommend: no light is in view in any frame" for an answer of `recommend` without a basis; else "".
std::string text_of_nothing_seen(const result::Answer& answer);

// For one answer of `recommend`, in the same form; `objective`: the recommendation's.
std::string answer_conclusion(const result::Answer& answer, const result::Objective& objective);

}  // namespace clusterbench::report
