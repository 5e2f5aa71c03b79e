#include "report/cases/json_values.h"

#include "result/fields.h"
#include "result/rounding.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

const Json* value_at(const Json& from, const std::string& pointer) {
  const Json::json_pointer location(pointer);
  return from.contains(location) && !from[location].is_null() ? &from[location] : nullptr;
}

std::optional<double> number_at(const Json& from, const std::string& pointer) {
  const Json* found = value_at(from, pointer);
  return found != nullptr && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

Json number_or_null(double value) {
  return result::number_json(result::counted(value), false);
}

}  // namespace clusterbench::report
