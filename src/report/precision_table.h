#pragma once
// What packing lights loses and what inflation costs, as a table for people.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// Per scene and grid: what each packing loses, then one line per assigner and precision; "" where no light is packed.
std::string precision_table(const nlohmann::ordered_json& result);

}  // namespace clusterbench::report
