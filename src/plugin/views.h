#pragma once
// What a plug-in sees of a grid, a camera and lights: pointers into the program's own data, and numbers beside them.

#include "assign/contract/assigner.h"
#include "plugin/clusterbench_plugin.h"

namespace clusterbench::plugin {

// The bit of a kind, CLUSTERBENCH_FRUSTUM ...
std::uint32_t bit_of(grid::Kind kind);

// The grid must outlive what this returns.
clusterbench_grid view_of(const grid::Grid& grid);
// The types of light that frames may bring, as bits.
std::uint32_t light_types_of(const assign::LightKinds& kinds);
// The frame and its depth must outlive what this returns.
clusterbench_frame view_of(const view::Frame& frame, const depth::DepthImage* depth);
// The lights must outlive what this returns.
clusterbench_lights view_of(const view::LightArrays& lights);

}  // namespace clusterbench::plugin
