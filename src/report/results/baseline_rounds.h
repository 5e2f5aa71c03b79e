#pragma once
// Adds the rounds of another program (run --baseline-binary) to a result.

#include <map>
#include <string>

#include "result/result.h"
#include "run/timing/paired_rounds.h"

namespace clusterbench::report {

// Adds `baseline` to the result, and `timing.baseline` to each measured case. `tool`: the other program's description
// of itself, as in a result.
void add_baseline(result::Result& result, const result::Tool& tool,
                  const std::map<std::string, run::PairedCase>& measured);

}  // namespace clusterbench::report
