#pragma once
// `size --engine` with flags that name another grid: the part of them that an engine can be set to.

#include <string>

#include "cli/options/run_inputs.h"

namespace clusterbench::cli {

// Selects the engine's preset for measuring. The grid flags of `inputs` replace parts of the engine's grid: they become
// inputs.preset_grid. Method and lists stay the engine's. Returns whether flags changed the grid. Throws Error that
// names a flag for which the engine has no setting.
bool choose_engine_clustering(const std::string& engine, RunInputs& inputs);

}  // namespace clusterbench::cli
