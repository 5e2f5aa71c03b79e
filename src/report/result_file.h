#pragma once
// Results read back from disk.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// Throws Error for what cannot be read, is not JSON, is what an unfinished run left, is not a result, is one of another
// schema version, or is not as the schema says.
nlohmann::ordered_json read_result(const std::string& path);

}  // namespace clusterbench::report
