#pragma once
// A grid as a result shows it: what a person needs to rebuild it, shader constants included.

#include <nlohmann/json.hpp>

#include "grid/grid.h"

namespace clusterbench::run {

nlohmann::json grid_facts(const grid::GridSpec& spec, const grid::Grid& grid);

}  // namespace clusterbench::run
