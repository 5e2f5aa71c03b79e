#pragma once
// The recommendation of an answer of `recommend`, in the words of conclusion.h.

#include <optional>
#include <string>

#include "result/documents/recommendation.h"

namespace clusterbench::report {

// Nothing where it has no such figure.
std::optional<double> candidate_figure(const result::Candidate& candidate, const std::string& name);

// "nothing to recommend: no light is in view in any frame" of an answer of `recommend` for which that is so; else "".
std::string text_of_nothing_seen(const result::Answer& answer);

// Of one answer of `recommend`, in the same form; `objective`: the recommendation's.
std::string answer_conclusion(const result::Answer& answer, const result::Objective& objective);

}  // namespace clusterbench::report
