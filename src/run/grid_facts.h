#pragma once
// A grid as shown in a result: all numbers that a person needs to rebuild it, shader constants included.

#include <nlohmann/json.hpp>

#include "grid/grid.h"

namespace clusterbench::run {

// Parts of the note of a grid whose slices end neither at the camera's far plane nor at a given far; the second one:
// they end where the lights in view do. Results of all versions have these words.
inline constexpr const char* k_no_far_plane = "the camera has no far plane";
inline constexpr const char* k_ends_with_lights = "slices.far is not set";

// `camera_far_m`: infinite if the camera has no far plane.
nlohmann::json grid_facts(const grid::GridSpec& spec, const grid::Grid& grid, double camera_far_m);

}  // namespace clusterbench::run
