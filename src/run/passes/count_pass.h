#pragma once
// Instructions of the work that the timing pass times, over the same frames.

#include <atomic>
#include <functional>
#include <map>

#include "run/cases/plan.h"
#include "run/counters/instruction_counter.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

// By the case's id.
using Counts = std::map<std::string, CountResult>;

// Counts the cases of the plan for which `is_wanted` is true; everything runs once before it is counted, so that memory
// has grown. Throws Error for a method on several threads if the counter sees only one. `on_case` gets each case as
// soon as it is counted. `stop` is checked between methods.
void count_pass(const config::Config& config, const Plan& plan, const std::function<bool(const CasePlan&)>& is_wanted,
                InstructionCounter& counter, const std::function<void(const CasePlan&, const CountResult&)>& on_case,
                const std::atomic<bool>& stop);

}  // namespace clusterbench::run
