#pragma once
// What was counted of a case, as its result: all but times, instructions, stability and details.

#include "run/cases/sweep.h"
#include "run/findings/run_result.h"
#include "run/passes/accuracy_pass.h"

namespace clusterbench::run {

// `index`: the case's in the group that was counted. `frames`: how many frames it was counted over.
CaseResult case_result(const config::Config& config, const Plan& whole, const CasePlan& plan, int frames,
                       const AccuracyResult& counted, std::size_t index);

}  // namespace clusterbench::run
