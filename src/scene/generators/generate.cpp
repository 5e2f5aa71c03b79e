#include "scene/generators/generate.h"

#include <array>

#include "core/error.h"
#include "core/text.h"
#include "scene/generators/scenes.h"

namespace clusterbench::scene {

std::span<const GeneratorRow> generators() {
  static const std::array<GeneratorRow, 15> k_rows{{
      {"hall-512", "512 point lights of 13 m in a hall of 200 x 55 x 200 m", "DaveH355", 512,
       [](Stage& s, int n) { build_hall(s, n, 13.0); }},
      {"hall-1024", "1024 point lights of 7 m in the same hall", "DaveH355", 1024,
       [](Stage& s, int n) { build_hall(s, n, 7.0); }},
      {"hall-2048", "2048 point lights of 3 m in the same hall", "DaveH355", 2048,
       [](Stage& s, int n) { build_hall(s, n, 3.0); }},
      {"hall-4096", "4096 point lights of 2 m in the same hall", "DaveH355", 4096,
       [](Stage& s, int n) { build_hall(s, n, 2.0); }},
      {"open-world", "roads, villages, floodlights and moving cars over 500 m, seen from the ground", "Persson 2015",
       700, build_open_world},
      {"street", "a deep, narrow street of lamps and shop windows", "Avalanche's worst views", 300, build_street},
      {"jam", "many large lights jammed in front of the player", "Persson 2015, the worst case of an allocation", 600,
       build_jam},
      {"mirror", "lights all around a camera that turns", "reflections that need lights behind the camera", 400,
       build_mirror},
      {"outlier", "a village, a light at 1,000 km and one of 100 km range", "levels in production", 160, build_outlier},
      {"lattice", "lights on whole metres that just touch the picture's middle planes", "levels built on a lattice",
       1000, [](Stage& s, int n) { build_lattice(s, n, Vec3d(0.0)); }},
      {"lattice-off", "the same lights, a centimetre or two beside the lattice", "levels built on a lattice", 1000,
       [](Stage& s, int n) {
         build_lattice(s, n, {0.013, 0.017, 0.011});
       }},
      {"steps", "poles and leaves before a wall: depths that jump from pixel to pixel, with surfaces", "Persson 2015",
       300, build_steps},
      {"slope", "a hallway and open ground, both seen along their surfaces, with surfaces", "Persson 2015", 300,
       build_slope},
      {"mix", "a street with poles and leaves, both kinds of depths, with surfaces", "Persson 2015", 300, build_mix},
      {"rooms", "rooms along a hallway with decals and environment probes as boxes, with surfaces",
       "Wicked Engine 2018, decals and probes", 96, build_rooms},
  }};
  return k_rows;
}

std::string make_scene(const GeneratorRow& row, std::uint64_t seed, int lights) {
  Stage stage(seed);
  row.build(stage, lights > 0 ? lights : row.default_lights);
  return stage.glb("clusterbench scene generate " + row.name + " --seed " + std::to_string(seed));
}

std::string make_scene(const std::string& name, std::uint64_t seed, int lights) {
  std::vector<std::string> names;
  for (const GeneratorRow& row : generators()) {
    names.push_back(row.name);
    if (row.name == name) return make_scene(row, seed, lights);
  }
  throw Error("", "scene",
              "there is no scene '" + name + "'" + did_you_mean(name, names) + "; there are: " + joined(names));
}

}  // namespace clusterbench::scene
