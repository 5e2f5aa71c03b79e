#pragma once
// A grid as shown in a result: all numbers that a person needs to rebuild it, shader constants included.

#include <nlohmann/json.hpp>

#include "grid/grid.h"

namespace clusterbench::run {

// Notes of a grid whose slices end neither at the camera's far plane nor at a given far; the second note: the end is
// computed from the path's lights.
inline constexpr const char* k_no_far_plane = "the camera has no far plane";
inline constexpr const char* k_ends_with_lights = "beyond which no light in view reaches";

// `camera_far_m`: infinite if the camera has no far plane.
nlohmann::json grid_facts(const grid::GridSpec& spec, const grid::Grid& grid, double camera_far_m);

}  // namespace clusterbench::run
