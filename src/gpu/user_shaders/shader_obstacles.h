#pragma once
// The reasons why a user's shaders cannot run.

#include <string>

#include "gpu/user_shaders/shader_file.h"
#include "grid/grid.h"

namespace clusterbench::gpu {

// On a grid of a kind that the method takes; "" if it can.
std::string grid_obstacle(const ShaderFile& file, const grid::Grid& grid);
// On the device of this process; "" if it can, as far as is known without a frame.
std::string shader_obstacle(const ShaderFile& file);

}  // namespace clusterbench::gpu
