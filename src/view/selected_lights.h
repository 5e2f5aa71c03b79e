#pragma once
// Some lights of a frame, side by side, as an engine compacts those that a cull leaves.

#include <cstdint>
#include <span>

#include "view/frame.h"

namespace clusterbench::view {

// Copies the lights of these ascending indices; `out` keeps its memory and its `source`, which belongs to whoever made
// it.
void select_lights(const LightArrays& all, std::span<const std::uint32_t> chosen, LightArrays& out);

}  // namespace clusterbench::view
