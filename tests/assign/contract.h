#pragma once
// What holds for every assigner, given its row: checked for the registered ones, and for those that a test defines.

#include <string>
#include <vector>

#include "assign/settings.h"

namespace clusterbench::assign::testing {

// Sentences about what is broken; none: the contract holds. Checked: the form of the lists, holes, lights without
// volume, that nothing depends on what came before, that no light is lost (if the row says so), and that a steady frame
// does not allocate.
std::vector<std::string> contract_faults(const AssignerRow& row, const Params& params, const Setting& setting);

}  // namespace clusterbench::assign::testing
