#pragma once
// The keys of one animation sampler, checked against what its channel moves.

#include <optional>

#include "scene/gltf_accessor.h"
#include "scene/scene.h"

namespace clusterbench::scene {

// `sampler` is where the sampler stands, `input` and `output` its accessors; `is_pointer`: the channel is one of
// KHR_animation_pointer, which allows more formats. Nothing without keys, nor for key times or rotations without data:
// glTF allows that (all zero) for extensions to fill in, but it moves nothing. Throws Error.
std::optional<Channel> read_keys(AccessorReader& reader, const JsonLocation& sampler, std::size_t input,
                                 std::size_t output, ChannelPath path, bool is_pointer, Interpolation interpolation);

}  // namespace clusterbench::scene
