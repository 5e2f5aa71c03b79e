#pragma once
// A grid as a result shows it: what a person needs to rebuild it, shader constants included.

#include <nlohmann/json.hpp>

#include "grid/grid.h"

namespace clusterbench::run {

// What the note of a grid says whose slices end neither where the camera does nor at a far that is given; and, of
// these, where the end is made up from the path's lights.
inline constexpr const char* k_no_far_plane = "the camera has no far plane";
inline constexpr const char* k_ends_with_lights = "beyond which no light in view reaches";

// `camera_far_m`: infinite where the camera has no far plane.
nlohmann::json grid_facts(const grid::GridSpec& spec, const grid::Grid& grid, double camera_far_m);

}  // namespace clusterbench::run
