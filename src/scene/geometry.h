#pragma once
// The triangles of a scene's meshes. Nothing reads them but what asks for depth, or for light maps.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geom/shapes/vec.h"
#include "scene/scene.h"

namespace clusterbench::scene {

using Vec2f = glm::vec2;
using Triangle = std::array<std::uint32_t, 3>;  // indices of vertices, counter-clockwise seen from its front

// A primitive of a mesh, as its own space has it.
struct Surface {
  Vec3d origin{0.0};  // of the vertices: where a skin puts them is far from the world's zero at times
  std::vector<Vec3f> vertices;
  std::vector<Triangle> triangles;
  std::vector<Vec2f> uvs;     // one per vertex; empty where they were not asked for, and where the mesh has none
  int uv_set = -1;            // n of TEXCOORD_n
  bool blends = false;        // alphaMode BLEND: what is behind it is seen, too. Textures are never read
  bool double_sided = false;  // else it is seen from its front alone
};

// A surface in the scene. Skinned ones stand in the world as their skin's rest pose has them.
struct SurfaceInstance {
  std::size_t surface = 0;
  int node = -1;      // index in Scene::nodes; -1: its vertices are in world space
  int shown_by = -1;  // the node whose visibility is its own
};

// What makes a scene's geometry take less memory, for messages (check_memory()).
inline constexpr const char* k_fewer_triangles = "use simpler meshes";

struct Geometry {
  std::vector<Surface> surfaces;
  std::vector<SurfaceInstance> instances;
  std::string sha256;  // of all of the above
  std::vector<std::string> warnings;

  std::uint64_t triangle_count() const;  // of all instances
  std::uint64_t vertex_count() const;    // likewise
  bool empty() const { return instances.empty(); }
};

// What of meshes is read. Texture coordinates are those of a light map: TEXCOORD_1 where all primitives of a mesh have
// it, else TEXCOORD_0.
enum class GeometryParts : std::uint8_t { positions, positions_and_uvs };

// UVs farther from 0 are refused: a texel's place would be lost in their rounding.
inline constexpr double k_farthest_uv = 4096.0;

// Reads the scene's file once more, for the meshes of its nodes: triangle lists, strips and fans; points and lines are
// left out. Compressed ones (Draco, meshopt) are decoded. Throws Error (file, JSON pointer) for what is broken in them.
Geometry load_geometry(const Scene& scene, GeometryParts parts = GeometryParts::positions);

}  // namespace clusterbench::scene
