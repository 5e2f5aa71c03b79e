#pragma once
// Whether two scenes have the same lights, and a camera the same path, however their files are written.

#include <string>

#include "scene/scene.h"

namespace clusterbench::scene {

// 16 hexadecimal digits from the lights that are assigned: how many there are, and kind, position, range, direction and
// angle of each, and whether it is dark, at every key of the animations that lights follow and in the middles between
// keys; and from how many directional lights there are. Names, order, other colours and brightness, surfaces and
// cameras do not count, nor what moves these. All numbers are rounded to single precision, so that it does not count
// either whether a file writes them with more digits, or a node's transform as a matrix. The same motion with other
// keys counts as another one.
std::string light_digest(const Scene& scene);

// 16 hexadecimal digits from what a camera shows: where it stands, how it looks and its projection, at every key of the
// animations that it follows and in the middles between keys. At how many moments it is measured does not count.
std::string camera_digest(const Scene& scene, const Camera& camera);

// Whether nothing would look other without it: a light of intensity 0, black, or of range 0. A box lights nothing and
// is dark only without a range, as one that is hidden.
bool is_dark(const WorldLight& light);

// Points and spots that are dark at all these times; of them those that have a range at none, so that no list has them.
struct DarkLights {
  int all = 0, without_range = 0;
};
DarkLights count_dark_lights(const Scene& scene);

}  // namespace clusterbench::scene
