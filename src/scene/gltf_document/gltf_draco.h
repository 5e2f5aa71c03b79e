#pragma once
// Primitives compressed by KHR_draco_mesh_compression, decoded by libdraco where geometry is asked for.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf_document/gltf_location.h"

namespace clusterbench::scene {

// What a compressed primitive holds: corners of triangles, and numbers of the attributes that were asked for.
struct DracoMesh {
  std::size_t vertices = 0;
  std::vector<double> corners;                            // indices of vertices, three a triangle
  std::map<std::string, std::vector<double>> attributes;  // by glTF's name: "POSITION"
};

// `wanted`: names with their numbers of components; those that the extension does not list are left out. `extension`:
// where its object stands, for messages. Throws Error for data that is broken, and where this program was built without
// the library.
DracoMesh draco_mesh(std::string_view stream, const JsonLocation& extension,
                     const std::map<std::string, std::size_t>& wanted);

bool has_draco();  // the program was built with the library

}  // namespace clusterbench::scene
