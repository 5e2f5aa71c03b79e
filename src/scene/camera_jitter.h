#pragma once
// Offsets of a camera's picture within a pixel, for PathRequest::jitter_px (scene/camera_path.h).

#include <vector>

#include "geom/shapes/vec.h"

namespace clusterbench::scene {

// The first `count` points of the Halton sequence in bases 2 and 3, minus a half: offsets within a pixel.
std::vector<Vec2d> halton_jitter(int count);

}  // namespace clusterbench::scene
