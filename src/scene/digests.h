#pragma once
// Whether two scenes have the same lights, or a camera has the same path, independent of how their files are written.

#include <string>

#include "scene/scene.h"

namespace clusterbench::scene {

// 16 hexadecimal digits from the assigned lights: their number, and each one's kind, position, range, direction, angle
// and whether it is dark, at every key of the animations that move lights and in the middles between keys; and from the
// number of directional lights. Names, order, other colours and brightness, surfaces, cameras and their animations do
// not count. All numbers are rounded to single precision, so that a file may write more digits, or a node's transform
// as a matrix. The same motion with other keys counts as a different one.
std::string light_digest(const Scene& scene, int threads = 1);

// 16 hexadecimal digits from a camera's position, orientation and projection, at every key of the animations that move
// it and in the middles between keys. The number of measured moments does not count.
std::string camera_digest(const Scene& scene, const Camera& camera);

// Whether an animation moves, hides or changes a light. If not, world_lights() is the same at all times.
bool lights_change(const Scene& scene);

// Whether the light has no visible effect: intensity 0, black, or range 0. A box lights nothing and is dark only if its
// range is 0, like a hidden one.
bool is_dark(const WorldLight& light);

// Points and spots that are dark at all these times; among them those whose range is always 0, so that no list has
// them.
struct DarkLights {
  int all = 0, without_range = 0;
};
DarkLights count_dark_lights(const Scene& scene, int threads = 1);

}  // namespace clusterbench::scene
