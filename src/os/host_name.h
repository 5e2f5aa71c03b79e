#pragma once
// The name of the machine in its network.

#include <string>

namespace clusterbench::os {

// "" if the system does not tell it.
std::string host_name();

}  // namespace clusterbench::os
