#pragma once
// What slices that follow what frames need save and risk, as a table.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// One line per case of a grid that follows; "" without any.
std::string fit_table(const nlohmann::ordered_json& result);

}  // namespace clusterbench::report
