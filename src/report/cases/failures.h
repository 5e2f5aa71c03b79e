#pragma once

#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

// What a run fails for, a line each, as its cases' `failures` say.
std::vector<std::string> gate_failures(const result::Result& result);

}  // namespace clusterbench::report
