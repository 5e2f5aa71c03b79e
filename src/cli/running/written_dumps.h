#pragma once
// `clusterbench run --write-dump FOLDER`: the lists of a plan's cases as dumps for `clusterbench check`.

#include <string>

#include "run/cases/plan.h"

namespace clusterbench::cli {

// `frames`: of each case, evenly spaced on its path. Returns how many dumps were written. Throws Error.
std::size_t write_dumps(const config::Config& config, const run::Plan& plan, const std::string& folder, int frames);

}  // namespace clusterbench::cli
