#pragma once
// A frame with its grid and lights, from a scene file.

#include <string>

#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench {

struct Setting {
  view::Frame frame;
  grid::Grid grid;
  view::LightArrays lights;
};

// The frame at this share of the first camera path, 1920 x 1080. range_m > 0: what all lights get.
Setting make_setting(const std::string& file, const grid::GridSpec& spec, double share_of_path, float range_m = 0.0f);

// A file of this project's own scenes.
std::string own_scene(const std::string& name);
// A file of the peers' workloads.
std::string peer_workload(const std::string& name);

}  // namespace clusterbench
