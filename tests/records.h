#pragma once
// Results that a test writes as JSON, with only the fields that it is about: the others are as in a new record.

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "result/result.h"

namespace clusterbench::test {

inline bool is_whole(const result::Json& json, bool is_unsigned) {
  if (!json.is_number() || json.is_number_unsigned()) return json.is_number();
  const auto value = json.get<double>();
  return value == std::floor(value) && (!is_unsigned || value >= 0.0);
}

// A field that no record has throws.
inline void fill(const result::Type& type, const result::Json& json, void* value) {
  using result::Kind;
  const bool holds_others = type.kind == Kind::object || type.kind == Kind::list || type.kind == Kind::by_name;
  if (holds_others && !json.is_structured()) throw std::invalid_argument("no object or list: " + json.dump());
  if (type.kind == Kind::nullable) {
    if (!json.is_null()) fill(*type.element, json, type.append(value, 0, ""));
  } else if (type.kind == Kind::integer && !is_whole(json, type.is_unsigned)) {
    throw std::invalid_argument("no whole number of its kind: " + json.dump());
  } else if (type.kind == Kind::list) {
    if (type.fixed_size != 0 && json.size() != type.fixed_size)
      throw std::invalid_argument("another number of elements: " + json.dump());
    for (std::size_t i = 0; i < json.size(); ++i) fill(*type.element, json[i], type.append(value, i, ""));
  } else if (type.kind == Kind::by_name) {
    for (const auto& [name, element] : json.items()) fill(*type.element, element, type.append(value, 0, name));
  } else if (type.kind == Kind::object) {
    std::size_t known = 0;
    for (const result::Field& field : type.fields)
      if (const auto found = json.find(field.name); found != json.end()) {
        fill(*field.type, *found, field.make_in(value));
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

// Gives each number of a record, and of all that it can hold, a value. Lists of records get one.
template <class Next>
void fill_with_numbers(const result::Type& type, void* value, Next&& next) {
  using result::Kind;
  if (type.kind == Kind::object) {
    for (const result::Field& field : type.fields) fill_with_numbers(*field.type, field.make_in(value), next);
  } else if (type.kind == Kind::list) {
    const std::size_t size = type.fixed_size > 0 ? type.fixed_size : type.element->kind == Kind::object ? 1 : 0;
    for (std::size_t i = 0; i < size; ++i) fill_with_numbers(*type.element, type.append(value, i, ""), next);
  } else if (type.kind == Kind::integer || type.kind == Kind::number) {
    type.from_json(next(), value);
  }
}
template <class Record, class Next>
void fill_with_numbers(Record& record, Next&& next) {
  fill_with_numbers(result::type_of<Record>(), &record, next);
}

}  // namespace clusterbench::test
