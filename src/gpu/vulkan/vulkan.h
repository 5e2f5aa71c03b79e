#pragma once
// Vulkan, loaded at run time by volk, and what its files here share.

#include <volk.h>

#include <string>

#include "gpu/device/device_facts.h"

namespace clusterbench::gpu {

// Throws DeviceError with the call's name and the meaning of the result, unless it is VK_SUCCESS.
void check(VkResult result, const char* call);

// The loader and an instance, opened at the first call and never closed.
struct Instance {
  VkInstance handle = VK_NULL_HANDLE;
  std::string obstacle;  // the reason why there is none
};
const Instance& instance();

std::vector<VkPhysicalDevice> physical_devices();

// How much the validation layer (CLUSTERBENCH_VULKAN_VALIDATION) has objected to: a count of its messages, and the
// first.
struct Objections {
  int count = 0;
  std::string first;
};
Objections objections();

struct PhysicalDevice {
  DeviceFacts facts;
  std::uint32_t queue_family = 0;  // with compute
};
PhysicalDevice facts_of(VkPhysicalDevice device);

}  // namespace clusterbench::gpu
