#pragma once
// What rounds beside another program (run --baseline-binary) add to a result.

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "run/paired_rounds.h"

namespace clusterbench::report {

// The result gets `baseline` {tool}, each measured case `timing.baseline` {launches [{base_ns, new_ns}], base_ns,
// new_ns, ratio, ci95, lists_differ}. `tool`: what the other program says of itself, as in a result.
void add_baseline(nlohmann::ordered_json& result, const nlohmann::ordered_json& tool,
                  const std::map<std::string, run::PairedCase>& measured);

}  // namespace clusterbench::report
