#pragma once
// What stands at a JSON pointer of a result, and may be absent: parts that were not measured, figures that are null.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace clusterbench::report {

// nullptr where there is nothing, or null.
const nlohmann::ordered_json* value_at(const nlohmann::ordered_json& from, const std::string& pointer);

// Nothing where there is no number.
std::optional<double> number_at(const nlohmann::ordered_json& from, const std::string& pointer);

// "1920x1080", of what has a viewport.
std::string viewport_text(const nlohmann::ordered_json& from);

}  // namespace clusterbench::report
