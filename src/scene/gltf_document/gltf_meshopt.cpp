#include "scene/gltf_document/gltf_meshopt.h"

#include <algorithm>
#include <array>
#include <cstdint>

#if CLUSTERBENCH_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include "core/memory.h"

namespace clusterbench::scene {
namespace {

template <typename Value, std::size_t Count>
Value one_of(const JsonLocation& object, const char* key, const std::array<std::pair<const char*, Value>, Count>& all,
             const char* default_text) {
  const std::string text = object.has(key) ? object.at(key).text() : default_text;
  std::string names;
  for (const auto& [name, value] : all) {
    if (text == name) return value;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  object.at(key).refuse("found '" + text + "', one of " + names + " is needed");
}

void check_shape(const MeshoptView& view, const JsonLocation& extension) {
  const auto need = [&](bool holds, const char* key, const std::string& rule) {
    if (!holds) extension.at(key).refuse("found " + kind_of(extension.at(key).value()) + ", " + rule);
  };
  if (view.mode != MeshoptMode::attributes) {
    need(view.stride == 2 || view.stride == 4, "byteStride", "indices are 2 or 4 bytes");
    need(view.mode == MeshoptMode::indices || view.count % 3 == 0, "count", "of triangles it is a multiple of 3");
    need(view.filter == MeshoptFilter::none, "filter", "indices have none");
    return;
  }
  need(view.stride >= 4 && view.stride <= 256 && view.stride % 4 == 0, "byteStride",
       "a multiple of 4 up to 256 is needed");
  if (view.filter == MeshoptFilter::octahedral)
    need(view.stride == 4 || view.stride == 8, "byteStride", "OCTAHEDRAL has 4 or 8");
  if (view.filter == MeshoptFilter::quaternion) need(view.stride == 8, "byteStride", "QUATERNION has 8");
}

// The minimum number of bytes for this view: one per triangle or index; for vertices, at most 256 elements share the
// headers of a block, which are a quarter of a byte for each 16 elements of each of their bytes.
bool can_hold(const MeshoptView& view, std::size_t bytes) {
  if (view.mode == MeshoptMode::triangles) return view.count / 3 <= bytes;
  if (view.mode == MeshoptMode::indices) return view.count <= bytes;
  constexpr std::size_t k_most_of_a_byte = 256;
  return view.count / k_most_of_a_byte <= bytes / view.stride;
}

#if CLUSTERBENCH_HAS_MESHOPTIMIZER
int decode(const MeshoptView& view, std::string_view stream, char* out) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(stream.data());
  switch (view.mode) {
    case MeshoptMode::triangles:
      return meshopt_decodeIndexBuffer(out, view.count, view.stride, bytes, stream.size());
    case MeshoptMode::indices:
      return meshopt_decodeIndexSequence(out, view.count, view.stride, bytes, stream.size());
    case MeshoptMode::attributes:
      break;
  }
  return meshopt_decodeVertexBuffer(out, view.count, view.stride, bytes, stream.size());
}

void undo_filter(const MeshoptView& view, char* bytes) {
  switch (view.filter) {
    case MeshoptFilter::octahedral:
      return meshopt_decodeFilterOct(bytes, view.count, view.stride);
    case MeshoptFilter::quaternion:
      return meshopt_decodeFilterQuat(bytes, view.count, view.stride);
    case MeshoptFilter::exponential:
      return meshopt_decodeFilterExp(bytes, view.count, view.stride);
    case MeshoptFilter::none:
      break;
  }
}
#endif

}  // namespace

bool has_meshopt() {
  return CLUSTERBENCH_HAS_MESHOPTIMIZER != 0;
}

std::optional<JsonLocation> meshopt_extension(const JsonLocation& view) {
  if (!view.has("extensions")) return std::nullopt;
  const JsonLocation extensions = view.at("extensions");
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    if (extensions.has(name)) return extensions.at(name);
  return std::nullopt;
}

MeshoptView meshopt_view(const JsonLocation& extension) {
  constexpr std::array<std::pair<const char*, MeshoptMode>, 3> k_modes{{{"ATTRIBUTES", MeshoptMode::attributes},
                                                                        {"TRIANGLES", MeshoptMode::triangles},
                                                                        {"INDICES", MeshoptMode::indices}}};
  constexpr std::array<std::pair<const char*, MeshoptFilter>, 4> k_filters{
      {{"NONE", MeshoptFilter::none},
       {"OCTAHEDRAL", MeshoptFilter::octahedral},
       {"QUATERNION", MeshoptFilter::quaternion},
       {"EXPONENTIAL", MeshoptFilter::exponential}}};
  MeshoptView view;
  view.count = extension.at("count").whole();
  view.stride = extension.at("byteStride").whole();
  extension.at("mode").text();
  view.mode = one_of(extension, "mode", k_modes, "");
  view.filter = one_of(extension, "filter", k_filters, "NONE");
  check_shape(view, extension);
  return view;
}

std::string meshopt_decoded(const MeshoptView& view, std::string_view stream, const JsonLocation& extension) {
  if (!can_hold(view, stream.size()))
    extension.at("count").refuse(std::to_string(view.count) + " elements of " + std::to_string(view.stride) +
                                 " bytes do not fit into a stream of " + std::to_string(stream.size()));
  check_memory("bytes of a compressed bufferView", view.count * view.stride, 1, "export the scene without compression");
#if CLUSTERBENCH_HAS_MESHOPTIMIZER
  std::string out(view.count * view.stride, '\0');
  if (view.count == 0) return out;
  const int failed = decode(view, stream, out.data());
  // The library returns -1 for an unknown header, which includes an unknown version.
  if (failed == -1)
    extension.refuse(
        "the compressed data is of no format that this program's libmeshoptimizer knows; export it as "
        "EXT_meshopt_compression, or without compression");
  if (failed != 0) extension.refuse("the compressed data is broken or cut off");
  undo_filter(view, out.data());
  return out;
#else
  extension.refuse(
      "this program was built without libmeshoptimizer, so it cannot read compressed data; build it with "
      "the library (scripts/setup installs it), or export the scene without compression");
#endif
}

}  // namespace clusterbench::scene
