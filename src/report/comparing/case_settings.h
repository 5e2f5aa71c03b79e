#pragma once
// The settings in which two cases differ that have the same name, or correspond before and after a change.

#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

// For a case of each result. Empty: no recorded difference.
std::vector<std::string> differing_settings(const result::Result& base, const result::Case& base_case,
                                            const result::Result& next, const result::Case& next_case);

}  // namespace clusterbench::report
