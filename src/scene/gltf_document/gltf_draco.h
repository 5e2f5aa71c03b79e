#pragma once
// Primitives compressed by KHR_draco_mesh_compression, decoded by libdraco if geometry is requested.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf_document/gltf_location.h"

namespace clusterbench::scene {

// The contents of a compressed primitive: corners of triangles, and the values of the requested attributes.
struct DracoMesh {
  std::size_t vertices = 0;
  std::vector<double> corners;                            // indices of vertices, three per triangle
  std::map<std::string, std::vector<double>> attributes;  // by glTF's name: "POSITION"
};

// `wanted`: names with their numbers of components; attributes that the extension does not list are left out.
// `extension`: location of its object, for messages. Throws Error for broken data, and if this program was built
// without the library.
DracoMesh draco_mesh(std::string_view stream, const JsonLocation& extension,
                     const std::map<std::string, std::size_t>& wanted);

}  // namespace clusterbench::scene
