#pragma once
// Results that a test writes as JSON, with only the fields that it is about: the others are as in a new record.

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "result/result.h"

namespace clusterbench::test {

// A field that no record has throws.
inline void fill(const result::Type& type, const result::Json& json, void* value) {
  using result::Kind;
  if (type.kind == Kind::nullable) {
    if (!json.is_null()) fill(*type.element, json, type.append(value, 0, ""));
  } else if (type.kind == Kind::list) {
    for (std::size_t i = 0; i < json.size(); ++i) fill(*type.element, json[i], type.append(value, i, ""));
  } else if (type.kind == Kind::by_name) {
    for (const auto& [name, element] : json.items()) fill(*type.element, element, type.append(value, 0, name));
  } else if (type.kind == Kind::object) {
    std::size_t known = 0;
    for (const result::Field& field : type.fields)
      if (const auto found = json.find(field.name); found != json.end()) {
        fill(*field.type, *found, field.make(value));
        ++known;
      }
    if (known != json.size()) throw std::invalid_argument("a field that no record has: " + json.dump());
  } else {
    type.from_json(json, value);
  }
}

template <class Record>
Record record_of(const result::Json& json) {
  Record record;
  fill(result::type_of<Record>(), json, &record);
  return record;
}

inline result::Result result_of(const result::Json& json) {
  return record_of<result::Result>(json);
}
inline result::Case case_of(const result::Json& json) {
  return record_of<result::Case>(json);
}
inline std::vector<result::Case> cases_of(const result::Json& json) {
  return record_of<std::vector<result::Case>>(json);
}

}  // namespace clusterbench::test
