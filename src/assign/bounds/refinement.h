#pragma once
// What sphere refinement and its fast form share: the padding, the parameters, and the narrowing of a spot's cell box.

#include <vector>

#include "assign/bounds/cell_bounds.h"
#include "assign/bounds/tile_planes.h"
#include "assign/contract/assigner.h"
#include "geom/shapes/ball_and_cone.h"

namespace clusterbench::assign {

// With sizes as units: the gap to a slice is off by 1. The distance to a row's plane by 3 (a rounded normal, two
// products and a sum), so the foot on it by 3 + 2 and, seen from a column's plane, 3 + 2 + 3 more. The squares'
// roundoffs, 8 of r² in all, are 4 of r. A test that compares gap² + gap'² + gap''² with r² is off by no more than the
// gaps' sum: 1 + 5 + 8 + 4 = 18.
inline constexpr float k_refinement_roundoffs = 18.0f;

// As light_params(); `spot` may be "narrowing", too, and is.
std::vector<ParamSpec> refinement_params();
bool narrows(const Params& params);

// Takes the cells from a box, from left, right, top, bottom, near and far, that the cone lies wholly beside.
void narrow_from_six_sides(CellBox& box, const geom::SphericalCone& cone, const std::vector<float>& depths,
                           const std::vector<TilePlane>& columns, const std::vector<TilePlane>& rows);

}  // namespace clusterbench::assign
