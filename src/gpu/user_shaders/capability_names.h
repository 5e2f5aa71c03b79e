#pragma once
// Capabilities of SPIR-V, by number.

#include <cstdint>
#include <string>

namespace clusterbench::gpu {

// Its name; its number where it has none here.
std::string capability_name(std::uint32_t capability);
// Does this program ask devices for it? Of one that it does not, no device has anything to say.
bool is_capability_asked_for(std::uint32_t capability);

}  // namespace clusterbench::gpu
