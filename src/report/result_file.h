#pragma once
// Results read back from disk.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

enum class Schema { this_version, any };

// Throws Error for what cannot be read, is not JSON, is what an unfinished run left, is not a result, is one of another
// schema version where that matters, or is not as the schema says. What one of any version has is as this version's
// schema says, too, but for properties that it does not know.
nlohmann::ordered_json read_result(const std::string& path, Schema schema = Schema::this_version);

}  // namespace clusterbench::report
