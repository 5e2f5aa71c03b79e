#pragma once
// Values of an animation channel between its keys, as defined in glTF 2.0 appendix C, and the nodes that channels move.

#include <vector>

#include "scene/scene.h"

namespace clusterbench::scene {

// The channel's value at a time: x, y, z (w = 0) of a translation or scale, or the unit quaternion x, y, z, w of a
// rotation. The first value holds before the first key, the last one after the last key.
Vec4d sample(const Channel& channel, double time_s);

// The nodes that an animation moves, by a channel of their own or of a node above them.
std::vector<bool> moving_nodes(const Scene& scene);

// The shortest arc from quaternion a (at 0) to b (at 1), both unit up to rounding; the result is unit. GLM's slerp
// computes the angle from its cosine, which loses half of the digits of small turns.
Vec4d slerp(const Vec4d& a, const Vec4d& b, double t);

}  // namespace clusterbench::scene
