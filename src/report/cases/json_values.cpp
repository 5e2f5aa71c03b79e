#include "report/cases/json_values.h"

#include <set>

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

const Json* value_at(const Json& from, const std::string& pointer) {
  const Json::json_pointer location(pointer);
  return from.contains(location) && !from[location].is_null() ? &from[location] : nullptr;
}

namespace {

void add_setting(const Json& config, const std::string& pointer, std::set<Json>& values) {
  if (const Json* parts = value_at(config, "/merged"))
    for (const Json& part : *parts) add_setting(part, pointer, values);
  else if (const Json* value = value_at(config, pointer))
    values.insert(*value);
}

// Of a value in a message; null: it is missing.
std::string short_text(const Json* value) {
  if (value == nullptr) return "absent";
  constexpr std::size_t k_longest = 80;
  std::string text = value->dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() <= k_longest) return text;
  if (value->is_array()) return "a list of " + std::to_string(value->size());
  return value->is_object() ? "an object" : "a text of " + std::to_string(text.size()) + " bytes";
}

}  // namespace

Json setting_of_parts(const Json& config, const std::string& pointer) {
  std::set<Json> values;
  add_setting(config, pointer, values);
  if (values.empty()) return {};
  return values.size() == 1 ? *values.begin() : Json(values);
}

FirstDifference first_difference(const Json& one, const Json& other) {
  const Json changes = Json::diff(one, other);
  if (changes.empty()) return {};
  std::string pointer = changes.front()["path"].get<std::string>();
  if (pointer.ends_with("/-")) {  // the other list is longer
    pointer.resize(pointer.size() - 2);
    const Json* shorter = value_at(one, pointer);
    if (shorter != nullptr) pointer += "/" + std::to_string(shorter->size());
  }
  return {pointer, short_text(value_at(one, pointer)), short_text(value_at(other, pointer))};
}

std::optional<double> number_at(const Json& from, const std::string& pointer) {
  const Json* found = value_at(from, pointer);
  return found != nullptr && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

}  // namespace clusterbench::report
