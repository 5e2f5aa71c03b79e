// The cells of the light's extents whose view-space bounding box touches the ball.

#include "assign/bounds/bounds_method.h"

namespace clusterbench::assign {
extern const AssignerDescriptor aabb_descriptor;
const AssignerDescriptor aabb_descriptor{
    .name = "aabb",
    .summary = "the cells of the light's extents whose view-space bounding box the sphere touches",
    .source = "Persson 2015, Practical Clustered Shading; DaveH355's test, which visits every cell",
    .kinds = {grid::Kind::frustum},
    .params = light_params(),
    .make = make_list_assigner<CellBoxMethod<AabbsInExtents>>,
};

}  // namespace clusterbench::assign
