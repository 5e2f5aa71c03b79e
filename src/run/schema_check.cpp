#include "run/schema_check.h"

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace clusterbench::run {

std::vector<std::string> schema_violations(const nlohmann::json& schema, const nlohmann::json& instance) {
  valijson::Schema compiled;
  valijson::SchemaParser parser;
  parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(schema), compiled);

  valijson::Validator validator(valijson::Validator::kStrongTypes);
  valijson::ValidationResults results;
  validator.validate(compiled, valijson::adapters::NlohmannJsonAdapter(instance), &results);

  std::vector<std::string> violations;
  valijson::ValidationResults::Error error;
  while (results.popError(error)) {
    const std::string place = error.jsonPointer.empty() ? "/" : error.jsonPointer;
    violations.push_back(place + ": " + error.description);
  }
  return violations;
}

}  // namespace clusterbench::run
