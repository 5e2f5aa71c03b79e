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

}  // namespace

Json setting_of_parts(const Json& config, const std::string& pointer) {
  std::set<Json> values;
  add_setting(config, pointer, values);
  if (values.empty()) return {};
  return values.size() == 1 ? *values.begin() : Json(values);
}

std::optional<double> number_at(const Json& from, const std::string& pointer) {
  const Json* found = value_at(from, pointer);
  return found != nullptr && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

}  // namespace clusterbench::report
