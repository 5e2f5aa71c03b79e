#pragma once
// The counts of a case as its result: everything except times, instructions, stability and details.

#include "run/cases/plan.h"
#include "run/findings/run_result.h"
#include "run/passes/accuracy_pass.h"

namespace clusterbench::run {

// `index`: index of the case in the counted group. `frames`: number of counted frames.
CaseResult case_result(const config::Config& config, const Plan& whole, const CasePlan& plan, int frames,
                       const AccuracyResult& counted, std::size_t index);

}  // namespace clusterbench::run
