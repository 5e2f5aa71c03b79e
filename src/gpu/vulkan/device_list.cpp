#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/error.h"
#include "gpu/device/device.h"
#include "gpu/vulkan/shader_features.h"
#include "gpu/vulkan/vulkan.h"

namespace clusterbench::gpu {
namespace {

DeviceType type_of(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return DeviceType::discrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return DeviceType::integrated;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return DeviceType::virtual_gpu;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return DeviceType::software;
    default:
      return DeviceType::other;
  }
}

std::string version_text(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

std::string hex(const std::uint8_t (&bytes)[VK_UUID_SIZE]) {
  static constexpr char k_digits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += k_digits[byte >> 4];
    text += k_digits[byte & 15];
  }
  return text;
}

// The number of the first family of queues that compute; none: the number of families.
std::uint32_t compute_family(const std::vector<VkQueueFamilyProperties>& families) {
  std::uint32_t family = 0;
  while (family < families.size() && (families[family].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) ++family;
  return family;
}

std::string limit_obstacle(const VkPhysicalDeviceLimits& limits) {
  if (limits.maxPerStageDescriptorStorageBuffers < Buffers::k_bindings)
    return "lets a shader see " + std::to_string(limits.maxPerStageDescriptorStorageBuffers) + " buffers; " +
           std::to_string(Buffers::k_bindings) + " are needed";
  if (limits.maxPushConstantsSize < sizeof(Arguments))
    return "takes " + std::to_string(limits.maxPushConstantsSize) + " bytes of arguments; " +
           std::to_string(sizeof(Arguments)) + " are needed";
  return "";
}

bool has_extension(const std::vector<VkExtensionProperties>& all, const char* name) {
  return std::ranges::any_of(all,
                             [&](const VkExtensionProperties& one) { return one.extensionName == std::string(name); });
}

// What is used only where it is there: a clock that shaders read, and what the driver tells of them.
void add_extras(VkPhysicalDevice device, DeviceFacts& facts) {
  std::uint32_t count = 0;
  check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr), "vkEnumerateDeviceExtensionProperties");
  std::vector<VkExtensionProperties> all(count);
  check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, all.data()),
        "vkEnumerateDeviceExtensionProperties");
  VkPhysicalDeviceShaderClockFeaturesKHR clock{};
  clock.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_CLOCK_FEATURES_KHR;
  VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR told{};
  told.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  if (has_extension(all, VK_KHR_SHADER_CLOCK_EXTENSION_NAME)) clock.pNext = std::exchange(features.pNext, &clock);
  if (has_extension(all, VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME))
    told.pNext = std::exchange(features.pNext, &told);
  VkPhysicalDevicePipelineRobustnessFeaturesEXT robustness{};
  robustness.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_ROBUSTNESS_FEATURES_EXT;
  if (has_extension(all, VK_EXT_PIPELINE_ROBUSTNESS_EXTENSION_NAME))
    robustness.pNext = std::exchange(features.pNext, &robustness);
  VkPhysicalDeviceSubgroupSizeControlFeatures subgroups{};  // of an extension, and a part of Vulkan 1.3
  subgroups.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES;
  if (facts.has_vulkan_1_3 || has_extension(all, VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME))
    subgroups.pNext = std::exchange(features.pNext, &subgroups);
  vkGetPhysicalDeviceFeatures2(device, &features);
  facts.has_full_subgroups = subgroups.subgroupSizeControl != VK_FALSE && subgroups.computeFullSubgroups != VK_FALSE;
  facts.has_pipeline_robustness = robustness.pipelineRobustness != VK_FALSE;
  facts.has_shader_clock = clock.shaderSubgroupClock != VK_FALSE;
  facts.tells_shader_statistics = told.pipelineExecutableInfo != VK_FALSE;
}

}  // namespace

PhysicalDevice facts_of(VkPhysicalDevice device) {
  VkPhysicalDeviceVulkan12Properties properties12{};
  properties12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES;
  VkPhysicalDeviceVulkan11Properties properties11{};
  properties11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
  properties11.pNext = &properties12;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &properties11;

  PhysicalDevice found;
  DeviceFacts& facts = found.facts;
  vkGetPhysicalDeviceProperties(device, &properties.properties);  // what it supports decides what else may be asked
  facts.name = properties.properties.deviceName;
  facts.type = type_of(properties.properties.deviceType);
  facts.vulkan = version_text(properties.properties.apiVersion);
  if (properties.properties.apiVersion < VK_API_VERSION_1_2) {
    facts.obstacle = "has Vulkan " + facts.vulkan + "; 1.2 is needed";
    return found;
  }
  facts.has_vulkan_1_3 = properties.properties.apiVersion >= VK_API_VERSION_1_3;
  vkGetPhysicalDeviceProperties2(device, &properties);
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());

  facts.driver = properties12.driverName;
  if (*properties12.driverInfo != '\0') facts.driver += std::string(" ") + properties12.driverInfo;
  facts.uuid = hex(properties11.deviceUUID);
  const VkPhysicalDeviceLimits& limits = properties.properties.limits;
  facts.max_buffer_bytes = limits.maxStorageBufferRange;
  facts.max_group_size = limits.maxComputeWorkGroupInvocations;
  facts.shared_bytes = limits.maxComputeSharedMemorySize;
  std::ranges::copy(limits.maxComputeWorkGroupSize, facts.max_group_sizes.begin());
  std::ranges::copy(limits.maxComputeWorkGroupCount, facts.max_groups.begin());
  facts.max_argument_bytes = limits.maxPushConstantsSize;
  facts.max_sets = limits.maxBoundDescriptorSets;
  facts.max_storage_buffers = limits.maxPerStageDescriptorStorageBuffers;
  facts.max_uniform_buffers = limits.maxPerStageDescriptorUniformBuffers;
  facts.max_uniform_bytes = limits.maxUniformBufferRange;
  facts.subgroup_size = properties11.subgroupSize;
  facts.timestamp_period_ns = static_cast<double>(limits.timestampPeriod);
  facts.rounds_to_nearest =
      properties12.shaderRoundingModeRTEFloat32 != 0 && properties12.shaderSignedZeroInfNanPreserveFloat32 != 0;
  const bool has_subgroups = (properties11.subgroupSupportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
  const VkSubgroupFeatureFlags operations = has_subgroups ? properties11.subgroupSupportedOperations : 0;
  facts.has_ballots = (operations & VK_SUBGROUP_FEATURE_BALLOT_BIT) != 0;
  facts.has_subgroup_arithmetic = facts.has_ballots && (operations & VK_SUBGROUP_FEATURE_ARITHMETIC_BIT) != 0;
  facts.capabilities = ShaderFeatures(device).capabilities(operations);
  if (properties12.shaderDenormPreserveFloat32 != 0) facts.capabilities.push_back(4464);
  if (properties12.shaderDenormFlushToZeroFloat32 != 0) facts.capabilities.push_back(4465);
  if (properties12.shaderSignedZeroInfNanPreserveFloat32 != 0) facts.capabilities.push_back(4466);
  if (properties12.shaderRoundingModeRTEFloat32 != 0) facts.capabilities.push_back(4467);
  if (properties12.shaderRoundingModeRTZFloat32 != 0) facts.capabilities.push_back(4468);
  std::ranges::sort(facts.capabilities);
  add_extras(device, facts);
  found.queue_family = compute_family(families);
  if (found.queue_family < count) facts.timestamp_bits = families[found.queue_family].timestampValidBits;
  facts.obstacle = found.queue_family == count ? "has no queue that computes" : limit_obstacle(limits);
  return found;
}

DeviceList list_devices() {
  DeviceList list;
  list.obstacle = instance().obstacle;
  if (!list.obstacle.empty()) return list;
  try {
    for (VkPhysicalDevice device : physical_devices()) list.devices.push_back(facts_of(device).facts);
  } catch (const Error& error) {
    list.obstacle = error.message();
  }
  if (list.devices.empty() && list.obstacle.empty())
    list.obstacle = "Vulkan has no driver for any device of this machine (Debian: mesa-vulkan-drivers)";
  return list;
}

}  // namespace clusterbench::gpu
