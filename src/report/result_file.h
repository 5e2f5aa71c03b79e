#pragma once
// Results read back from disk.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// Throws Error for what cannot be read, is not JSON, is what an unfinished run left, is not a result, or is one of
// another schema version.
nlohmann::ordered_json read_result(const std::string& path);

}  // namespace clusterbench::report
