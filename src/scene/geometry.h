#pragma once
// The triangles of a scene's meshes. Read only if depth or light maps are needed.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geom/shapes/vec.h"
#include "scene/scene.h"

namespace clusterbench::scene {

using Vec2f = glm::vec2;
using Triangle = std::array<std::uint32_t, 3>;  // indices of vertices, counter-clockwise seen from its front

// A primitive of a mesh, in the mesh's own space.
struct Surface {
  Vec3d origin{0.0};  // of the vertices: a skin can place them far from the world's zero
  std::vector<Vec3f> vertices;
  std::vector<Triangle> triangles;
  std::vector<Vec2f> uvs;     // one per vertex; empty if not requested, or if the mesh has none
  int uv_set = -1;            // n of TEXCOORD_n
  bool blends = false;        // alphaMode BLEND: surfaces behind it are visible, too. Textures are never read
  bool double_sided = false;  // else visible from its front only
};

// A surface in the scene. Skinned ones are in world space, in their skin's rest pose.
struct SurfaceInstance {
  std::size_t surface = 0;
  int node = -1;      // index in Scene::nodes; -1: its vertices are in world space
  int shown_by = -1;  // the node that decides its visibility
};

// Advice for less memory of a scene's geometry, for messages (check_memory()).
inline constexpr const char* k_fewer_triangles = "use simpler meshes";

struct Geometry {
  std::vector<Surface> surfaces;
  std::vector<SurfaceInstance> instances;
  std::string sha256;  // of all of the above
  std::vector<std::string> warnings;

  std::uint64_t triangle_count() const;  // of all instances
  std::uint64_t vertex_count() const;    // of all instances
  bool empty() const { return instances.empty(); }
};

// Parts of meshes to read. Texture coordinates are those of a light map: TEXCOORD_1 if all primitives of a mesh have
// it, else TEXCOORD_0.
enum class GeometryParts : std::uint8_t { positions, positions_and_uvs };

// UVs farther from 0 are rejected: their rounding is too coarse for texels.
inline constexpr double k_farthest_uv = 4096.0;

// Reads the scene's file again, for the meshes of its nodes: triangle lists, strips and fans; points and lines are left
// out. Compressed meshes (Draco, meshopt) are decoded. Throws Error (file, JSON pointer) for errors in them.
Geometry load_geometry(const Scene& scene, GeometryParts parts = GeometryParts::positions);

}  // namespace clusterbench::scene
