#pragma once
// The schema of configurations in src/config/schemas, embedded by the build (cmake/ClusterbenchEmbed.cmake).

#include <string_view>

namespace clusterbench::config {

std::string_view config_schema_text();

}  // namespace clusterbench::config
