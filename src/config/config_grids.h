#pragma once
// Grids of a configuration: axes expanded into their product.

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "config/json_text.h"
#include "grid/grid.h"

namespace clusterbench::config {

// The product of all axes of the grids. `grids` has its defaults filled in. A grid without axes that cannot be is an
// Error here; one that an axis makes is left to the sweep, which skips it with its reason.
std::vector<grid::GridSpec> grid_specs(const nlohmann::json& grids, const JsonText& text);

// `grids` with its defaults filled in, which stand where nobody has named any and flags have changed: one slice, which
// no first one can be cut from, is linear; a grid that the flags have made equal to an earlier one is left out.
nlohmann::json usable_default_grids(const nlohmann::json& grids);

// An object whose members are single values or lists of them: every combination, the last key fastest. A single value
// of `triples` is a list of numbers itself.
std::vector<nlohmann::json> expand_all_axes(const nlohmann::json& object, const std::set<std::string>& triples = {});

}  // namespace clusterbench::config
