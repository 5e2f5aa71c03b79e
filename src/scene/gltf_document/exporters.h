#pragma once
// Files of other programs, and exporters: the format of a file by its content, and how its lights get into a glTF file.

#include <filesystem>
#include <string>
#include <string_view>

namespace clusterbench::scene {

// "a Blender file; open it in Blender and ..." for a file of another program that must be exported to glTF; empty for
// an unknown format. `bytes`: the file's first ones. The extension decides only if the bytes do not.
std::string other_format(std::string_view bytes, const std::filesystem::path& path);

// Whether a file is read as a scene: it begins as a GLB, is JSON with an `asset`, has the extension .gltf, .glb or .vrm
// in any case, or is another program's, for which load_gltf() reports how to convert it.
bool is_scene_file(const std::filesystem::path& path);

// The option of an exporter that includes lights, by the file's asset/generator; for an unknown generator, those of the
// usual exporters.
std::string how_lights_are_exported(const std::string& generator);

}  // namespace clusterbench::scene
