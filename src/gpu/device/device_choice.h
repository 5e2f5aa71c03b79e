#pragma once
// Which device a name means, and what it lacks.

#include "gpu/device/device_facts.h"

namespace clusterbench::gpu {

// The index of the device that these words name: an index (of one or two digits), a UUID or its first eight digits or
// more, a name or a part of one name, in any case of letters. "": the best usable one: discrete before integrated
// before virtual before software. Throws Error (where = "device") with the devices that there are.
std::size_t chosen_device(const DeviceList& list, const std::string& wanted);

// What a shader takes of a device that not each device has.
struct Needs {
  bool ballots = false, subgroup_arithmetic = false, full_subgroups = false;
};
// What a device lacks of them, as "has no ballots in subgroups": the first of several. "" if it has all.
std::string lacking(const DeviceFacts& device, const Needs& needs);

// The index of a device that was open before: the same UUID and, since one card can have several drivers, the same name
// and driver. Throws Error if it is gone.
std::size_t same_device(const DeviceList& list, const DeviceFacts& before);

}  // namespace clusterbench::gpu
