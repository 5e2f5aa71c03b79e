// load_geometry: meshes of the scene's nodes.

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include "core/memory.h"
#include "core/text.h"
#include "scene/geometry.h"
#include "scene/gltf_document/gltf_accessor.h"
#include "scene/gltf_document/gltf_container.h"
#include "scene/gltf_document/gltf_draco.h"
#include "scene/gltf_scene/gltf_checked.h"

namespace clusterbench::scene {
namespace {

constexpr const char* k_draco = "KHR_draco_mesh_compression";
constexpr const char* k_instancing = "EXT_mesh_gpu_instancing";

bool has_extension(const JsonLocation& object, const char* name) {
  return object.has("extensions") && object.at("extensions").has(name);
}

enum class Mode : std::size_t { triangles = 4, strip = 5, fan = 6 };

std::size_t triangle_count(Mode mode, std::size_t corners) {
  return mode == Mode::triangles ? corners / 3 : corners - std::min<std::size_t>(corners, 2);
}

// In the order of glTF 2.0 (3.7.2.1).
std::vector<Triangle> triangles_of(Mode mode, const std::vector<std::uint32_t>& corners) {
  std::vector<Triangle> out;
  const std::size_t count = corners.size();
  out.reserve(triangle_count(mode, count));
  if (mode == Mode::triangles) {
    for (std::size_t i = 0; i + 2 < count; i += 3) out.push_back({corners[i], corners[i + 1], corners[i + 2]});
  } else {
    for (std::size_t i = 0; i + 2 < count; ++i) {
      if (mode == Mode::strip)
        out.push_back({corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
      else
        out.push_back({corners[i + 1], corners[i + 2], corners[0]});
    }
  }
  return out;
}

class MeshReader {
 public:
  MeshReader(const Scene& scene, AccessorReader& reader, GeometryParts parts)
      : reader_(reader), scene_(scene), parts_(parts) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
      node_of_gltf_[static_cast<std::size_t>(scene.nodes[i].gltf_index)] = static_cast<int>(i);
  }

  void add_node(int index) {
    const JsonLocation nodes = reader_.root().at("nodes");
    const JsonLocation node =
        nodes.at(static_cast<std::size_t>(scene_.nodes[static_cast<std::size_t>(index)].gltf_index));
    if (!node.has("mesh")) return;
    const std::size_t mesh = node.at("mesh").index(count_of(reader_.root(), "meshes"), "mesh");
    if (has_extension(node, k_instancing))
      node.warn(std::string(k_instancing) + " is not read: the mesh stands where its node does, once");
    const std::optional<std::size_t> skin = skin_of(node);
    const auto [known, is_new] = surfaces_of_.try_emplace({mesh, skin});
    if (is_new) known->second = read_mesh(reader_.root().at("meshes").at(mesh), skin);
    for (const std::size_t surface : known->second) out_.instances.push_back({surface, skin ? -1 : index, index});
  }

  Geometry result() { return std::move(out_); }

 private:
  std::vector<std::size_t> read_mesh(const JsonLocation& mesh, std::optional<std::size_t> skin) {
    mesh.expect_object();
    const JsonLocation primitives = mesh.at("primitives");
    std::vector<std::size_t> surfaces;
    const std::size_t count = primitives.elements();
    const int uv_set = parts_ == GeometryParts::positions ? -1 : uv_set_of(primitives);
    for (std::size_t i = 0; i < count; ++i) {
      std::optional<Surface> surface = read_primitive(primitives.at(i), skin, uv_set);
      if (!surface || surface->triangles.empty()) continue;
      surfaces.push_back(out_.surfaces.size());
      out_.surfaces.push_back(std::move(*surface));
    }
    return surfaces;
  }

  // The UV set of a light map, which is one map for all of a mesh: TEXCOORD_1 if all drawn primitives have it.
  static int uv_set_of(const JsonLocation& primitives) {
    const std::size_t count = primitives.elements();
    for (std::size_t i = 0; i < count; ++i) {
      primitives.at(i).expect_object();
      if (mode_of(primitives.at(i)) >= 4 && !primitives.at(i).at("attributes").has("TEXCOORD_1")) return 0;
    }
    return 1;
  }

  std::optional<Surface> read_primitive(const JsonLocation& primitive, std::optional<std::size_t> skin, int uv_set) {
    primitive.expect_object();
    const std::size_t mode = mode_of(primitive);
    const JsonLocation attributes = primitive.at("attributes");
    if (mode < 4 || !attributes.has("POSITION")) return std::nullopt;  // points, lines, or nothing to draw
    if (primitive.has("targets")) primitive.at("targets").warn("morph targets are not read: the mesh stands unmorphed");
    const std::size_t positions = accessor_of(attributes.at("POSITION"), "VEC3");
    const bool has_indices =
        !primitive.has("indices") || reader_.has_data(accessor_of(primitive.at("indices"), "SCALAR"));
    const std::size_t vertices = reader_.head(positions).count;
    const std::size_t corners =
        primitive.has("indices") ? reader_.head(accessor_of(primitive.at("indices"), "SCALAR")).count : vertices;
    count_memory(vertices, triangle_count(static_cast<Mode>(mode), corners));
    const std::string uvs = "TEXCOORD_" + std::to_string(uv_set);
    draco_.reset();
    if (has_extension(primitive, k_draco) && !(reader_.has_data(positions) && has_indices))
      decompress(primitive.at("extensions").at(k_draco), uvs);
    Surface surface;
    read_material(primitive, surface);
    if (skin)
      read_skinned(attributes, *skin, surface);
    else
      surface.vertices = vertices_of(attributes);
    // Draco converts strips and fans to lists of triangles.
    surface.triangles = triangles_of(draco_ ? Mode::triangles : static_cast<Mode>(mode),
                                     corners_of(primitive, surface.vertices.size()));
    if (uv_set >= 0 && attributes.has(uvs)) {
      surface.uvs = uvs_of(attributes, uvs, surface.vertices.size());
      surface.uv_set = uv_set;
    }
    return surface;
  }

  void decompress(const JsonLocation& extension, const std::string& uvs) {
    draco_ = draco_mesh(reader_.view_bytes(extension.at("bufferView")), extension,
                        {{"POSITION", 3}, {uvs, 2}, {"JOINTS_0", 4}, {"WEIGHTS_0", 4}});
    if (!draco_->attributes.contains("POSITION")) extension.at("attributes").refuse("'POSITION' is missing");
  }

  // Numbers of an attribute, from the primitive's compressed data if they contain it.
  std::vector<double> attribute_numbers(const JsonLocation& attributes, const std::string& name, const char* type,
                                        std::size_t components) {
    const std::size_t accessor = accessor_of(attributes.at(name), type);
    if (draco_)
      if (const auto found = draco_->attributes.find(name); found != draco_->attributes.end())
        return std::move(found->second);
    return reader_.numbers(accessor, components);
  }

  static std::size_t mode_of(const JsonLocation& primitive) {
    if (!primitive.has("mode")) return static_cast<std::size_t>(Mode::triangles);
    const JsonLocation mode = primitive.at("mode");
    if (mode.whole() > static_cast<std::size_t>(Mode::fan))
      mode.refuse("found " + kind_of(mode.value()) +
                  "; allowed are 4, 5 and 6 (triangles, their strips and fans), and 0 to 3 (points and lines, which "
                  "are left out)");
    return mode.whole();
  }

  // Memory of all meshes so far, counted before a further one is read.
  void count_memory(std::uint64_t vertices, std::uint64_t triangles) {
    vertices_ += vertices;
    triangles_ += triangles;
    check_memory("vertices", vertices_, sizeof(Vec3f), k_fewer_triangles);
    check_memory("triangles", triangles_, sizeof(Triangle), k_fewer_triangles);
  }

  void read_material(const JsonLocation& primitive, Surface& surface) const {
    if (!primitive.has("material")) return;
    const std::size_t index = primitive.at("material").index(count_of(reader_.root(), "materials"), "material");
    const JsonLocation material = reader_.root().at("materials").at(index);
    material.expect_object();
    surface.blends = material.has("alphaMode") && alpha_mode(material.at("alphaMode")) == "BLEND";
    surface.double_sided = material.has("doubleSided") && material.at("doubleSided").boolean();
  }

  static const std::string& alpha_mode(const JsonLocation& mode) {
    if (mode.text() != "OPAQUE" && mode.text() != "MASK" && mode.text() != "BLEND")
      mode.warn("the mode '" + mode.text() + "' is not known (OPAQUE, MASK and BLEND are); read as OPAQUE");
    return mode.text();
  }

  std::vector<Vec3f> vertices_of(const JsonLocation& attributes) {
    const std::vector<double> numbers = attribute_numbers(attributes, "POSITION", "VEC3", 3);
    std::vector<Vec3f> out;
    out.reserve(numbers.size() / 3);
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
      out.emplace_back(static_cast<float>(numbers[i]), static_cast<float>(numbers[i + 1]),
                       static_cast<float>(numbers[i + 2]));
    return out;
  }

  std::vector<Vec2f> uvs_of(const JsonLocation& attributes, const std::string& name, std::size_t vertices) {
    const JsonLocation attribute = attributes.at(name);
    check_memory("texture coordinates", uvs_ += vertices, sizeof(Vec2f), k_fewer_triangles);
    const std::vector<double> numbers = attribute_numbers(attributes, name, "VEC2", 2);
    if (const std::size_t count = numbers.size() / 2; count != vertices)
      attribute.refuse(std::to_string(count) + " texture coordinates for " + std::to_string(vertices) + " vertices");
    std::vector<Vec2f> out;
    out.reserve(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
      for (const std::size_t k : {2 * i, 2 * i + 1})
        if (!(std::abs(numbers[k]) <= k_farthest_uv))
          attribute.refuse("texture coordinate " + std::to_string(i) + " lies beyond -4096..4096");
      out.emplace_back(static_cast<float>(numbers[2 * i]), static_cast<float>(numbers[2 * i + 1]));
    }
    return out;
  }

  std::vector<std::uint32_t> corners_of(const JsonLocation& primitive, std::size_t vertices) {
    std::vector<std::uint32_t> out;
    if (draco_) {
      for (const double index : draco_->corners) out.push_back(static_cast<std::uint32_t>(index));
      return out;  // the library checks that vertex indices are in range
    }
    if (!primitive.has("indices")) {
      for (std::size_t i = 0; i < vertices; ++i) out.push_back(static_cast<std::uint32_t>(i));
      return out;
    }
    const JsonLocation location = primitive.at("indices");
    const std::size_t accessor = accessor_of(location, "SCALAR");
    expect_indices(accessor, {Component::u8, Component::u16, Component::u32});
    for (const double index : reader_.numbers(accessor, 1)) {
      if (!(index < static_cast<double>(vertices)))
        location.refuse("index " + std::to_string(static_cast<std::uint64_t>(index)) + " of " +
                        std::to_string(vertices) + " vertices");
      out.push_back(static_cast<std::uint32_t>(index));
    }
    return out;
  }

  std::optional<std::size_t> skin_of(const JsonLocation& node) const {
    if (!node.has("skin")) return std::nullopt;
    return node.at("skin").index(count_of(reader_.root(), "skins"), "skin");
  }

  // Transform from mesh to world space, per joint, at rest. Joints outside the scene have none.
  const std::vector<Mat4d>& joints_of(std::size_t skin) {
    const auto [known, is_new] = joints_.try_emplace(skin);
    if (!is_new) return known->second;
    const JsonLocation location = reader_.root().at("skins").at(skin), joints = location.at("joints");
    const std::size_t count = joints.elements();
    if (count == 0) joints.refuse("a skin needs a joint");
    std::vector<double> inverse;
    if (location.has("inverseBindMatrices"))
      inverse = reader_.numbers(accessor_of(location.at("inverseBindMatrices"), "MAT4"), 16);
    if (!inverse.empty() && inverse.size() / 16 < count)
      location.at("inverseBindMatrices").refuse("fewer matrices than the skin's " + std::to_string(count) + " joints");
    if (rest_.empty()) rest_ = rest_transforms(scene_);
    for (std::size_t i = 0; i < count; ++i) {
      const auto node = node_of_gltf_.find(joints.at(i).index(count_of(reader_.root(), "nodes"), "node"));
      if (node == node_of_gltf_.end()) joints.at(i).refuse("a joint that does not stand in the scene");
      Mat4d bind(1.0);
      if (!inverse.empty())
        for (int k = 0; k < 16; ++k) bind[k / 4][k % 4] = inverse[i * 16 + static_cast<std::size_t>(k)];
      known->second.push_back(rest_[static_cast<std::size_t>(node->second)] * bind);
    }
    return known->second;
  }

  // Vertices in the rest pose of the skin's joints, in world space.
  void read_skinned(const JsonLocation& attributes, std::size_t skin, Surface& surface) {
    const std::vector<Mat4d>& joints = joints_of(skin);
    const std::vector<double> at = attribute_numbers(attributes, "POSITION", "VEC3", 3);
    const std::size_t joints_of_vertices = accessor_of(attributes.at("JOINTS_0"), "VEC4");
    expect_indices(joints_of_vertices, {Component::u8, Component::u16});
    const std::vector<double> chosen = attribute_numbers(attributes, "JOINTS_0", "VEC4", 4);
    const std::vector<double> weights = attribute_numbers(attributes, "WEIGHTS_0", "VEC4", 4);
    const std::size_t count = at.size() / 3;
    if (chosen.size() / 4 != count || weights.size() / 4 != count)
      attributes.refuse("JOINTS_0 and WEIGHTS_0 must have as many elements as POSITION");
    if (attributes.has("JOINTS_1")) attributes.at("JOINTS_1").warn("only the first four joints of a vertex are read");
    surface.origin = Vec3d(joints.front()[3]);
    surface.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec4d point(at[3 * i], at[3 * i + 1], at[3 * i + 2], 1.0);
      Vec4d sum(0.0);
      double whole = 0.0;
      for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) {
        if (weights[k] == 0.0) continue;
        if (!(chosen[k] < static_cast<double>(joints.size())))
          attributes.at("JOINTS_0")
              .refuse("joint " + std::to_string(static_cast<std::uint64_t>(chosen[k])) + " of " +
                      std::to_string(joints.size()));
        sum += weights[k] * (joints[static_cast<std::size_t>(chosen[k])] * point);
        whole += weights[k];
      }
      surface.vertices.emplace_back((whole > 0.0 ? Vec3d(sum) / whole : Vec3d(joints.front() * point)) -
                                    surface.origin);
    }
  }

  // Integers of these component types, not normalized.
  void expect_indices(std::size_t accessor, std::initializer_list<Component> allowed) const {
    const AccessorHead head = reader_.head(accessor);
    std::string names;
    for (const Component component : allowed)
      names += (names.empty() ? "" : ", ") + std::to_string(static_cast<int>(component));
    if (std::find(allowed.begin(), allowed.end(), head.component) == allowed.end())
      reader_.location(accessor).at("componentType").refuse("indices must be one of " + names);
    if (head.normalized) reader_.location(accessor).at("normalized").refuse("indices are no shares");
  }

  // An accessor's index, of the expected type.
  std::size_t accessor_of(const JsonLocation& reference, const char* type) const {
    const std::size_t index = reference.index(count_of(reader_.root(), "accessors"), "accessor");
    if (reader_.head(index).type != type)
      reader_.location(index).at("type").refuse("found " + reader_.head(index).type + ", " + type + " is needed");
    return index;
  }

  AccessorReader& reader_;
  std::optional<DracoMesh> draco_;  // of the current primitive
  const Scene& scene_;
  GeometryParts parts_;
  std::map<std::size_t, int> node_of_gltf_;
  std::map<std::pair<std::size_t, std::optional<std::size_t>>, std::vector<std::size_t>> surfaces_of_;
  std::map<std::size_t, std::vector<Mat4d>> joints_;
  std::vector<Mat4d> rest_;
  std::uint64_t vertices_ = 0, triangles_ = 0, uvs_ = 0;
  Geometry out_;
};

template <class T>
void append_bytes(const std::vector<T>& values, std::string& out) {
  out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

std::string sha256_of(const Geometry& geometry) {
  std::string bytes;
  for (const Surface& surface : geometry.surfaces) {
    append_bytes(std::vector{surface.origin}, bytes);
    append_bytes(surface.vertices, bytes);
    append_bytes(surface.triangles, bytes);
    append_bytes(surface.uvs, bytes);
    bytes += surface.blends ? 'b' : 'o';
    bytes += surface.double_sided ? '2' : '1';
  }
  append_bytes(geometry.instances, bytes);
  return sha256_hex(bytes);
}

}  // namespace

std::uint64_t Geometry::triangle_count() const {
  std::uint64_t count = 0;
  for (const SurfaceInstance& instance : instances) count += surfaces[instance.surface].triangles.size();
  return count;
}

std::uint64_t Geometry::vertex_count() const {
  std::uint64_t count = 0;
  for (const SurfaceInstance& instance : instances) count += surfaces[instance.surface].vertices.size();
  return count;
}

namespace {

Geometry read_geometry(const Scene& scene, GeometryParts parts) {
  GltfFile file;
  read_gltf_file(scene.path, file, k_lazy_from_bytes);
  Warnings warnings;
  AccessorReader reader(file, warnings, AccessorUse::vertices);
  MeshReader meshes(scene, reader, parts);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) meshes.add_node(static_cast<int>(i));
  Geometry geometry = meshes.result();
  geometry.sha256 = sha256_of(geometry);
  geometry.warnings = warnings.lines();
  return geometry;
}

}  // namespace

Geometry load_geometry(const Scene& scene, GeometryParts parts) {
  return within_memory(scene.path.string(), [&] { return read_geometry(scene, parts); });
}

}  // namespace clusterbench::scene
