#pragma once
// The keys of one animation sampler, checked against what its channel moves.

#include <optional>

#include "scene/gltf_document/gltf_accessor.h"
#include "scene/scene.h"

namespace clusterbench::scene {

// What channels move: something that is measured, or nothing but meshes.
enum class KeysMove : bool { lights_or_cameras, neither };

// `sampler` is where the sampler stands, `input` and `output` its accessors; `is_pointer`: the channel is one of
// KHR_animation_pointer, which allows more formats. Nothing without keys, nor for key times or rotations without data:
// glTF allows that (all zero) for extensions to fill in, but it moves nothing, and a warning says so. Key times that
// are equal, negative or out of order are refused where lights or cameras move; elsewhere they are read with a warning,
// of equal ones the later, and keys out of order are nothing. Throws Error.
std::optional<Channel> read_keys(AccessorReader& reader, const JsonLocation& sampler, std::size_t input,
                                 std::size_t output, ChannelPath path, bool is_pointer, Interpolation interpolation,
                                 KeysMove moved);

}  // namespace clusterbench::scene
