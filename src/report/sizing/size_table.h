#pragma once
// Allocations as a table for people.

#include <string>
#include <vector>

#include "report/sizing/named_structures.h"

namespace clusterbench::report {

// Of each structure a heading and a row per buffer; below all what the columns mean. `remark`: a last line, or "".
std::string size_table(const std::vector<NamedStructure>& structures, const std::string& remark,
                       const AllocationRules& rules);

}  // namespace clusterbench::report
