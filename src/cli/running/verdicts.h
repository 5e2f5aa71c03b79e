#pragma once
// The checks of a finished run: against the program beside it, an earlier result, and budgets.

#include <optional>
#include <string>
#include <vector>

#include "cli/options/gates.h"
#include "cli/processes/baseline_run.h"
#include "core/error.h"
#include "report/gates/limits.h"
#include "result/documents/comparison.h"
#include "result/result.h"

namespace clusterbench::cli {

struct Verdicts {
  std::optional<result::Comparison> comparison;  // with the program beside it; its gates include those of the run
  std::string changes;                           // since the baseline
  std::vector<report::LimitFindings> findings;
};

// Also writes the failures into the result. `baseline`: of --baseline-binary.
Verdicts verdicts_of(const BaselineRequest& baseline, const Gates& gates, result::Result& result);

// Prints them on standard error. Returns ok, or the code of the first check that failed.
ExitCode report_verdicts(const Verdicts& verdicts, const result::Result& result);

}  // namespace clusterbench::cli
