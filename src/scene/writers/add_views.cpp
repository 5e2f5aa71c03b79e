#include "scene/writers/add_views.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/error.h"
#include "core/text.h"
#include "scene/gltf_document/gltf_container.h"
#include "scene/gltf_document/gltf_files.h"
#include "scene/scene.h"

namespace clusterbench::scene {
namespace {

constexpr double k_half_turn_rad = 3.14159265358979323846;

struct Face {
  const char* name;
  Vec4d rotation;  // turns -z to it
};

// The faces of a cube, in the order of graphics interfaces.
std::vector<Face> cube_faces() {
  std::vector<Face> faces;
  const std::pair<const char*, Vec3d> ways[] = {{"face-px", {1, 0, 0}}, {"face-nx", {-1, 0, 0}},
                                                {"face-py", {0, 1, 0}}, {"face-ny", {0, -1, 0}},
                                                {"face-pz", {0, 0, 1}}, {"face-nz", {0, 0, -1}}};
  for (const auto& [name, way] : ways) faces.push_back({name, rotation_towards(way)});
  return faces;
}

const Camera& camera_to_follow(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const Camera& camera : scene.cameras) {
    if (name.empty() ? camera.animated : camera.name == name) return camera;
    names.push_back(camera.name);
  }
  if (name.empty() && !scene.cameras.empty()) return scene.cameras.front();
  throw Error(scene.path.string(), "camera",
              name.empty() ? "has no camera that views could be added to"
                           : "has no camera '" + name + "'" + did_you_mean(name, names) + "; it has: " + joined(names));
}

void check_names(const Scene& scene, const ViewsRequest& request) {
  std::vector<std::string> used;
  for (const Camera& camera : scene.cameras) used.push_back(camera.name);
  const auto add_name = [&](const std::string& name) {
    if (name.empty() || std::ranges::find(used, name) != used.end())
      throw Error(scene.path.string(), "camera", "already has one called '" + name + "'");
    used.push_back(name);
  };
  for (const AddedView& view : request.views) add_name(view.name);
  if (request.faces_at_m)
    for (const Face& face : cube_faces()) add_name(face.name);
}

// Returns its index.
std::size_t add_node(nlohmann::json& json, const std::string& name, const Vec3d& at, const Vec4d& rotation,
                     std::size_t camera) {
  json["nodes"].push_back({{"name", name},
                           {"translation", {at.x, at.y, at.z}},
                           {"rotation", {rotation.x, rotation.y, rotation.z, rotation.w}},
                           {"camera", camera}});
  return json["nodes"].size() - 1;
}

void add_followers(nlohmann::json& json, const Scene& scene, const ViewsRequest& request) {
  if (request.views.empty()) return;
  const Camera& followed = camera_to_follow(scene, request.camera);
  const auto node = static_cast<std::size_t>(scene.nodes[static_cast<std::size_t>(followed.node)].gltf_index);
  const std::size_t camera = json["nodes"][node]["camera"].get<std::size_t>();
  for (const AddedView& view : request.views) {
    const double half_rad = view.turned_deg / 360.0 * k_half_turn_rad;
    const Vec4d rotation{0.0, std::sin(half_rad), 0.0, std::cos(half_rad)};
    const std::size_t added = add_node(json, view.name, view.offset_m, rotation, camera);
    json["nodes"][node]["children"].push_back(added);
  }
}

// The far plane is that of the scene's camera.
void add_faces(nlohmann::json& json, const Scene& scene, const ViewsRequest& request) {
  if (!request.faces_at_m) return;
  nlohmann::json perspective{{"yfov", 0.5 * k_half_turn_rad}, {"aspectRatio", 1.0}, {"znear", 0.1}};
  if (!scene.cameras.empty() && std::isfinite(scene.cameras.front().projection.far_m))
    perspective["zfar"] = std::max(0.2, scene.cameras.front().projection.far_m);
  json["cameras"].push_back({{"type", "perspective"}, {"perspective", perspective}});
  const std::size_t camera = json["cameras"].size() - 1, root = json.value("scene", std::size_t{0});
  for (const Face& face : cube_faces())
    json["scenes"][root]["nodes"].push_back(add_node(json, face.name, *request.faces_at_m, face.rotation, camera));
}

std::string word(std::size_t value) {
  std::string bytes;
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xffu);
  return bytes;
}

std::string chunk(std::string content, const char* type, char padding) {
  content.resize((content.size() + 3) / 4 * 4, padding);
  return word(content.size()) + std::string(type, 4) + content;
}

std::string as_glb(const nlohmann::json& json, const std::optional<std::string_view>& binary) {
  std::string chunks = chunk(json.dump(), "JSON", ' ');
  if (binary) chunks += chunk(std::string(*binary), "BIN\0", '\0');
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

}  // namespace

std::string with_views(const Scene& scene, const ViewsRequest& request, const std::filesystem::path& out) {
  const std::filesystem::path& path = scene.path;
  check_names(scene, request);
  GltfFile file;
  read_gltf_file(path, file);
  add_followers(file.json, scene, request);
  add_faces(file.json, scene, request);
  const bool is_glb = file.bytes.starts_with("glTF");
  if ((out.extension() == ".glb") != is_glb)
    throw Error(out.string(), "",
                std::string("must end in ") + (is_glb ? ".glb" : ".gltf") + ", as what it is made of");
  if (!is_glb && !files_named(file.json, path).empty() && absolute(out).parent_path() != absolute(path).parent_path())
    throw Error(out.string(), "", "must be in the folder of " + path.string() + ", which refers to files beside it");
  return is_glb ? as_glb(file.json, file.binary) : file.json.dump(1) + "\n";
}

}  // namespace clusterbench::scene
