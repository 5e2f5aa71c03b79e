#pragma once
// `clusterbench run --write-dump FOLDER`: the lists of a plan's cases as dumps for `clusterbench check`.

#include <string>
#include <vector>

#include "run/cases/plan.h"

namespace clusterbench::cli {

struct WrittenDumps {
  std::size_t count = 0;
  // Of cases that have no dump, the reason; of those whose storage had no room for all lights, how many.
  std::vector<std::string> remarks;
};

// `frames`: of each case, evenly spaced on its path. Throws Error if a file cannot be written, and if no case has lists
// that a dump describes.
WrittenDumps write_dumps(const config::Config& config, const run::Plan& plan, const std::string& folder, int frames);

}  // namespace clusterbench::cli
