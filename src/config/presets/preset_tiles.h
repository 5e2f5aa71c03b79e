#pragma once
// Tiles that follow the viewport, as engines compute them: the values of `tiles_by` in a preset's file.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geom/shapes/vec.h"

namespace clusterbench::config {

// The member `tiles` of a grid for a viewport, in the format of a configuration.
using TilesBy = nlohmann::json (*)(Vec2i viewport);
TilesBy find_tiles_by(const std::string& name);  // null for an unknown name
std::vector<std::string> tiles_by_names();

}  // namespace clusterbench::config
