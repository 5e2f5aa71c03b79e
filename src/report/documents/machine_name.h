#pragma once
// The machine of a result, without its state at that time, and a name that identifies the kind of processor.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// The kind of machine: without its state (clock and load) and its host.
result::Machine machine_kind(result::Machine machine);

// "AMD EPYC (family 26, model 2, stepping 1; L1d 48 KiB, L1i 32 KiB, L2 1 MiB, L3 32 MiB)" for a result's `machine`;
// shorter for an older result without some of that.
std::string machine_name(const result::Machine& machine);

}  // namespace clusterbench::report
