#pragma once
// Reads JSON by its schema: rejects the values that the schema rejects, with readable messages, and fills in the
// schema's defaults, so that keys, ranges and defaults are defined only in the schema. Supports the part of draft-07
// that config.schema.json uses, and two conventions: an alternative of a oneOf is chosen by its `const` property, and
// `x-selector` names the property whose value decides which properties (`x-used-by`) are used.

#include <nlohmann/json.hpp>

#include "config/schema/json_text.h"

namespace clusterbench::config {

// The value with every default filled in. Throws Error (text.file, "line:column /pointer") for the first error.
nlohmann::json read_by_schema(const nlohmann::json& schema, const nlohmann::json& value, const JsonText& text);

// The same for the member of that name alone.
nlohmann::json read_member_by_schema(const nlohmann::json& schema, const std::string& key, const nlohmann::json& value,
                                     const JsonText& text);

// The values that a schema allows, for messages: "an integer from 1 to 4096".
std::string describe_allowed(const nlohmann::json& root, const nlohmann::json& schema);

}  // namespace clusterbench::config
