#pragma once
// A .gltf or .glb file as bytes, JSON and binary chunk. Broken containers and JSON are refused with their byte offset.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace clusterbench::scene {

struct GltfFile {
  std::string name;   // the path, for messages
  std::string bytes;  // of the whole file
  nlohmann::json json;
  bool has_byte_order_mark = false;        // before the JSON; skipped
  std::optional<std::string_view> binary;  // the GLB's BIN chunk, inside `bytes`

  GltfFile() = default;
  GltfFile(const GltfFile&) = delete;  // `binary` points into `bytes`
  GltfFile& operator=(const GltfFile&) = delete;
};

// Fills `file`. Throws Error.
void read_gltf_file(const std::filesystem::path& path, GltfFile& file);

// The first `at_most` bytes of a regular file. Throws Error(file, where, ...) if it cannot be read.
std::string read_bytes(const std::filesystem::path& path, const std::string& file, const std::string& where,
                       std::size_t at_most);

}  // namespace clusterbench::scene
