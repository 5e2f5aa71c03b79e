#pragma once
// Cameras drawn in one frame into one buffer (--views), each with its own grid or all with that of one (--grid-of).

#include <string>
#include <vector>

#include "report/sizing/sized_structure.h"

namespace clusterbench::report {

// Sets views, guests and left_out of each structure, and removes the cases of cameras that are left out. `views`: each
// names cameras, "left,right"; a name may contain *. `grid_of`: the only camera with a grid; "": each has its own.
// Throws Error for a name that no camera has, for views that name fewer than two cameras of every scene, and for
// `grid_of` without views or with a camera that none of them names.
void set_views(std::vector<SizedStructure>& structures, const std::vector<std::string>& views,
               const std::string& grid_of);

}  // namespace clusterbench::report
