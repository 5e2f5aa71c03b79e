#pragma once
// A grid as a result shows it: what a person needs to rebuild it, shader constants included.

#include <nlohmann/json.hpp>

#include "grid/grid.h"

namespace clusterbench::run {

// `camera_far_m`: infinite where the camera has no far plane.
nlohmann::json grid_facts(const grid::GridSpec& spec, const grid::Grid& grid, double camera_far_m);

}  // namespace clusterbench::run
