#pragma once
// Writes glTF files with meshes for one test.

#include <nlohmann/json.hpp>

#include "geom/shapes/vec.h"
#include "scene/geometry.h"
#include "scene/gltf_fixture.h"

namespace clusterbench::scene::test {

// A document with one buffer, to which accessors are added.
class MeshFile {
 public:
  nlohmann::json json = {{"asset", {{"version", "2.0"}}},          {"accessors", nlohmann::json::array()},
                         {"bufferViews", nlohmann::json::array()}, {"meshes", nlohmann::json::array()},
                         {"nodes", nlohmann::json::array()},       {"materials", nlohmann::json::array()}};

  // Each returns an index.
  std::size_t view(const std::string& bytes, std::size_t stride = 0) {
    while (buffer_.size() % 4 != 0) buffer_ += '\0';
    nlohmann::json view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
    if (stride != 0) view["byteStride"] = stride;
    buffer_ += bytes;
    return added("bufferViews", view);
  }
  std::size_t accessor(const std::string& bytes, int component, const std::string& type, std::size_t count,
                       std::size_t stride = 0) {
    return added("accessors",
                 {{"bufferView", view(bytes, stride)}, {"componentType", component}, {"type", type}, {"count", count}});
  }
  std::size_t positions(const std::vector<Vec3f>& vertices) {
    return accessor(bytes_of(vertices), 5126, "VEC3", vertices.size());
  }
  std::size_t uvs(const std::vector<glm::vec2>& of) { return accessor(bytes_of(of), 5126, "VEC2", of.size()); }
  template <class T>
  std::size_t indices(const std::vector<T>& of) {
    return accessor(bytes_of(of), sizeof(T) == 1 ? 5121 : sizeof(T) == 2 ? 5123 : 5125, "SCALAR", of.size());
  }
  std::size_t mesh(const nlohmann::json& primitive) { return added("meshes", {{"primitives", {primitive}}}); }
  std::size_t node(const nlohmann::json& node) { return added("nodes", node); }
  std::size_t material(const nlohmann::json& material) { return added("materials", material); }

  std::string text() const {
    nlohmann::json out = json;
    out["buffers"] = {
        {{"byteLength", buffer_.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer_)}}};
    if (!out.contains("scenes")) {
      nlohmann::json roots = nlohmann::json::array();
      for (std::size_t i = 0; i < out["nodes"].size(); ++i) roots.push_back(i);
      out["scenes"] = {{{"nodes", roots}}};
    }
    return out.dump();
  }

 private:
  std::size_t added(const char* key, nlohmann::json value) {
    json[key].push_back(std::move(value));
    return json[key].size() - 1;
  }

  std::string buffer_;
};

// What is loaded of it, and the scene that it belongs to.
struct LoadedGeometry {
  Scene scene;
  Geometry geometry;
};
inline LoadedGeometry loaded_geometry(const std::string& text, GeometryParts parts = GeometryParts::positions) {
  const Folder folder;
  LoadedGeometry out;
  out.scene = load_gltf(folder.write("scene.gltf", text));
  out.geometry = load_geometry(out.scene, parts);
  return out;
}

// "where: message" of the refusal, or "loads".
inline std::string geometry_refusal(const std::string& text, GeometryParts parts = GeometryParts::positions) {
  try {
    loaded_geometry(text, parts);
  } catch (const Error& error) {
    return error.where() + ": " + error.message();
  }
  return "loads";
}

}  // namespace clusterbench::scene::test
