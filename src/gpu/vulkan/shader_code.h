#pragma once
// The shaders of src/gpu/shaders as SPIR-V. The definition is generated (cmake/ClusterbenchGpu.cmake).

#include <cstdint>
#include <span>
#include <string_view>

namespace clusterbench::gpu {

// Each shader exists twice: one asks the device to round to nearest, for devices that can. Throws Error for an unknown
// name.
std::span<const std::uint32_t> shader_code(std::string_view shader, bool rounds_to_nearest);

}  // namespace clusterbench::gpu
