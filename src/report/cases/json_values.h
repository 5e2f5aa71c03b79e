#pragma once
// Records as JSON, and optional values at a JSON pointer of a configuration, or of a document that is not a result. For
// fields of results see result/at.h.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "result/fields.h"

namespace clusterbench::report {

// nullptr if it is missing or null.
const nlohmann::ordered_json* value_at(const nlohmann::ordered_json& from, const std::string& pointer);

// The value of a result's configuration; of a merged one that of all its parts that have it, as a sorted list where
// they differ. Null where there is none.
nlohmann::ordered_json setting_of_parts(const nlohmann::ordered_json& config, const std::string& pointer);

// The first place where two documents differ (/timing/rounds), and what is there, for a message: "absent", the value,
// or its kind if it is long. Empty if they are equal.
struct FirstDifference {
  std::string pointer, of_one, of_other;
};
FirstDifference first_difference(const nlohmann::ordered_json& one, const nlohmann::ordered_json& other);

// None if it is not a number.
std::optional<double> number_at(const nlohmann::ordered_json& from, const std::string& pointer);

// Equal in all recorded values.
template <class Record>
bool are_same(const Record& one, const Record& other) {
  return &one == &other || result::to_json(one) == result::to_json(other);
}

}  // namespace clusterbench::report
