#include "os/rereadable_inputs.h"

namespace clusterbench::os {

// Inputs are read once: Windows has no copies of a process (guarded_process.cpp) that would read them again.
RereadableInputs::RereadableInputs(const std::vector<std::string>&) {}

void RereadableInputs::rewind() const {}

}  // namespace clusterbench::os
