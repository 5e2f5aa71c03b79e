#pragma once
// Which device a name means.

#include "gpu/device/device_facts.h"

namespace clusterbench::gpu {

// The index of the device that these words name: an index (of one or two digits), a UUID or its first eight digits or
// more, a name or a part of one name, in any case of letters. "": the best usable one: discrete before integrated
// before virtual before software. Throws Error (where = "device") with the devices that there are.
std::size_t chosen_device(const DeviceList& list, const std::string& wanted);

}  // namespace clusterbench::gpu
