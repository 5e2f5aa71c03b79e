#pragma once
// In which settings two cases differ that have one name, or stand for one another before and after a change.

#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

// Of a result and a case of it each. Empty: none that results tell.
std::vector<std::string> differing_settings(const result::Result& base, const result::Case& base_case,
                                            const result::Result& next, const result::Case& next_case);

}  // namespace clusterbench::report
