#pragma once
// Results read back from disk.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

enum class Schema { this_version, any };

// Throws Error for what cannot be read, is not JSON, is what an unfinished run left, is not a result, or is one of
// another schema version where that matters.
nlohmann::ordered_json read_result(const std::string& path, Schema schema = Schema::this_version);

}  // namespace clusterbench::report
