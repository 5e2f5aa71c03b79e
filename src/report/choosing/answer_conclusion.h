#pragma once
// The recommendation of an answer of `recommend`, in the words of conclusion.h.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// "nothing to recommend: no light is in view in any frame" of an answer of `recommend` for which that is so; else "".
std::string text_of_nothing_seen(const nlohmann::ordered_json& answer);

// Of one answer of `recommend`, in the same form; `objective`: the recommendation's.
std::string answer_conclusion(const nlohmann::ordered_json& answer, const nlohmann::ordered_json& objective);

}  // namespace clusterbench::report
