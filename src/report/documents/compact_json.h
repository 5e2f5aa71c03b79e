#pragma once
// JSON for a file that programs and people read, and that is kept in a repository.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// Members of objects fill lines of 120 columns; a list of plain values is in one line of any length; everything else is
// indented by one space per level. Ends with a line feed. `threads` share long lists.
std::string compact_json(const nlohmann::ordered_json& value, int threads = 1);

}  // namespace clusterbench::report
