#pragma once
// The keys of one animation sampler, checked for the property that its channel moves.

#include <optional>

#include "scene/gltf_document/gltf_accessor.h"
#include "scene/scene.h"

namespace clusterbench::scene {

// Whether channels move something that is measured, or only meshes.
enum class KeysMove : bool { lights_or_cameras, neither };

// `sampler` is the sampler's location, `input` and `output` its accessors; `is_pointer`: the channel is one of
// KHR_animation_pointer, which allows more formats. nullopt without keys, and, with a warning, for key times or
// rotations without data: glTF allows them (all zero) for extensions to fill in, but they move nothing. Key times that
// are equal, negative or out of order are rejected if lights or cameras move; otherwise they are read with a warning:
// the later of equal keys counts, and keys out of order give nullopt. Throws Error.
std::optional<Channel> read_keys(AccessorReader& reader, const JsonLocation& sampler, std::size_t input,
                                 std::size_t output, ChannelPath path, bool is_pointer, Interpolation interpolation,
                                 KeysMove moved);

}  // namespace clusterbench::scene
