#pragma once
// Removes an engine's own limits for `size`: a setting is sized by the engine's needs, not by its behaviour with too
// little room.

#include <vector>

#include "config/config.h"
#include "report/sizing/allocation.h"
#include "run/sweep.h"

namespace clusterbench::cli {

// Without limits on the number of lights, and with tiles that do not grow when lists have no room. Limits of a storage
// stay, since dropped entries do not change the needs of buffers; so do tiles that follow the lights in view
// (mask-words), since they are the engine's grid itself.
config::Config without_engine_limits(config::Config config);

// For each case of the plan whose tiles grow in `limited`, the engine's configuration: their sizes after growing.
std::vector<report::GrownTiles> grown_tiles(const config::Config& limited, const run::Plan& plan);

}  // namespace clusterbench::cli
