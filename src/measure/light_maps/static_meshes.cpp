#include "measure/light_maps/static_meshes.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"
#include "geom/shapes/domain.h"
#include "scene/animation.h"

namespace clusterbench::measure {
namespace {

std::string name_of(const scene::Node& node) {
  return node.name.empty() ? "node " + std::to_string(node.gltf_index) : node.name;
}

class Collector {
 public:
  Collector(const scene::Scene& scene, const scene::Geometry& geometry, bool with_uvs)
      : scene_(scene),
        geometry_(geometry),
        with_uvs_(with_uvs),
        world_(world_transforms(scene, 0.0)),
        moving_(moving_nodes(scene)),
        shown_(visible_nodes(scene, 0.0)) {}

  // `instances`: all of one node, which are consecutive in the scene.
  void add_node(std::span<const scene::SurfaceInstance> instances) {
    const auto node = static_cast<std::size_t>(instances.front().shown_by);
    const std::string name = name_of(scene_.nodes[node]);
    if (const std::string reason = reason_against(instances.front()); !reason.empty())
      return out_.left_out.push_back({name, reason});
    MapMesh mesh;
    mesh.name = name;
    std::uint64_t without_uvs = 0;
    for (const scene::SurfaceInstance& instance : instances) {
      const scene::Surface& surface = geometry_.surfaces[instance.surface];
      if (with_uvs_ && surface.uvs.empty())
        without_uvs += surface.triangles.size();
      else
        add_surface(surface, node, mesh);
    }
    if (without_uvs > 0)
      out_.left_out.push_back({name, mesh.triangles.empty()
                                         ? "has no texture coordinates"
                                         : number_of(without_uvs, "triangle") + " without texture coordinates"});
    if (!mesh.triangles.empty()) out_.meshes.push_back(std::move(mesh));
  }

  StaticMeshes take() { return std::move(out_); }

 private:
  std::string reason_against(const scene::SurfaceInstance& instance) const {
    const auto node = static_cast<std::size_t>(instance.shown_by);
    if (instance.node < 0) return "is skinned";
    if (moving_[node]) return "moves";
    return shown_[node] ? "" : "is not shown at time 0";
  }

  void add_surface(const scene::Surface& surface, std::size_t node, MapMesh& mesh) {
    check_memory("triangles", triangles_ += surface.triangles.size(), sizeof(MapTriangle) + sizeof(UvTriangle),
                 scene::k_fewer_triangles);
    mesh.uv_set = surface.uv_set;
    // A mirrored node does not swap front and back faces (glTF 2.0, 3.7.4).
    const bool is_mirrored = glm::determinant(Mat3d(world_[node])) < 0.0;
    for (const scene::Triangle& triangle : surface.triangles) {
      const scene::Triangle turned = is_mirrored ? scene::Triangle{triangle[0], triangle[2], triangle[1]} : triangle;
      MapTriangle corners;
      corners.double_sided = surface.double_sided;
      for (std::size_t i = 0; i < 3; ++i) corners.corners[i] = placed(surface, turned[i], node);
      mesh.triangles.push_back(corners);
      if (with_uvs_) mesh.uvs.push_back({surface.uvs[turned[0]], surface.uvs[turned[1]], surface.uvs[turned[2]]});
    }
  }

  Vec3d placed(const scene::Surface& surface, std::uint32_t vertex, std::size_t node) const {
    const Vec3d at(world_[node] * Vec4d(surface.origin + Vec3d(surface.vertices[vertex]), 1.0));
    if (!geom::is_in_domain(at.x) || !geom::is_in_domain(at.y) || !geom::is_in_domain(at.z))
      throw Error(scene_.path.string(), "/nodes/" + std::to_string(scene_.nodes[node].gltf_index),
                  "the mesh of node '" + printable(scene_.nodes[node].name) +
                      "' reaches farther than 1e15 m from the world's origin");
    return at;
  }

  const scene::Scene& scene_;
  const scene::Geometry& geometry_;
  bool with_uvs_;
  std::vector<Mat4d> world_;
  std::vector<bool> moving_, shown_;
  std::uint64_t triangles_ = 0;
  StaticMeshes out_;
};

}  // namespace

StaticMeshes static_meshes(const scene::Scene& scene, const scene::Geometry& geometry, bool with_uvs) {
  Collector collector(scene, geometry, with_uvs);
  for (std::size_t begin = 0, end = 0; begin < geometry.instances.size(); begin = end) {
    while (end < geometry.instances.size() && geometry.instances[end].shown_by == geometry.instances[begin].shown_by)
      ++end;
    collector.add_node({geometry.instances.data() + begin, geometry.instances.data() + end});
  }
  return collector.take();
}

scene::Geometry static_geometry(const scene::Scene& scene, scene::Geometry geometry) {
  const std::vector<bool> moving = moving_nodes(scene);
  std::erase_if(geometry.instances, [&](const scene::SurfaceInstance& instance) {
    return instance.node < 0 || moving[static_cast<std::size_t>(instance.node)];
  });
  return geometry;
}

}  // namespace clusterbench::measure
