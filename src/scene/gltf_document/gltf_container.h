#pragma once
// A .gltf or .glb file as bytes, JSON and binary chunk. Broken containers and JSON are rejected with their byte offset.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/sha256.h"
#include "scene/gltf_document/gltf_lazy.h"

namespace clusterbench::scene {

struct GltfFile {
  std::string name;   // the path, for messages
  std::string bytes;  // of the whole file; empty if `lazy` reads it again and it has no binary chunk
  Sha256 hash;        // of all bytes that were read
  nlohmann::json json;
  LazyArrays lazy;                         // arrays that are empty in `json`
  bool has_byte_order_mark = false;        // before the JSON; skipped
  std::string repeated_key;                // a key that stands twice, of which the later value counts; "": none
  std::optional<std::string_view> binary;  // the GLB's BIN chunk, inside `bytes`

  GltfFile() = default;
  GltfFile(const GltfFile&) = delete;  // `binary` points into `bytes`
  GltfFile& operator=(const GltfFile&) = delete;
};

// In files of at least this size nodes and lights stay text (gltf_lazy.h).
inline constexpr std::size_t k_lazy_from_bytes = std::size_t{4} << 20;

// Fills `file`. `lazy_from_bytes`: none for callers that need the whole document. Throws Error.
void read_gltf_file(const std::filesystem::path& path, GltfFile& file,
                    std::size_t lazy_from_bytes = static_cast<std::size_t>(-1));

// The first `at_most` bytes of a regular file. Throws Error(file, where, ...) if it cannot be read.
std::string read_bytes(const std::filesystem::path& path, const std::string& file, const std::string& where,
                       std::size_t at_most);

}  // namespace clusterbench::scene
