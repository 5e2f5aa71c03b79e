#pragma once
// Grids of a configuration: axes expanded into their product.

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "config/schema/json_text.h"
#include "grid/grid.h"

namespace clusterbench::config {

// The product of all axes of the grids. `grids` has its defaults filled in. An impossible grid without axes is an Error
// here; one that an axis makes is left to the sweep, which skips it with the reason. Throws Error for more grids than
// k_most_combinations.
std::vector<grid::GridSpec> grid_specs(const nlohmann::json& grids, const JsonText& text);

// Default grids after changes by flags. `grids` has its defaults filled in. A single slice becomes linear, since no
// first slice can be cut from it; a grid that became equal to an earlier one is left out.
nlohmann::json usable_default_grids(const nlohmann::json& grids);

// Of one list of a configuration: grids, scenes, methods.
inline constexpr std::size_t k_most_combinations = 100'000;

// For an object whose members are single values or lists of them: every combination, the last key fastest. A single
// value of `triples` is itself a list of numbers. Throws Error for more than k_most_combinations. `pointer`: the
// object's place.
std::vector<nlohmann::json> expand_all_axes(const nlohmann::json& object, const JsonText& text,
                                            const std::string& pointer, const std::set<std::string>& triples = {});

}  // namespace clusterbench::config
