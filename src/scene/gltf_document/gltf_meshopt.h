#pragma once
// Buffer views compressed by EXT_meshopt_compression, as gltfpack and gltf-transform write them, decoded by
// libmeshoptimizer. KHR_meshopt_compression is the same, with a newer format of vertices in addition to the old one.

#include <optional>
#include <string>
#include <string_view>

#include "scene/gltf_document/gltf_location.h"

namespace clusterbench::scene {

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

// The members of the extension's object, checked: the decoded size is known before memory is allocated.
struct MeshoptView {
  std::size_t count = 0, stride = 0;  // elements, and bytes of each
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;
};

// `extension`: location of the object, for messages.
MeshoptView meshopt_view(const JsonLocation& extension);

// count * stride bytes. Throws Error for a stream that is broken, too short, or of a newer format, and if this program
// was built without the library.
std::string meshopt_decoded(const MeshoptView& view, std::string_view stream, const JsonLocation& extension);

// The extension of a buffer view, with either of its names; nullopt for a view that is not compressed.
std::optional<JsonLocation> meshopt_extension(const JsonLocation& view);

bool has_meshopt();  // whether the program was built with the library

}  // namespace clusterbench::scene
