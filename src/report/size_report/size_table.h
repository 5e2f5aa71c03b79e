#pragma once
// Allocations as a table.

#include <string>
#include <vector>

#include "report/shader_code/named_structures.h"
#include "report/sizing/sized_buffers.h"

namespace clusterbench::report {

// For each structure a heading and a row per buffer; below them the meaning of the columns. `remark`: a last line, or
// "".
std::string size_table(const std::vector<NamedStructure>& structures, const std::string& remark,
                       const AllocationRules& rules);

}  // namespace clusterbench::report
