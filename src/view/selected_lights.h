#pragma once
// Some lights of a frame in arrays of their own, as an engine compacts the lights that a cull keeps.

#include <cstdint>
#include <span>

#include "view/frame.h"

namespace clusterbench::view {

// Copies the lights of these ascending indices; `out` keeps its memory and its `source`, which belongs to its creator.
void select_lights(const LightArrays& all, std::span<const std::uint32_t> chosen, LightArrays& out);

}  // namespace clusterbench::view
