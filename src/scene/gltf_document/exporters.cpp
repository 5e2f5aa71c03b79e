#include "scene/gltf_document/exporters.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>

#include "core/text.h"
#include "scene/scene.h"

namespace clusterbench::scene {
namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return text;
}

std::string extension_of(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

constexpr const char* k_blender =
    "a Blender file; open it in Blender, File > Export > glTF 2.0, with Cameras, Punctual Lights and Animation ticked";
constexpr const char* k_fbx =
    "an FBX file; import it into Blender, or open it in the editor that made it, and export it as glTF 2.0 with lights "
    "and cameras";
constexpr const char* k_usd =
    "a USD file; import it into Blender, or open it in the editor that made it, and export it as glTF 2.0 with lights "
    "and cameras";
constexpr const char* k_collada =
    "a COLLADA file; import it into Blender and export it as glTF 2.0 with Cameras, Punctual Lights and Animation "
    "ticked";
constexpr const char* k_mesh_alone =
    "a file of meshes alone, which holds no lights; export the level as glTF 2.0 with lights and cameras";
constexpr const char* k_utf16 = "JSON in UTF-16; glTF is UTF-8: save it as that";

struct Signature {
  std::string_view bytes;  // the first bytes of a file
  const char* ending;      // its extension; "": any
  const char* advice;
};

using namespace std::string_view_literals;

constexpr Signature k_signatures[] = {
    {"BLENDER", "", k_blender},
    {"\x28\xB5\x2F\xFD"sv, ".blend", k_blender},  // Zstandard
    {"\x1F\x8B"sv, ".blend", k_blender},          // gzip
    {"Kaydara FBX Binary", "", k_fbx},
    {"; FBX", "", k_fbx},
    {"PXR-USDC", "", k_usd},
    {"#usda", "", k_usd},
    {"PK\x03\x04"sv, ".usdz", k_usd},
    {"<", ".dae", k_collada},
    {"ply", "", k_mesh_alone},
    {"\xFF\xFE"sv, "", k_utf16},
    {"\xFE\xFF"sv, "", k_utf16},
    {"", ".obj", k_mesh_alone},
    {"", ".stl", k_mesh_alone},
};

// Whether the first non-blank character starts a JSON object.
bool begins_as_json(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  return first != std::string_view::npos && (bytes[first] == '{' || bytes[first] == '[');
}

// Also without a byte order mark: its first character is one of ASCII, and half of it zero.
bool is_json_in_utf16(std::string_view bytes) {
  if (bytes.size() < 2 || (bytes[0] == '\0') == (bytes[1] == '\0')) return false;
  return std::string_view("{[ \t\r\n").find(bytes[0] == '\0' ? bytes[1] : bytes[0]) != std::string_view::npos;
}

}  // namespace

std::string other_format(std::string_view bytes, const std::filesystem::path& path) {
  if (is_json_in_utf16(bytes)) return k_utf16;
  if (begins_as_json(bytes) || bytes.starts_with("glTF")) return "";
  const std::string ending = extension_of(path);
  for (const Signature& known : k_signatures)
    if (bytes.starts_with(known.bytes) && (*known.ending == '\0' || ending == known.ending)) return known.advice;
  return "";
}

bool is_scene_file(const std::filesystem::path& path) {
  const std::string ending = extension_of(path);
  if (ending == ".gltf" || ending == ".glb" || ending == ".vrm") return true;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  constexpr std::size_t k_read_bytes = std::size_t{1} << 20;
  std::string bytes(k_read_bytes, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  if (bytes.starts_with("glTF") || !other_format(bytes, path).empty()) return true;
  static const std::regex asset(R"re("asset"\s*:\s*\{[^{}]*"version")re");
  return begins_as_json(bytes) && std::regex_search(bytes.substr(0, std::min<std::size_t>(bytes.size(), 4096)), asset);
}

std::string how_lights_are_exported(const std::string& generator) {
  const struct {
    const char *name, *advice;
  } exporters[] = {
      {"blender", "in Blender's glTF export tick Include > Data > Punctual Lights"},
      {"unreal", "in the options of Unreal's glTF Exporter tick Export Lights"},
      {"gltfast", "let glTFast export lights (ExportSettings.ComponentMask), and give the scene's lights a range"},
      {"unitygltf", "in Project Settings > UnityGLTF enable the export plugin KHR_lights_punctual"},
      {"sketchfab", "Sketchfab's glTF downloads hold no lights: put them into the level in Blender, and export it"},
      {"fbx2gltf", "FBX2glTF needs the option --khr-lights-punctual"},
      {"obj2gltf", "OBJ holds no lights: put them into the level in Blender, and export it"},
  };
  const std::string known = lower_case(generator);
  for (const auto& exporter : exporters)
    if (known.find(exporter.name) != std::string::npos) return exporter.advice;
  return "tick Punctual Lights in Blender's glTF export, Export Lights in Unreal's; Unity's glTFast and UnityGLTF, "
         "Godot "
         "and three.js write lights (KHR_lights_punctual) by default";
}

std::string why_no_lights(const Scene& scene) {
  if (!scene.lights.empty() || !scene.boxes.empty()) return "";
  const std::size_t unread = scene.contents.unread_lights;
  if (unread > 0)
    return "no lights that are read: " + number_of(unread, "light") + (unread == 1 ? " stands" : " stand") +
           " in other scenes or extensions, see above";
  return "no lights (KHR_lights_punctual) in the file; " + how_lights_are_exported(scene.contents.generator);
}

}  // namespace clusterbench::scene
