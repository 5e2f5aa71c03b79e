#pragma once
// What an engine's own limits change of what `size` counts: a setting is sized by what the engine asks for, and not by
// what it makes of too little room.

#include <vector>

#include "config/config.h"
#include "report/sizing/allocation.h"
#include "run/cases/sweep.h"

namespace clusterbench::cli {

// Without limits on the number of lights, and with tiles that do not grow where lists have no room. What a storage
// drops changes no buffer's need, and tiles that follow the lights in view (mask-words) are the engine's grid itself.
config::Config without_engine_limits(config::Config config);

// Of each case of the plan whose tiles grow in `limited`, the configuration as it was: what they come to.
std::vector<report::GrownTiles> grown_tiles(const config::Config& limited, const run::Plan& plan);

}  // namespace clusterbench::cli
