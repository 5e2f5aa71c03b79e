#pragma once
// The common part of sphere refinement and its fast form: the padding, the parameters, and the narrowing of a spot's
// cell box.

#include <vector>

#include "assign/bounds/cell_bounds.h"
#include "assign/bounds/tile_planes.h"
#include "assign/contract/assigner.h"
#include "geom/shapes/ball_and_cone.h"

namespace clusterbench::assign {

// With sizes as units: the gap to a slice is off by 1. The distance to a row's plane by 3 (a rounded normal, two
// products and a sum), so the foot on it by 3 + 2 and, relative to a column's plane, 3 + 2 + 3 more. The squares'
// roundoffs, 8 of r² in all, are 4 of r. A test that compares gap² + gap'² + gap''² with r² is off by no more than the
// gaps' sum: 1 + 5 + 8 + 4 = 18.
inline constexpr float k_refinement_roundoffs = 18.0f;

// light_params(), but `spot` may also be "narrowing", which is its default.
std::vector<ParamSpec> refinement_params();
bool narrows(const Params& params);

// Removes the cells of a box that the cone lies wholly beside, from left, right, top, bottom, near and far.
void narrow_from_six_sides(CellBox& box, const geom::SphericalCone& cone, const std::vector<float>& depths,
                           const std::vector<TilePlane>& columns, const std::vector<TilePlane>& rows);

}  // namespace clusterbench::assign
