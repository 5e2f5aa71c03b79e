#pragma once
// A grid's request as JSON and back; together with the schema the only code outside of src/grid that depends on the
// kind of grid.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "grid/grid_spec.h"

namespace clusterbench::config {

const char* scheme_name(grid::Scheme scheme);
std::vector<std::string> scheme_names();
// A length in `slices`; 0 if it is missing or null.
double slices_metres(const nlohmann::json& slices, const char* key);

// `grid`: without axes, checked against the schema.
grid::GridSpec grid_spec(const nlohmann::json& grid);
// In the format of a configuration.
nlohmann::ordered_json grid_request(const grid::GridSpec& spec);
// All settings that distinguish two requests; without keys that the kind does not use.
nlohmann::json grid_identity(const grid::GridSpec& spec);

}  // namespace clusterbench::config
