#include "gpu/vulkan/shader_features.h"

#include <algorithm>

namespace clusterbench::gpu {

ShaderFeatures::ShaderFeatures(VkPhysicalDevice device) {
  VkPhysicalDeviceVulkan11Features has11{};
  VkPhysicalDeviceVulkan12Features has12{};
  VkPhysicalDeviceFeatures2 has{};
  has.sType = base.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  has11.sType = features11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
  has12.sType = features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  has.pNext = &has11;
  has11.pNext = &has12;
  vkGetPhysicalDeviceFeatures2(device, &has);
  base.pNext = &features11;
  features11.pNext = &features12;

  for (const auto member :
       {&VkPhysicalDeviceFeatures::shaderInt16, &VkPhysicalDeviceFeatures::shaderInt64,
        &VkPhysicalDeviceFeatures::shaderFloat64, &VkPhysicalDeviceFeatures::shaderUniformBufferArrayDynamicIndexing,
        &VkPhysicalDeviceFeatures::shaderStorageBufferArrayDynamicIndexing})
    base.features.*member = has.features.*member;
  features11.storageBuffer16BitAccess = has11.storageBuffer16BitAccess;
  features11.uniformAndStorageBuffer16BitAccess = has11.uniformAndStorageBuffer16BitAccess;
  for (const auto member :
       {&VkPhysicalDeviceVulkan12Features::storageBuffer8BitAccess,
        &VkPhysicalDeviceVulkan12Features::uniformAndStorageBuffer8BitAccess,
        &VkPhysicalDeviceVulkan12Features::shaderFloat16, &VkPhysicalDeviceVulkan12Features::shaderInt8,
        &VkPhysicalDeviceVulkan12Features::shaderBufferInt64Atomics,
        &VkPhysicalDeviceVulkan12Features::scalarBlockLayout,
        &VkPhysicalDeviceVulkan12Features::uniformBufferStandardLayout,
        &VkPhysicalDeviceVulkan12Features::shaderSubgroupExtendedTypes,
        &VkPhysicalDeviceVulkan12Features::vulkanMemoryModel,
        &VkPhysicalDeviceVulkan12Features::vulkanMemoryModelDeviceScope})
    features12.*member = has12.*member;
}

std::vector<std::uint32_t> ShaderFeatures::capabilities(VkSubgroupFeatureFlags operations) const {
  std::vector<std::uint32_t> all{0, 1, 50};  // Matrix, Shader, ImageQuery
  const auto add = [&](bool is_there, std::uint32_t capability) {
    if (is_there) all.push_back(capability);
  };
  const VkPhysicalDeviceFeatures& plain = base.features;
  add(plain.shaderInt16 != 0, 22);
  add(plain.shaderInt64 != 0, 11);
  add(plain.shaderFloat64 != 0, 10);
  add(plain.shaderUniformBufferArrayDynamicIndexing != 0, 28);
  add(plain.shaderStorageBufferArrayDynamicIndexing != 0, 30);
  add(features11.storageBuffer16BitAccess != 0, 4433);
  add(features11.uniformAndStorageBuffer16BitAccess != 0, 4434);
  add(features12.storageBuffer8BitAccess != 0, 4448);
  add(features12.uniformAndStorageBuffer8BitAccess != 0, 4449);
  add(features12.shaderFloat16 != 0, 9);
  add(features12.shaderInt8 != 0, 39);
  add(features12.shaderBufferInt64Atomics != 0, 12);
  add(features12.vulkanMemoryModel != 0, 5345);
  add(features12.vulkanMemoryModelDeviceScope != 0, 5346);
  // GroupNonUniform and its kinds, in the order of Vulkan's bits; Shuffle and ShuffleRelative before Clustered.
  constexpr std::uint32_t k_first_operation = 61;
  constexpr VkSubgroupFeatureFlagBits k_operations[] = {
      VK_SUBGROUP_FEATURE_BASIC_BIT,     VK_SUBGROUP_FEATURE_VOTE_BIT,    VK_SUBGROUP_FEATURE_ARITHMETIC_BIT,
      VK_SUBGROUP_FEATURE_BALLOT_BIT,    VK_SUBGROUP_FEATURE_SHUFFLE_BIT, VK_SUBGROUP_FEATURE_SHUFFLE_RELATIVE_BIT,
      VK_SUBGROUP_FEATURE_CLUSTERED_BIT, VK_SUBGROUP_FEATURE_QUAD_BIT};
  for (std::uint32_t i = 0; i < std::size(k_operations); ++i)
    add((operations & k_operations[i]) != 0, k_first_operation + i);
  std::ranges::sort(all);
  return all;
}

}  // namespace clusterbench::gpu
