#pragma once
// Other programs' files and exporters: what a file is by its content, and how its lights get into a glTF file.

#include <filesystem>
#include <string>
#include <string_view>

namespace clusterbench::scene {

// "a Blender file; open it in Blender and ..." of a file that another program made and that glTF has to be exported
// from; empty for what is not known. `bytes`: the file's first ones. The ending tells only what the bytes leave open.
std::string other_format(std::string_view bytes, const std::filesystem::path& path);

// Whether a file is read as a scene: it begins as a GLB, is JSON with an `asset`, ends in .gltf, .glb or .vrm in any
// case, or is another program's, for which load_gltf() says what to do.
bool is_scene_file(const std::filesystem::path& path);

// The switch of an exporter that lets lights through, by the file's asset/generator; of the usual ones where the
// generator is none that is known.
std::string how_lights_are_exported(const std::string& generator);

}  // namespace clusterbench::scene
