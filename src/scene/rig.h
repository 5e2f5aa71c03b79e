#pragma once
// A rig of any size, made in memory, for measuring scaling. Reading a glTF file of a million lights takes most of a
// minute.

#include <cstdint>
#include <string>

#include "scene/scene.h"

namespace clusterbench::scene {

// Lights anywhere in a box: x and z around the origin, y upward from it. Spots are evenly distributed among the lights,
// point in any direction, and have half-angles of 15 to 60 degrees. A smaller rig is the beginning of a larger one.
struct RigSpec {
  int lights = 1000;
  double spots = 0.0;    // share of the lights, 0 to 1
  double range_m = 2.0;  // of every light
  Vec3d size_m{200.0, 55.0, 200.0};
  std::uint64_t seed = 1;

  // "rig-1000-r2", with "-s0.25", "-20x5x20" and "-seed7" if they are not the default.
  std::string name() const;
};

// The same to the bit on every machine; sha256 is that of the lights' numbers. One camera, "look", is fixed in the
// middle of the box's front (largest z), 1.7 m high or half as high as the box, and looks through it along -z: 60
// degrees high, from 0.1 m to the end of the box's diagonal.
Scene make_rig(const RigSpec& spec);

}  // namespace clusterbench::scene
