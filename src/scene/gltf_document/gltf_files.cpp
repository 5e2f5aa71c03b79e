#include "scene/gltf_document/gltf_files.h"

#include <limits>

#include "core/text.h"
#include "scene/gltf_document/gltf_container.h"

namespace clusterbench::scene {
namespace {

int hex_digit(char digit) {
  if (digit >= '0' && digit <= '9') return digit - '0';
  if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
  if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
  return -1;
}

}  // namespace

std::string percent_decoded(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0) {
      out += static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2]));
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

bool has_scheme(const std::string& uri) {
  const std::size_t colon = uri.find(':');
  return colon != std::string::npos && colon < uri.find('/');
}

std::vector<std::filesystem::path> files_named(const nlohmann::json& document, const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  for (const char* key : {"buffers", "images"}) {
    const auto list = document.find(key);
    if (list == document.end() || !list->is_array()) continue;
    for (const nlohmann::json& entry : *list) {
      if (!entry.is_object()) continue;
      const auto uri = entry.find("uri");
      if (uri == entry.end() || !uri->is_string()) continue;
      const std::string& name = uri->get_ref<const std::string&>();
      if (name.starts_with("data:") || has_scheme(name)) continue;
      const std::string file = percent_decoded(name);
      if (printable(file) == file) files.push_back(path.parent_path() / file);  // others are refused when they are read
    }
  }
  return files;
}

// Most large scenes name no files; a text search shows that without parsing.
std::vector<std::filesystem::path> files_named_in(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path, path.string(), "", std::numeric_limits<std::size_t>::max());
  if (bytes.find("\"uri\"") == std::string::npos && bytes.find("\\u00") == std::string::npos) return {};
  GltfFile file;
  read_gltf_file(path, file, k_lazy_from_bytes);
  return files_named(file.json, path);
}

}  // namespace clusterbench::scene
