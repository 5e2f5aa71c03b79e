#pragma once

#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

// The reasons of a failed run, a line each, from the `failures` of its cases, and from its broken cases.
std::vector<std::string> gate_failures(const result::Result& result);

}  // namespace clusterbench::report
