#pragma once
// Seeded scenes made by this project: light rigs with an animated camera, written as binary glTF.

#include <cstdint>
#include <span>
#include <string>

namespace clusterbench::scene {

class Stage;

struct GeneratorRow {
  std::string name;
  std::string summary;
  std::string source;  // source of its figures
  int default_lights;
  void (*build)(Stage& stage, int lights);
};

std::span<const GeneratorRow> generators();

// The bytes of a .glb file: the same for the same seed on every machine. `lights` = 0: the scene's own number.
std::string make_scene(const GeneratorRow& row, std::uint64_t seed, int lights);

// Throws Error for an unknown name (with did-you-mean).
std::string make_scene(const std::string& name, std::uint64_t seed, int lights);

}  // namespace clusterbench::scene
