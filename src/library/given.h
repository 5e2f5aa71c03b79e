#pragma once
// What an engine gives (assign.h), checked, in this project's own types. All throw Error (where: the argument).

#include "assign/contract/assigner.h"
#include "depth/depth_image.h"
#include "grid/grid.h"
#include "library/assign.h"
#include "view/frame.h"

namespace clusterbench::library {

grid::Kind kind_of(const Grid& grid);
// Refuses what fails in every frame. `takes_orthographic`: whether the method does, so that depths may be below 0.
grid::GridSpec grid_spec_of(const Grid& grid, bool takes_orthographic);
// What depends on the camera, which set_camera() has taken.
void check_grid_in_view(const grid::GridSpec& spec, const View& view);
grid::Grid made_grid(const grid::GridSpec& spec, const grid::GridInputs& inputs);
// `where`: the argument that they are.
assign::Params params_of(const char* where, std::span<const assign::ParamSpec> specs, std::span<const Parameter> given);

// Camera and viewport. The lights of the frame stay.
void set_camera(const View& view, view::Frame& frame);
// Keeps the frame's memory.
void set_lights(const Lights& lights, view::Frame& frame);
void set_depths(const View& view, depth::DepthImage& image);

}  // namespace clusterbench::library
