#pragma once
// A run from its plan to its exit code: counts, measures, writes the result and all other files, and prints.

#include <optional>
#include <vector>

#include "cli/options/export_files.h"
#include "cli/processes/count_instructions.h"
#include "cli/running/run_flags.h"
#include "config/config.h"
#include "core/error.h"
#include "run/cases/plan.h"

namespace clusterbench::cli {

// The flags that start both programs of --baseline-binary with this plan. The other program can be older and know
// neither budgets nor launches.
std::vector<std::string> plan_arguments(const RunFlags& flags);

// Returns ok, gate_failed, or the code of an interrupted run; nothing if this part of a run with plug-ins has measured,
// and another one is to go on. Throws Error, before anything is measured, for an output
// that cannot be written or would replace an input; later for a process that breaks down.
std::optional<ExitCode> measure(const RunFlags& flags, const config::Config& config, const run::Plan& plan,
                                CountWay way, const std::vector<ExportTarget>& exports);

}  // namespace clusterbench::cli
