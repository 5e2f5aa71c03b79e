#pragma once
// What to do by a result: which clustering to take, against which other, by how much, and how sure that is. The same
// words end the table, begin the page and stand in the result (`conclusions`).

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace clusterbench::report {

// One for each scene, camera and viewport: {"scene", "camera", "viewport", "take": id or null, "against": id or null,
// "ratio": how many times as long that takes or null, "ci95": of it or null, "alike": ids, "text"}. Taken is a case of
// the front `pareto_front` that costs least: its frame time with upload, reading and shading by the model of
// config.cost; the frame time where no sample was asked for; without times what is modelled. Of those that the times
// cannot tell apart it is the one with the fewest bytes. Presets are ranked by themselves and are not among them.
// `result`: scenes, cases and pareto_front; `origin`: config.
nlohmann::ordered_json conclusions_of(const nlohmann::ordered_json& result, const nlohmann::ordered_json& origin);

// What a result's run failed for, a line each: the failures of its cases, and `failed`.
std::vector<std::string> run_failures(const nlohmann::ordered_json& result);

// Where the run failed, nothing is taken: neither a case nor a preset, and the texts say what failed. Adds `failures`
// to the result's `failed`, which has what is no case's own: budgets, lights, a baseline.
void conclude_failures(nlohmann::ordered_json& result, const std::vector<std::string>& failures);

// "none, since the run FAILED: ..." of such a result.
std::string failed_conclusion(const nlohmann::ordered_json& result);

// What its conclusions take, each once and of all cameras: names that --filter takes.
std::vector<std::string> taken_names(const nlohmann::ordered_json& result);

// Lines that begin with "conclusion: ", the last ones of a run; "" where the result has none.
std::string conclusions_text(const nlohmann::ordered_json& result);

// "nothing to recommend: no light is in view in any frame" of an answer of `recommend` for which that is so; else "".
std::string text_of_nothing_seen(const nlohmann::ordered_json& answer);

// Of one answer of `recommend`, in the same form; `objective`: the recommendation's.
std::string answer_conclusion(const nlohmann::ordered_json& answer, const nlohmann::ordered_json& objective);

}  // namespace clusterbench::report
