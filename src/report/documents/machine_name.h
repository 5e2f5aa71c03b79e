#pragma once
// The machine of a result, without its state of then, and by a name that no other kind of processor has.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// What it is, without how it was just then: clock and load.
result::Machine without_state(result::Machine machine);

// "AMD EPYC (family 26, model 2, stepping 1; L1d 48 KiB, L1i 32 KiB, L2 1 MiB, L3 32 MiB)" of a result's `machine`; of
// an older one, which does not know all of that, less.
std::string machine_name(const result::Machine& machine);

}  // namespace clusterbench::report
