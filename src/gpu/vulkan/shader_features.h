#pragma once
// What shaders of users may declare beside plain computing, where the device has it.

#include <vector>

#include "gpu/vulkan/vulkan.h"

namespace clusterbench::gpu {

// Those of a device that are asked for when it is opened, chained: base, features11, features12. Not copied.
struct ShaderFeatures {
  explicit ShaderFeatures(VkPhysicalDevice device);
  ShaderFeatures(const ShaderFeatures&) = delete;
  ShaderFeatures& operator=(const ShaderFeatures&) = delete;

  // Numbers of SPIR-V's capabilities that these features allow, ascending. `operations`: those of subgroups.
  std::vector<std::uint32_t> capabilities(VkSubgroupFeatureFlags operations) const;

  VkPhysicalDeviceFeatures2 base{};
  VkPhysicalDeviceVulkan11Features features11{};
  VkPhysicalDeviceVulkan12Features features12{};
};

}  // namespace clusterbench::gpu
