#pragma once
// Some of a result's cases, as --filter of `run` names them.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// Leaves only the cases whose name matches the regular expression; "": all. Throws Error with an example where it
// matches none. `path`: what the message calls the result.
void keep_cases(nlohmann::ordered_json& result, const std::string& filter, const std::string& path);

}  // namespace clusterbench::report
