#pragma once
// Does a spot's axis, as long as its range, share a point with a cell? Exactly. A spot holds its axis, and one with a
// half-angle of 0 nothing else.

#include <optional>

#include "geom/shapes/cell.h"
#include "geom/shapes/light_volume.h"

namespace clusterbench::geom {

// light.range: finite. Nothing for numbers that are too wide (geom/numbers/dyadic.h).
std::optional<bool> axis_meets(const SpotVolume& light, const Cell& cell);

}  // namespace clusterbench::geom
