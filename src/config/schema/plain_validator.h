#pragma once
// JSON Schema without a library, for builds without valijson: the keywords of draft-07 that the tool's schemas use.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace clusterbench::config {

// "/pointer: message" for each violation; empty if the instance is valid. Throws Error for a schema with a keyword that
// it does not know: ignoring it would accept too much.
std::vector<std::string> plain_violations(const nlohmann::json& schema, const nlohmann::json& instance);

}  // namespace clusterbench::config
