#pragma once
// A grid's request as JSON and back: with the schema, all that a kind of grid has outside of src/grid.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "grid/grid_spec.h"

namespace clusterbench::config {

const char* scheme_name(grid::Scheme scheme);
std::vector<std::string> scheme_names();
// A length in `slices`; 0 if it is not given or null.
double slices_metres(const nlohmann::json& slices, const char* key);

// One without axes, checked against the schema.
grid::GridSpec grid_spec(const nlohmann::json& grid);
// As a configuration has it.
nlohmann::ordered_json grid_request(const grid::GridSpec& spec);
// Everything that tells two requests apart; keys that the kind does not use are left out.
nlohmann::json grid_identity(const grid::GridSpec& spec);

}  // namespace clusterbench::config
