#pragma once
// What stands at a JSON pointer of a configuration, or of a document that is no result, and may be absent. Fields of
// results: result/at.h.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace clusterbench::report {

// nullptr where there is nothing, or null.
const nlohmann::ordered_json* value_at(const nlohmann::ordered_json& from, const std::string& pointer);

// Nothing where there is no number.
std::optional<double> number_at(const nlohmann::ordered_json& from, const std::string& pointer);

// JSON has no infinity and no NaN.
nlohmann::ordered_json number_or_null(double value);
// Six digits of what is measured: far more than any clock gives.
nlohmann::ordered_json six_digits(double value);

}  // namespace clusterbench::report
