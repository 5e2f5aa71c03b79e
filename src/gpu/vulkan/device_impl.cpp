#include "gpu/vulkan/device_impl.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.h"
#include "gpu/device/device_choice.h"
#include "gpu/device/span_length.h"
#include "gpu/vulkan/shader_code.h"
#include "gpu/vulkan/shader_features.h"
#include "gpu/vulkan/shader_needs.h"
#include "gpu/vulkan/shader_statistics.h"

namespace clusterbench::gpu {

Device::Device(const std::string& wanted, const DeviceFacts* before, bool has_robust_buffers)
    : impl_(std::make_unique<Impl>(wanted, before, has_robust_buffers)) {}
Device::~Device() = default;

const DeviceFacts& Device::facts() const {
  return impl_->facts;
}

std::string Device::obstacle(const std::string& shader) const {
  return impl_->obstacle(shader);
}

Kernel Device::kernel(const std::string& shader, std::uint32_t group_size, std::uint32_t mode) {
  const std::lock_guard turn(impl_->turn);
  return impl_->kernel(shader, group_size, mode);
}

std::vector<assign::ShaderStatistic> Device::statistics(Kernel kernel) const {
  const std::lock_guard turn(impl_->turn);
  return impl_->statistics(kernel);
}

std::uint64_t Device::reserve_flushed() {
  const std::lock_guard turn(impl_->turn);
  Memory& memory = impl_->flushed;
  if (memory.buffer == VK_NULL_HANDLE) {
    const std::uint64_t wanted = facts().is_software() ? k_flushed_bytes_of_software : k_flushed_bytes;
    memory = impl_->allocate(std::min(wanted, facts().max_buffer_bytes) / 4 * 4, Place::device);
  }
  return memory.bytes;
}

Device::Impl::Impl(const std::string& wanted, const DeviceFacts* before, bool has_robust_buffers) : Impl() {
  const DeviceList list = list_devices();
  const std::size_t index = before != nullptr ? same_device(list, *before) : chosen_device(list, wanted);
  physical = physical_devices().at(index);
  PhysicalDevice found = facts_of(physical);
  facts = std::move(found.facts);
  create_device(found.queue_family, has_robust_buffers);
  create_layout();
}

Device::Impl::~Impl() {
  if (device == VK_NULL_HANDLE || is_stuck) return;
  vkDeviceWaitIdle(device);
  free(flushed);
  for (VkPipeline pipeline : pipelines) vkDestroyPipeline(device, pipeline, nullptr);
  vkDestroyPipelineLayout(device, layout, nullptr);
  vkDestroyDescriptorSetLayout(device, bindings, nullptr);
  vkDestroyQueryPool(device, marks, nullptr);
  vkDestroyFence(device, fence, nullptr);
  vkDestroyCommandPool(device, pool, nullptr);
  vkDestroyDevice(device, nullptr);
}

void Device::Impl::create_device(std::uint32_t queue_family, bool has_robust_buffers) {
  ShaderFeatures optional(physical);
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.features = optional.base.features;
  features.features.robustBufferAccess = has_robust_buffers && !facts.has_pipeline_robustness ? VK_TRUE : VK_FALSE;
  features.pNext = &optional.features11;
  std::vector<const char*> extensions;
  VkPhysicalDeviceMaintenance4Features local_sizes{};
  local_sizes.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES;
  local_sizes.maintenance4 = VK_TRUE;  // modules of SPIR-V 1.6 may name their group's size by constants
  if (facts.has_vulkan_1_3) local_sizes.pNext = std::exchange(features.pNext, &local_sizes);
  VkPhysicalDeviceSubgroupSizeControlFeatures subgroups{};
  subgroups.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES;
  subgroups.subgroupSizeControl = subgroups.computeFullSubgroups = VK_TRUE;
  if (facts.has_full_subgroups) {
    if (!facts.has_vulkan_1_3) extensions.push_back(VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME);
    subgroups.pNext = std::exchange(features.pNext, &subgroups);
  }
  VkPhysicalDevicePipelineRobustnessFeaturesEXT robustness{};
  robustness.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_ROBUSTNESS_FEATURES_EXT;
  robustness.pipelineRobustness = VK_TRUE;
  if (facts.has_pipeline_robustness) {
    extensions.push_back(VK_EXT_PIPELINE_ROBUSTNESS_EXTENSION_NAME);
    robustness.pNext = std::exchange(features.pNext, &robustness);
  }
  VkPhysicalDeviceShaderClockFeaturesKHR clock{};
  clock.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_CLOCK_FEATURES_KHR;
  clock.shaderSubgroupClock = VK_TRUE;
  if (facts.has_shader_clock) {
    extensions.push_back(VK_KHR_SHADER_CLOCK_EXTENSION_NAME);
    clock.pNext = std::exchange(features.pNext, &clock);
  }
  VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR told{};
  told.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
  told.pipelineExecutableInfo = VK_TRUE;
  if (facts.tells_shader_statistics) {
    extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
    told.pNext = std::exchange(features.pNext, &told);
  }
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue_info{};
  queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue_info.queueFamilyIndex = queue_family;
  queue_info.queueCount = 1;
  queue_info.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue_info;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  check(vkCreateDevice(physical, &info, nullptr, &device), "vkCreateDevice");
  volkLoadDevice(device);
  capture = FrameCapture::find();
  vkGetDeviceQueue(device, queue_family, 0, &queue);
  vkGetPhysicalDeviceMemoryProperties(physical, &memory_properties);

  VkCommandPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool_info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  pool_info.queueFamilyIndex = queue_family;
  check(vkCreateCommandPool(device, &pool_info, nullptr, &pool), "vkCreateCommandPool");
  VkCommandBufferAllocateInfo commands_info{};
  commands_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  commands_info.commandPool = pool;
  commands_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commands_info.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(device, &commands_info, &commands), "vkAllocateCommandBuffers");
  VkFenceCreateInfo fence_info{};
  fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  check(vkCreateFence(device, &fence_info, nullptr, &fence), "vkCreateFence");
  VkQueryPoolCreateInfo marks_info{};
  marks_info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  marks_info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  marks_info.queryCount = k_marks;
  check(vkCreateQueryPool(device, &marks_info, nullptr, &marks), "vkCreateQueryPool");
}

// One layout for all kernels: storage buffers at all bindings, and the arguments.
void Device::Impl::create_layout() {
  std::array<VkDescriptorSetLayoutBinding, Buffers::k_bindings> each{};
  for (std::uint32_t i = 0; i < each.size(); ++i)
    each[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo bindings_info{};
  bindings_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  bindings_info.bindingCount = static_cast<std::uint32_t>(each.size());
  bindings_info.pBindings = each.data();
  check(vkCreateDescriptorSetLayout(device, &bindings_info, nullptr, &bindings), "vkCreateDescriptorSetLayout");
  const VkPushConstantRange arguments{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(Arguments)};
  VkPipelineLayoutCreateInfo layout_info{};
  layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layout_info.setLayoutCount = 1;
  layout_info.pSetLayouts = &bindings;
  layout_info.pushConstantRangeCount = 1;
  layout_info.pPushConstantRanges = &arguments;
  check(vkCreatePipelineLayout(device, &layout_info, nullptr, &layout), "vkCreatePipelineLayout");
}

Kernel Device::Impl::kernel(const std::string& shader, std::uint32_t group_size, std::uint32_t mode) {
  const std::lock_guard lock(turn);
  const std::tuple key{shader, group_size, mode};
  if (const auto found = kernels.find(key); found != kernels.end()) return found->second;
  pipelines.push_back(VK_NULL_HANDLE);  // first, so that no memory is missing for what is made
  try {
    pipelines.back() = create_pipeline(shader, group_size, mode);
  } catch (...) {
    pipelines.pop_back();
    throw;
  }
  return kernels[key] = static_cast<Kernel>(pipelines.size() - 1);
}

std::string Device::Impl::obstacle(const std::string& shader) const {
  const std::string lacks = lacking(facts, needs_of(shader_code(shader, facts.rounds_to_nearest)));
  return lacks.empty() ? "" : facts.name + " " + lacks + ", which " + shader + " needs";
}

VkPipeline Device::Impl::create_pipeline(const std::string& shader, std::uint32_t group_size,
                                         std::uint32_t mode) const {
  if (group_size > facts.max_group_size)
    throw DeviceError(facts.name + " runs at most " + std::to_string(facts.max_group_size) +
                      " invocations in a group; " + shader + " needs " + std::to_string(group_size));
  if (const std::string reason = obstacle(shader); !reason.empty()) throw DeviceError(reason);
  const std::span<const std::uint32_t> code = shader_code(shader, facts.rounds_to_nearest);
  VkShaderModuleCreateInfo module_info{};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module_info.codeSize = code.size_bytes();
  module_info.pCode = code.data();
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device, &module_info, nullptr, &module), "vkCreateShaderModule");
  const std::array<std::uint32_t, 2> values{group_size, mode};
  const std::array<VkSpecializationMapEntry, 2> entries{{{0, 0, 4}, {1, 4, 4}}};
  const VkSpecializationInfo constants{static_cast<std::uint32_t>(entries.size()), entries.data(), sizeof values,
                                       values.data()};
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  if (facts.has_full_subgroups && group_size % facts.subgroup_size == 0)
    info.stage.flags = VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &constants;
  info.layout = layout;
  if (facts.tells_shader_statistics) info.flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
  VkPipeline pipeline = VK_NULL_HANDLE;
  const VkResult result = vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
  vkDestroyShaderModule(device, module, nullptr);
  check(result, "vkCreateComputePipelines");
  return pipeline;
}

std::string Device::Impl::name_of(Kernel kernel) const {
  const auto& [shader, group_size, mode] =
      std::ranges::find(kernels, kernel, [](const auto& entry) { return entry.second; })->first;
  return shader + (mode == 0 ? "" : ", mode " + std::to_string(mode));
}

std::vector<assign::ShaderStatistic> Device::Impl::statistics(Kernel kernel) const {
  return statistics_of(pipelines.at(kernel), name_of(kernel));
}

std::vector<assign::ShaderStatistic> Device::Impl::statistics_of(VkPipeline of, const std::string& shader) const {
  std::vector<assign::ShaderStatistic> out;
  if (!facts.tells_shader_statistics) return out;
  VkPipelineInfoKHR pipeline{};
  pipeline.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR;
  pipeline.pipeline = of;
  std::uint32_t executables = 0;
  check(vkGetPipelineExecutablePropertiesKHR(device, &pipeline, &executables, nullptr),
        "vkGetPipelineExecutablePropertiesKHR");
  for (std::uint32_t executable = 0; executable < executables; ++executable) {
    VkPipelineExecutableInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR;
    info.pipeline = pipeline.pipeline;
    info.executableIndex = executable;
    std::uint32_t count = 0;
    check(vkGetPipelineExecutableStatisticsKHR(device, &info, &count, nullptr), "vkGetPipelineExecutableStatisticsKHR");
    VkPipelineExecutableStatisticKHR empty{};
    empty.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
    std::vector<VkPipelineExecutableStatisticKHR> told(count, empty);
    check(vkGetPipelineExecutableStatisticsKHR(device, &info, &count, told.data()),
          "vkGetPipelineExecutableStatisticsKHR");
    add_statistics(std::span(told).first(count), shader, out);
  }
  return out;
}

std::uint32_t Device::Impl::memory_type(std::uint32_t allowed, Place place) const {
  constexpr VkMemoryPropertyFlags k_local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                  k_visible =
                                      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  const VkMemoryPropertyFlags needed = place == Place::device ? k_local : k_visible;
  const VkMemoryPropertyFlags liked =
      place == Place::host_reads ? VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_HOST_CACHED_BIT} : 0;
  for (const VkMemoryPropertyFlags flags : {needed | liked, needed})
    for (std::uint32_t i = 0; i < memory_properties.memoryTypeCount; ++i)
      if ((allowed >> i & 1) != 0 && (memory_properties.memoryTypes[i].propertyFlags & flags) == flags) return i;
  throw DeviceError(facts.name + " has no memory that buffers can use");
}

Memory Device::Impl::allocate(std::uint64_t bytes, Place place) const {
  Memory made{VK_NULL_HANDLE, VK_NULL_HANDLE, std::max<std::uint64_t>(bytes, 256), nullptr};
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = made.bytes;
  info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  if (place == Place::device)
    info.usage |=
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
  try {
    check(vkCreateBuffer(device, &info, nullptr, &made.buffer), "vkCreateBuffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device, made.buffer, &needs);
    VkMemoryAllocateInfo memory_info{};
    memory_info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    memory_info.allocationSize = needs.size;
    memory_info.memoryTypeIndex = memory_type(needs.memoryTypeBits, place);
    check(vkAllocateMemory(device, &memory_info, nullptr, &made.memory), "vkAllocateMemory");
    check(vkBindBufferMemory(device, made.buffer, made.memory, 0), "vkBindBufferMemory");
    if (place != Place::device)
      check(vkMapMemory(device, made.memory, 0, VK_WHOLE_SIZE, 0, &made.mapped), "vkMapMemory");
  } catch (...) {
    free(made);
    throw;
  }
  return made;
}

void Device::Impl::free(Memory& memory) const {
  if (is_stuck) return;
  if (memory.buffer != VK_NULL_HANDLE) vkDestroyBuffer(device, memory.buffer, nullptr);
  if (memory.memory != VK_NULL_HANDLE) vkFreeMemory(device, memory.memory, nullptr);
  memory = {};
}

}  // namespace clusterbench::gpu
