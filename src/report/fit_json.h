#pragma once
// What slices that follow what frames need save and risk, in a result and as a table.

#include <nlohmann/json.hpp>
#include <string>

#include "run/fit_meter.h"

namespace clusterbench::report {

nlohmann::ordered_json fit_to_json(const run::FitResult& fit);

// One line per case of a grid that follows; "" without any.
std::string fit_table(const nlohmann::ordered_json& result);

}  // namespace clusterbench::report
