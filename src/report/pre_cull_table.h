#pragma once
// What pre-culls remove, take and lose, as a table for people.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// Per scene and grid: one line per assigner and pre-cull; "" where nothing is culled.
std::string pre_cull_table(const nlohmann::ordered_json& result);

}  // namespace clusterbench::report
