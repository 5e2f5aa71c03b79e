#pragma once
// What holds for every assigner, given its descriptor: checked for the registered ones, and for those that a test
// defines.

#include <string>
#include <vector>

#include "assign/settings.h"

namespace clusterbench::assign::testing {

// Sentences about what is broken; none: the contract holds. Checked, in each form that the method
// answers in: the form of the lists, holes, lights without volume, that a structure gives at samples what its cells
// expand to, that nothing depends on what came before, that no light is lost (if the descriptor says so), and that a
// steady frame does not allocate.
std::vector<std::string> contract_faults(const AssignerDescriptor& assigner, const Params& params,
                                         const Setting& setting);

}  // namespace clusterbench::assign::testing
