#pragma once
// What a shader takes of a device that not each device has, read from its module.

#include <cstdint>
#include <span>

#include "gpu/device/device_choice.h"

namespace clusterbench::gpu {

Needs needs_of(std::span<const std::uint32_t> code);

}  // namespace clusterbench::gpu
