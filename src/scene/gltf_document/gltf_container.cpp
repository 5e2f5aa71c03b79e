#include "scene/gltf_document/gltf_container.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "core/json_document.h"
#include "scene/gltf_document/exporters.h"
#include "scene/gltf_document/gltf_location.h"

namespace clusterbench::scene {
namespace {

constexpr std::uint32_t k_magic = 0x46546C67;       // "glTF"
constexpr std::uint32_t k_json_chunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t k_bin_chunk = 0x004E4942;   // "BIN\0"
constexpr std::size_t k_header_bytes = 12, k_chunk_header_bytes = 8;

[[noreturn]] void refuse_at(const GltfFile& file, std::size_t offset, const std::string& message) {
  throw Error(file.name, "byte " + std::to_string(offset), one_line(message));
}

std::uint32_t little_endian(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[offset + i])) << (8 * i);
  }
  return value;
}

void check_glb_header(const GltfFile& file) {
  if (file.bytes.size() < k_header_bytes) {
    refuse_at(file, file.bytes.size(), "the file ends inside the GLB header of 12 bytes");
  }
  if (const auto version = little_endian(file.bytes, 4); version != 2) {
    refuse_at(file, 4, "GLB version " + std::to_string(version) + " found, 2 is needed");
  }
  const std::size_t length = little_endian(file.bytes, 8);
  if (length > file.bytes.size() || length < k_header_bytes) {
    refuse_at(
        file, 8,
        "the GLB header says " + std::to_string(length) + " bytes, the file has " + std::to_string(file.bytes.size()));
  }
}

// Splits the container; returns the JSON chunk. JSON comes first, BIN at most once and second, others are skipped.
std::string_view glb_json(GltfFile& file) {
  check_glb_header(file);
  // Bytes after the length in the header are not part of the GLB.
  const std::string_view all = std::string_view(file.bytes).substr(0, little_endian(file.bytes, 8));
  std::string_view text;
  std::size_t index = 0;
  for (std::size_t at = k_header_bytes; at < all.size(); ++index) {
    if (all.size() - at < k_chunk_header_bytes) refuse_at(file, at, "the file ends inside a chunk's header");
    const std::size_t length = little_endian(all, at);
    const std::uint32_t type = little_endian(all, at + 4);
    if (length > all.size() - at - k_chunk_header_bytes) {
      refuse_at(file, at, "a chunk of " + std::to_string(length) + " bytes does not fit into the file");
    }
    if (length % 4 != 0)
      refuse_at(file, at, "a chunk's length must be a multiple of 4, found " + std::to_string(length));
    if (index == 0 && type != k_json_chunk) refuse_at(file, at + 4, "the first chunk must be JSON");
    if (index > 0 && type == k_json_chunk) refuse_at(file, at + 4, "a second JSON chunk");
    if (type == k_bin_chunk && file.binary) refuse_at(file, at + 4, "a second BIN chunk");
    if (type == k_bin_chunk && index != 1) refuse_at(file, at + 4, "the BIN chunk must follow the JSON chunk");
    const std::string_view content = all.substr(at + k_chunk_header_bytes, length);
    if (type == k_json_chunk) text = content;
    if (type == k_bin_chunk) file.binary = content;
    at += k_chunk_header_bytes + length;
  }
  if (index == 0) refuse_at(file, k_header_bytes, "the GLB has no JSON chunk");
  return text;
}

// The document without its long arrays; keeps the positions of their text.
std::optional<std::string> long_arrays_left_out(const std::filesystem::path& path, GltfFile& file,
                                                std::string_view text, std::size_t offset) {
  const TextSource source = file.binary ? TextSource(std::string_view(file.bytes)) : TextSource(path);
  return without_long_arrays(text, offset, file.name, source, file.lazy);
}

void note_repeated_key(GltfFile& file, const std::optional<JsonFault>& fault, std::size_t offset) {
  if (fault) file.repeated_key = "byte " + std::to_string(offset + fault->byte) + " " + fault->text();
}

void parse(const std::filesystem::path& path, GltfFile& file, std::string_view text, std::size_t lazy_from_bytes) {
  constexpr std::string_view k_mark = "\xEF\xBB\xBF";
  file.has_byte_order_mark = text.starts_with(k_mark);
  if (file.has_byte_order_mark) text.remove_prefix(k_mark.size());
  const auto offset = static_cast<std::size_t>(text.data() - file.bytes.data());
  if (text.size() >= lazy_from_bytes) {
    const std::optional<std::string> rest = long_arrays_left_out(path, file, text, offset);
    if (rest && !parse_json(*rest, file.json)) {
      note_repeated_key(file, file.lazy.repeated_key, offset);
      if (!file.binary) std::string().swap(file.bytes);
      return;
    }
    file.lazy = {};  // the parser reports the error with its place in the whole text
  }
  const std::optional<JsonFault> fault = parse_json(text, file.json);
  if (fault && !fault->is_repeated_key) refuse_at(file, offset + fault->byte, fault->text());
  note_repeated_key(file, fault, offset);
}

}  // namespace

std::string read_bytes(const std::filesystem::path& path, const std::string& file, const std::string& where,
                       std::size_t at_most) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (status.type() == std::filesystem::file_type::none)
    throw Error(file, where, "'" + path.string() + "' cannot be read: " + failed.message());
  if (!std::filesystem::exists(status)) throw Error(file, where, "'" + path.string() + "' does not exist");
  if (!std::filesystem::is_regular_file(status))
    throw Error(file, where, "'" + path.string() + "' is not a regular file; it is read more than once");
  const auto size = std::filesystem::file_size(path, failed);
  std::ifstream in(path, std::ios::binary);
  if (failed || !in) throw Error(file, where, "'" + path.string() + "' cannot be opened for reading");
  std::string bytes(static_cast<std::size_t>(std::min<std::uintmax_t>(size, at_most)), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

void read_gltf_file(const std::filesystem::path& path, GltfFile& file, std::size_t lazy_from_bytes) {
  file.name = path.string();
  file.bytes = read_bytes(path, file.name, "", std::numeric_limits<std::size_t>::max());
  if (file.bytes.empty()) refuse_at(file, 0, "the file is empty; glTF JSON or a GLB is needed");
  if (const std::string other = other_format(file.bytes, path); !other.empty())
    refuse_at(file, 0, "is " + other + "; glTF is read");
  const std::size_t first = file.bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (!file.bytes.starts_with("glTF") && (first == std::string::npos || file.bytes[first] != '{'))
    refuse_at(file, 0, "is neither a glb, which begins with 'glTF', nor glTF JSON, which is an object in braces");
  const bool binary = file.bytes.size() >= 4 && little_endian(file.bytes, 0) == k_magic;

  file.hash.add(file.bytes);
  parse(path, file, binary ? glb_json(file) : std::string_view(file.bytes), lazy_from_bytes);
}

}  // namespace clusterbench::scene
