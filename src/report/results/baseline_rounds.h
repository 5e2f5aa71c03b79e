#pragma once
// What rounds beside another program (run --baseline-binary) add to a result.

#include <map>
#include <string>

#include "result/result.h"
#include "run/timing/paired_rounds.h"

namespace clusterbench::report {

// The result gets `baseline`, each measured case `timing.baseline`. `tool`: what the other program says of itself, as
// in a result.
void add_baseline(result::Result& result, const result::Tool& tool,
                  const std::map<std::string, run::PairedCase>& measured);

}  // namespace clusterbench::report
