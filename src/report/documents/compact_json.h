#pragma once
// JSON for a file that is read by programs, looked at by people and kept in a repository.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// Members of objects fill lines of 120 columns; a list of plain values stands in one line, however long; all else is
// indented by a blank a level. Ends with a line feed.
std::string compact_json(const nlohmann::ordered_json& value);

}  // namespace clusterbench::report
