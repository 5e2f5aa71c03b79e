#pragma once
// UVs for meshes that have none, or only those of repeating textures: each flat face of a mesh is laid down as it is,
// at a scale that all share, as Quake's light maps are made, and faces are packed in rows.

#include "measure/light_maps/static_meshes.h"

namespace clusterbench::measure {

struct Unwrapped {
  TexelGrid grid;
  std::vector<UvTriangle> uvs;  // of each triangle
};

// A face: triangles that hang together by common edges and whose normals are within 0.8 degrees of the first one's. It
// is turned so that its longest outer edge runs along u, begins on a texel's corner and has a texel around it that is
// no other face's. Throws Error for a map with a side above k_longest_map_side, and beyond the limit on memory.
Unwrapped unwrapped(const MapMesh& mesh, double texels_per_metre);

}  // namespace clusterbench::measure
