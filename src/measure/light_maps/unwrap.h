#pragma once
// UVs for meshes without any, or with UVs of repeating textures only: each flat face of a mesh is laid out undistorted,
// all at one scale, as in Quake's light maps, and faces are packed in rows.

#include "measure/light_maps/static_meshes.h"

namespace clusterbench::measure {

struct Unwrapped {
  TexelGrid grid;
  std::vector<UvTriangle> uvs;  // one per triangle
};

// A face: triangles connected by common edges, with normals within 0.8 degrees of the first one's. It is rotated so
// that its longest outer edge runs along u and starts on a texel corner, and has a border of one texel that no other
// face uses. Throws Error for a map with a side above k_longest_map_side, and beyond the memory limit.
Unwrapped unwrapped(const MapMesh& mesh, double texels_per_metre);

}  // namespace clusterbench::measure
