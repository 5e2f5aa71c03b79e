#pragma once
// The meshes of a scene that get light maps: those that never move, in world space.

#include <string>
#include <vector>

#include "measure/light_maps/uv_raster.h"
#include "scene/geometry.h"
#include "scene/scene.h"

namespace clusterbench::measure {

struct MapTriangle {
  std::array<Vec3d, 3> corners;  // in world space, counter-clockwise seen from the front, also in mirrored nodes
  bool double_sided = false;
};

// The whole mesh of a node: one map.
struct MapMesh {
  std::string name;  // the node's, else "node N" as the file numbers it
  int uv_set = -1;   // n of TEXCOORD_n; -1: UVs were not requested
  std::vector<MapTriangle> triangles;
  std::vector<UvTriangle> uvs;  // one per triangle, or empty
};

struct LeftOut {
  std::string name, reason;
};

struct StaticMeshes {
  std::vector<MapMesh> meshes;  // in the order of nodes
  std::vector<LeftOut> left_out;
};

// `with_uvs`: meshes and parts without UVs are left out. Throws Error for UVs outside of the domain, and beyond the
// memory limit.
StaticMeshes static_meshes(const scene::Scene& scene, const scene::Geometry& geometry, bool with_uvs);

// The geometry without moving parts: its shadows are known in advance.
scene::Geometry static_geometry(const scene::Scene& scene, scene::Geometry geometry);

}  // namespace clusterbench::measure
