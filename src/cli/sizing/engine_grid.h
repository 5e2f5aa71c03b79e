#pragma once
// `size --engine` with flags that name another grid: what of them an engine can be set to.

#include <string>

#include "cli/options/run_inputs.h"

namespace clusterbench::cli {

// Has the engine's preset measured, and of its grid what the flags of `inputs` say in place of the engine's own: they
// become inputs.preset_grid. Method and lists stay the engine's. Says whether flags changed the grid. Throws Error that
// names a flag which says what the engine has no setting for.
bool choose_engine_clustering(const std::string& engine, RunInputs& inputs);

}  // namespace clusterbench::cli
