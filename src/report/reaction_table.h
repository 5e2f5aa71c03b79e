#pragma once
// Tiles that react and storages whose room ends, as tables.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// One line per case that reacts, or whose storage can run out of room; "" without any.
std::string reaction_table(const nlohmann::ordered_json& result);
std::string fallback_table(const nlohmann::ordered_json& result);

}  // namespace clusterbench::report
