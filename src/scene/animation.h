#pragma once
// Values of an animation channel between its keys, as glTF 2.0 appendix C defines them, and what channels move.

#include <vector>

#include "scene/scene.h"

namespace clusterbench::scene {

// The channel's value at a time: x, y, z (w = 0) of a translation or scale, or the unit quaternion x, y, z, w of a
// rotation. Before the first key the first value holds, after the last key the last.
Vec4d sample(const Channel& channel, double time_s);

// Which nodes an animation moves, by a channel of their own or of a node above them.
std::vector<bool> moving_nodes(const Scene& scene);

// The shortest arc from quaternion a (at 0) to b (at 1), both unit up to rounding; the result is unit. Not GLM's, which
// takes the angle from its cosine: small turns lose half of their digits there.
Vec4d slerp(const Vec4d& a, const Vec4d& b, double t);

}  // namespace clusterbench::scene
