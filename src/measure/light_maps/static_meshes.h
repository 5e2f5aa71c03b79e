#pragma once
// The meshes of a scene that light maps are made for: those that never move, where they stand in the world.

#include <string>
#include <vector>

#include "measure/light_maps/uv_raster.h"
#include "scene/geometry.h"
#include "scene/scene.h"

namespace clusterbench::measure {

struct MapTriangle {
  std::array<Vec3d, 3> corners;  // in the world, counter-clockwise seen from its front, in mirrored nodes, too
  bool double_sided = false;
};

// All of a node's mesh: one map.
struct MapMesh {
  std::string name;  // the node's, else "node N" as the file numbers it
  int uv_set = -1;   // n of TEXCOORD_n; -1: no UVs were asked for
  std::vector<MapTriangle> triangles;
  std::vector<UvTriangle> uvs;  // of each triangle, or none
};

struct LeftOut {
  std::string name, reason;
};

struct StaticMeshes {
  std::vector<MapMesh> meshes;  // in the order of nodes
  std::vector<LeftOut> left_out;
};

// With UVs: a mesh or a part of it that has none is left out. Throws Error for what reaches out of the domain, and
// beyond the limit on memory.
StaticMeshes static_meshes(const scene::Scene& scene, const scene::Geometry& geometry, bool with_uvs);

// The geometry without what moves: what throws shadows that are known beforehand.
scene::Geometry static_geometry(const scene::Scene& scene, scene::Geometry geometry);

}  // namespace clusterbench::measure
