#pragma once
// How stable lists are over time, as a table for people.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// Per scene and grid, one line per assigner, the fewest changes first, and the truth's own; "" where no case has it.
std::string stability_table(const nlohmann::ordered_json& result);

}  // namespace clusterbench::report
