#pragma once
// The lookup of a sample's cell in a shader: its constants, the same on the host, and how far the device's may differ.

#include <cstdint>
#include <string>
#include <vector>

#include "assign/contract/shader_buffers.h"
#include "gpu/reading/reading_mode.h"
#include "grid/grid.h"

namespace clusterbench::gpu {

// Sets the lookup in a mode and its constants. Returns the boundaries of slices for the shader's search, if it
// searches.
std::vector<float> set_lookup(const grid::Grid& grid, assign::LookedUp looked_up, ReadingMode& mode,
                              ReadingArguments& arguments);

// The cell (or tile) that a shader finds whose log2, sqrt and divisions are rounded to nearest; -1: none. 0 where
// samples look up nothing.
std::int64_t cell_on_host(const grid::Grid& grid, assign::LookedUp looked_up, const grid::Sample& sample);

// May a device find this cell? Its log2 may be off by what GLSL allows (grid::Log2), sqrt and divisions by what Vulkan
// does (4.5 and 2.5 ulp); other steps by one ulp, where it does not round to nearest.
bool may_find(const grid::Grid& grid, assign::LookedUp looked_up, const grid::Sample& sample, std::int64_t cell,
              bool rounds_to_nearest);

}  // namespace clusterbench::gpu
