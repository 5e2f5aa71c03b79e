#pragma once
// Writes small glTF files for one test and removes them.

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/scene.h"

namespace clusterbench::scene::test {

class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "clusterbench-gltf-XXXXXX").string();
    if (mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

// A document with `members` beside the asset.
inline std::string document(const std::string& members) {
  return R"({"asset": {"version": "2.0"})" + (members.empty() ? "" : ", " + members) + "}";
}

inline Scene loaded(const std::string& text, const std::string& name = "scene.gltf") {
  const Folder folder;
  return load_gltf(folder.write(name, text));
}

// "where: message" of the refusal, or "loads".
inline std::string refusal(const std::string& text, const std::string& name = "scene.gltf") {
  const Folder folder;
  try {
    load_gltf(folder.write(name, text));
  } catch (const Error& error) {
    if (error.file().find(name) == std::string::npos) return "the file is not named";
    return error.where() + ": " + error.message();
  }
  return "loads";
}

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

inline std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return out;
}

inline std::string little_endian(std::uint32_t value) {
  return bytes_of(std::vector<std::uint32_t>{value});
}

// One chunk of a GLB, padded with `fill`.
inline std::string chunk(const std::string& type, std::string content, char fill) {
  while (content.size() % 4 != 0) content += fill;
  return little_endian(static_cast<std::uint32_t>(content.size())) + type + content;
}

inline std::string glb(const std::string& chunks) {
  return "glTF" + little_endian(2) + little_endian(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

// What an animation of node 0 is made of; text() is the members "animations", "accessors", "bufferViews", "buffers".
struct Animation {
  std::string path = "translation", interpolation = "LINEAR";
  std::string times, values;  // bytes
  std::size_t keys = 0, elements = 0;
  std::string times_format = R"("componentType": 5126, "type": "SCALAR", "min": [0], "max": [9])";
  std::string values_format = R"("componentType": 5126, "type": "VEC3")";
  std::string uri;      // of the buffer; empty: a data URI
  std::string pointer;  // in place of node 0, for the path "pointer"

  std::string text() const {
    const std::string n = std::to_string(times.size()), m = std::to_string(values.size());
    const std::string all = std::to_string(times.size() + values.size());
    const std::string data = uri.empty() ? "data:application/octet-stream;base64," + base64(times + values) : uri;
    const std::string target = pointer.empty()
                                   ? R"("node": 0)"
                                   : R"("extensions": {"KHR_animation_pointer": {"pointer": ")" + pointer + R"("}})";
    return R"("animations": [{"samplers": [{"input": 0, "output": 1, "interpolation": ")" + interpolation +
           R"("}], "channels": [{"sampler": 0, "target": {)" + target + R"(, "path": ")" + path +
           R"("}}]}], "accessors": [{"bufferView": 0, "count": )" + std::to_string(keys) + ", " + times_format +
           R"(}, {"bufferView": 1, "count": )" + std::to_string(elements) + ", " + values_format +
           R"(}], "bufferViews": [{"buffer": 0, "byteLength": )" + n + R"(}, {"buffer": 0, "byteOffset": )" + n +
           R"(, "byteLength": )" + m + R"(}], "buffers": [{"byteLength": )" + all + R"(, "uri": ")" + data + R"("}])";
  }
};

inline Animation animation(const std::string& path, const std::string& interpolation, const std::vector<float>& times,
                           const std::vector<float>& values) {
  Animation out;
  const std::size_t components = path == "rotation" ? 4 : 3;
  out.path = path;
  out.interpolation = interpolation;
  out.times = bytes_of(times);
  out.values = bytes_of(values);
  out.keys = times.size();
  out.elements = values.size() / components;
  if (components == 4) out.values_format = R"("componentType": 5126, "type": "VEC4")";
  return out;
}

}  // namespace clusterbench::scene::test
