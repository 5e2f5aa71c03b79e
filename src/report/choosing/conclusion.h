#pragma once
// The recommendation by a result: a clustering, the alternative it is compared with, the difference, and the
// confidence. The same words end the table, begin the page and are in the result (`conclusions`).

#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

// One for each scene, camera and viewport. Recommends a case of `pareto_front` with the least cost: its frame time with
// upload, reading and shading by the model of config.cost; the frame time if no samples were requested; without times
// the modelled cost. Of cases whose times are not distinguishable it is the one with the fewest bytes. Presets have
// their own ranking and are not included. `result`: scenes, cases and pareto_front; `origin`: config.
std::vector<result::Conclusion> conclusions_of(const result::Result& result, const result::Result& origin);

// The reasons of a failed run, a line each: the failures of its cases, and `failed`.
std::vector<std::string> run_failures(const result::Result& result);

// For a failed run, removes all recommendations of cases and presets; the texts give the reasons. Adds `failures` to
// the result's `failed`, for failures that are not of a single case: budgets, lights, a baseline.
void conclude_failures(result::Result& result, const std::vector<std::string>& failures);

// "none, since the run FAILED: ..." for such a result.
std::string failed_conclusion(const result::Result& result);

// The names of recommended cases, each once, over all cameras.
std::vector<std::string> taken_names(const result::Result& result);
// The --filter that selects the cases of such a name, and no others of the result: the name itself, or where it is a
// part of other names, too, an expression that ends with it.
std::string filter_of(const std::string& taken, const result::Result& result);

// Lines that begin with "conclusion: ", the last ones of a run; "" if the result has none.
std::string conclusions_text(const result::Result& result);

}  // namespace clusterbench::report
