#include "report/cases/json_values.h"

#include <algorithm>

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

const Json* value_at(const Json& from, const std::string& pointer) {
  const Json::json_pointer location(pointer);
  return from.contains(location) && !from[location].is_null() ? &from[location] : nullptr;
}

Json setting_of(const Json& config, const std::string& pointer) {
  const Json* parts = value_at(config, "/merged");
  if (parts == nullptr) {
    const Json* value = value_at(config, pointer);
    return value == nullptr ? Json() : *value;
  }
  Json values = Json::array();
  for (const Json& part : *parts) {
    const Json value = setting_of(part, pointer);
    if (std::ranges::find(values, value) == values.end()) values.push_back(value);
  }
  return values.size() == 1 ? values.front() : values;
}

std::optional<double> number_at(const Json& from, const std::string& pointer) {
  const Json* found = value_at(from, pointer);
  return found != nullptr && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

}  // namespace clusterbench::report
