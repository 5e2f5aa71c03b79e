#include "config/schema/schema_verdict.h"

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace clusterbench::config {
namespace {

// The validator writes a step as [3] or ["key"].
std::string plain_step(const std::string& step) {
  std::size_t begin = 0, end = step.size();
  while (begin < end && (step[begin] == '[' || step[begin] == '"')) ++begin;
  while (end > begin && (step[end - 1] == ']' || step[end - 1] == '"')) --end;
  return step.substr(begin, end - begin);
}

}  // namespace

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
    std::string pointer;
    for (const std::string& step : error.context)
      if (step != "<root>") pointer += "/" + plain_step(step);
    if (pointer.empty()) pointer = "/";
    violations.push_back(pointer + ": " + error.description);
  }
  return violations;
}

}  // namespace clusterbench::config
