#include "scene/gltf_document/gltf_draco.h"

#include <cmath>
#include <memory>
#include <new>
#include <stdexcept>

#if CLUSTERBENCH_HAS_DRACO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"
#pragma GCC diagnostic ignored "-Woverloaded-virtual"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop
#endif

#include "core/memory.h"
#include "core/text.h"
#include "scene/geometry.h"

namespace clusterbench::scene {

#if CLUSTERBENCH_HAS_DRACO
namespace {

std::vector<double> numbers_of(const draco::Mesh& mesh, const JsonLocation& id, std::size_t components) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id.whole()));
  if (attribute == nullptr) id.refuse("the compressed data has no attribute " + std::to_string(id.whole()));
  if (attribute->num_components() != static_cast<int>(components))
    id.refuse("the compressed attribute has " + std::to_string(attribute->num_components()) + " components, " +
              std::to_string(components) + " are needed");
  std::vector<double> out;
  out.reserve(mesh.num_points() * components);
  float values[4] = {};
  for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
    if (!attribute->ConvertValue<float>(attribute->mapped_index(point), static_cast<std::int8_t>(components), values))
      id.refuse("the compressed attribute has a value that is none");
    for (std::size_t k = 0; k < components; ++k) {
      if (!std::isfinite(values[k])) id.refuse("holds a number that is infinite or none at all");
      out.push_back(static_cast<double>(values[k]));
    }
  }
  return out;
}

std::unique_ptr<draco::Mesh> decoded_mesh(std::string_view stream, const JsonLocation& extension) {
  draco::DecoderBuffer buffer;
  buffer.Init(stream.data(), stream.size());
  draco::Decoder decoder;
  try {
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) extension.refuse(std::string("Draco: ") + mesh.status().error_msg_string());
    return std::move(mesh).value();
  } catch (const std::bad_alloc&) {
    extension.refuse("the compressed data asks for more memory than there is");
  } catch (const std::length_error&) {
    extension.refuse("the compressed data asks for more memory than there is");
  }
}

}  // namespace

DracoMesh draco_mesh(std::string_view stream, const JsonLocation& extension,
                     const std::map<std::string, std::size_t>& wanted) {
  const std::unique_ptr<draco::Mesh> mesh = decoded_mesh(stream, extension);
  DracoMesh out;
  out.vertices = mesh->num_points();
  check_memory("vertices of compressed meshes", out.vertices, 16 * sizeof(double), k_fewer_triangles);
  check_memory("triangles of compressed meshes", mesh->num_faces(), 3 * sizeof(double), k_fewer_triangles);
  out.corners.reserve(std::size_t{3} * mesh->num_faces());
  for (draco::FaceIndex face(0); face < mesh->num_faces(); ++face)
    for (const draco::PointIndex& corner : mesh->face(face)) {
      if (!(corner.value() < out.vertices)) extension.refuse("the compressed data is broken: a triangle of no vertex");
      out.corners.push_back(corner.value());
    }
  const JsonLocation attributes = extension.at("attributes");
  for (const auto& [name, components] : wanted)
    if (attributes.has(name)) out.attributes[name] = numbers_of(*mesh, attributes.at(name), components);
  return out;
}
#else
DracoMesh draco_mesh(std::string_view, const JsonLocation& extension, const std::map<std::string, std::size_t>&) {
  extension.refuse(
      "this program was built without libdraco, so it cannot read Draco compression; build it with the "
      "library (scripts/setup installs it), or export the scene without compression");
}
#endif

}  // namespace clusterbench::scene
