#pragma once
// The methods that run on a device. registry.inc of assign cannot name them: that layer knows no device.

#include "assign/contract/assigner.h"

namespace clusterbench::gpu {

// Adds them to the registry, once in a process.
void register_methods();

}  // namespace clusterbench::gpu
