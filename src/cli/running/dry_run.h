#pragma once
// `run --dry-run`: the plan, without measuring.

#include "cli/running/run_flags.h"
#include "config/config.h"
#include "run/cases/plan.h"

namespace clusterbench::cli {

// Prints the id and name of each case that is left to measure, skipped cases with the reason, the estimated duration,
// and the warnings of the scenes. Writes no file. Throws Error as finished_ids() does.
void print_plan(const RunFlags& flags, const config::Config& config, run::Plan plan);

}  // namespace clusterbench::cli
