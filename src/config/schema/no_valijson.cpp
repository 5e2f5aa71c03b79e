// Of a build without valijson: the program's own validator.

#include "config/schema/plain_validator.h"
#include "config/schema/schema_verdict.h"

namespace clusterbench::config {

std::vector<std::string> schema_violations(const nlohmann::json& schema, const nlohmann::json& instance) {
  return plain_violations(schema, instance);
}

}  // namespace clusterbench::config
