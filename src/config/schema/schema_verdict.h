#pragma once
// The verdict of an independent JSON Schema validator.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace clusterbench::config {

// "/pointer: message" for each violation of the draft-07 schema; empty if the instance is valid.
std::vector<std::string> schema_violations(const nlohmann::json& schema, const nlohmann::json& instance);

}  // namespace clusterbench::config
