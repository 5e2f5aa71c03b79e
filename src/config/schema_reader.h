#pragma once
// Reads JSON by its schema: refuses what the schema refuses, in words for people, and fills in the schema's defaults,
// so that the schema is the one place where keys, ranges and defaults stand. Knows the part of draft-07 that
// config.schema.json uses, and two annotations: an alternative of a oneOf is chosen by its `const` property, and
// `x-selector` names the property whose value decides which properties (`x-used-by`) have a meaning.

#include <nlohmann/json.hpp>

#include "config/json_text.h"

namespace clusterbench::config {

// The value with every default filled in. Throws Error (text.file, "line:column /pointer") for the first fault.
nlohmann::json read_by_schema(const nlohmann::json& schema, const nlohmann::json& value, const JsonText& text);

// "an integer from 1 to 4096": what a schema allows, for messages.
std::string describe_allowed(const nlohmann::json& root, const nlohmann::json& schema);

}  // namespace clusterbench::config
