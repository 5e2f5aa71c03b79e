#pragma once
// What to do by a result: which clustering to take, against which other, by how much, and how sure that is. The same
// words end the table, begin the page and stand in the result (`conclusions`).

#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

// One for each scene, camera and viewport. Taken is a case of the front `pareto_front` that costs least: its frame time
// with upload, reading and shading by the model of config.cost; the frame time where no sample was asked for; without
// times what is modelled. Of those that the times cannot tell apart it is the one with the fewest bytes. Presets are
// ranked by themselves and are not among them. `result`: scenes, cases and pareto_front; `origin`: config.
std::vector<result::Conclusion> conclusions_of(const result::Result& result, const result::Result& origin);

// What a result's run failed for, a line each: the failures of its cases, and `failed`.
std::vector<std::string> run_failures(const result::Result& result);

// Where the run failed, nothing is taken: neither a case nor a preset, and the texts say what failed. Adds `failures`
// to the result's `failed`, which has what is no case's own: budgets, lights, a baseline.
void conclude_failures(result::Result& result, const std::vector<std::string>& failures);

// "none, since the run FAILED: ..." of such a result.
std::string failed_conclusion(const result::Result& result);

// What its conclusions take, each once and of all cameras: names that --filter takes.
std::vector<std::string> taken_names(const result::Result& result);

// Lines that begin with "conclusion: ", the last ones of a run; "" where the result has none.
std::string conclusions_text(const result::Result& result);

}  // namespace clusterbench::report
