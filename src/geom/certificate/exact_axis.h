#pragma once
// Does a spot's axis, cut at its range, share a point with a cell? Exact. A spot contains its axis; a spot with a
// half-angle of 0 contains nothing else.

#include <optional>

#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"

namespace clusterbench::geom {

// light.range: finite. Empty for numbers that are too wide (geom/numbers/dyadic.h).
std::optional<bool> axis_meets(const SpotVolume& light, const Cell& cell);

}  // namespace clusterbench::geom
