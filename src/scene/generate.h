#pragma once
// Seeded scenes of the project's own, written as glTF with lights and an animated camera.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace clusterbench::scene {

struct GeneratorRow {
  std::string name;
  std::string summary;
  std::string source;  // where its figures come from
  // The scene as glTF JSON text with embedded buffers; the same for the same seed on every machine.
  // `lights` = 0: the scene's own default.
  std::string (*make)(std::uint64_t seed, int lights);
  int default_lights;
};

std::span<const GeneratorRow> generators();

// Throws Error for an unknown name (with did-you-mean) or an unwritable path. A path that ends in .glb is written binary.
void generate_scene(const std::string& name, std::uint64_t seed, int lights, const std::filesystem::path& out);

}  // namespace clusterbench::scene
