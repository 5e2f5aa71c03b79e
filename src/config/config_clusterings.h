#pragma once
// The clusterings of a configuration: grids, methods and storages of its own product, then those of presets.

#include <nlohmann/json.hpp>
#include <vector>

#include "config/config.h"

namespace clusterbench::config {

// Each once; without the key: no cull. Throws Error.
std::vector<cull::PreCullSpec> pre_culls(const nlohmann::json& document, const JsonText& text);
// Fills in the members that list clusterings; viewports and pre-culls are there already. Throws Error.
void read_clusterings(const nlohmann::json& document, const JsonText& text, const GridChange& preset_grid,
                      Config& config);

}  // namespace clusterbench::config
