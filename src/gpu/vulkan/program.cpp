#include <algorithm>

#include "gpu/vulkan/program_impl.h"

namespace clusterbench::gpu {
namespace {

VkDescriptorType descriptor_type(const ProgramBinding& binding) {
  return binding.is_uniform ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

// The ids and words of specialization constants, as Vulkan takes them.
struct Specialization {
  explicit Specialization(const ProgramCode& code) {
    for (const auto& [id, word] : code.constants) {
      entries.push_back({id, static_cast<std::uint32_t>(words.size() * sizeof word), sizeof word});
      words.push_back(word);
    }
    info = {static_cast<std::uint32_t>(entries.size()), entries.data(), words.size() * sizeof(std::uint32_t),
            words.data()};
  }
  Specialization(const Specialization&) = delete;
  Specialization& operator=(const Specialization&) = delete;

  std::vector<VkSpecializationMapEntry> entries;
  std::vector<std::uint32_t> words;
  VkSpecializationInfo info{};
};

}  // namespace

Program::Program(Device& device, const ProgramCode& code) : impl_(std::make_unique<Impl>(device.impl(), code)) {}
Program::~Program() = default;

Program::Impl::Impl(Device::Impl& of, const ProgramCode& code) : Impl(of, Nothing{}) {
  const std::lock_guard turn(device.turn);
  name = code.name;
  bindings = code.bindings;
  create_set_layouts();
  create_layout(code.argument_bytes);
  create_sets();
  create_pipeline(code);
}

Program::Impl::~Impl() {
  if (device.is_stuck) return;
  device.run_before.erase(pipeline);
  vkDestroyPipeline(device.device, pipeline, nullptr);
  vkDestroyPipelineLayout(device.device, layout, nullptr);
  vkDestroyDescriptorPool(device.device, pool, nullptr);
  for (const VkDescriptorSetLayout one : set_layouts) vkDestroyDescriptorSetLayout(device.device, one, nullptr);
}

void Program::Impl::create_set_layouts() {
  std::uint32_t count = 0;
  for (const ProgramBinding& binding : bindings) count = std::max(count, binding.set + 1);
  for (std::uint32_t set = 0; set < count; ++set) {
    std::vector<VkDescriptorSetLayoutBinding> each;
    for (const ProgramBinding& binding : bindings)
      if (binding.set == set)
        each.push_back({binding.binding, descriptor_type(binding), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = static_cast<std::uint32_t>(each.size());
    info.pBindings = each.data();
    set_layouts.push_back(VK_NULL_HANDLE);  // first, so that no memory is missing for what is made
    check(vkCreateDescriptorSetLayout(device.device, &info, nullptr, &set_layouts.back()),
          "vkCreateDescriptorSetLayout");
  }
}

void Program::Impl::create_layout(std::uint32_t argument_bytes) {
  const VkPushConstantRange arguments{VK_SHADER_STAGE_COMPUTE_BIT, 0, argument_bytes};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = static_cast<std::uint32_t>(set_layouts.size());
  info.pSetLayouts = set_layouts.data();
  info.pushConstantRangeCount = argument_bytes > 0 ? 1 : 0;
  info.pPushConstantRanges = &arguments;
  check(vkCreatePipelineLayout(device.device, &info, nullptr, &layout), "vkCreatePipelineLayout");
}

void Program::Impl::create_sets() {
  if (set_layouts.empty()) return;
  const auto count = static_cast<std::uint32_t>(bindings.size());
  const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count},
                                        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count}};
  VkDescriptorPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool_info.maxSets = static_cast<std::uint32_t>(set_layouts.size());
  pool_info.poolSizeCount = 2;
  pool_info.pPoolSizes = sizes;
  check(vkCreateDescriptorPool(device.device, &pool_info, nullptr, &pool), "vkCreateDescriptorPool");
  sets.resize(set_layouts.size());
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = pool;
  info.descriptorSetCount = static_cast<std::uint32_t>(sets.size());
  info.pSetLayouts = set_layouts.data();
  check(vkAllocateDescriptorSets(device.device, &info, sets.data()), "vkAllocateDescriptorSets");
}

void Program::Impl::create_pipeline(const ProgramCode& code) {
  VkShaderModuleCreateInfo module_info{};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module_info.codeSize = code.words.size_bytes();
  module_info.pCode = code.words.data();
  const Specialization constants(code);
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device.device, &module_info, nullptr, &module), "vkCreateShaderModule");
  VkPipelineRobustnessCreateInfoEXT robustness{};
  robustness.sType = VK_STRUCTURE_TYPE_PIPELINE_ROBUSTNESS_CREATE_INFO_EXT;
  robustness.storageBuffers = robustness.uniformBuffers =
      VK_PIPELINE_ROBUSTNESS_BUFFER_BEHAVIOR_ROBUST_BUFFER_ACCESS_EXT;
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  if (device.facts.has_pipeline_robustness) info.pNext = &robustness;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = code.entry.c_str();
  info.stage.pSpecializationInfo = &constants.info;
  info.layout = layout;
  if (device.facts.tells_shader_statistics) info.flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
  const VkResult result = vkCreateComputePipelines(device.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
  vkDestroyShaderModule(device.device, module, nullptr);
  check(result, "vkCreateComputePipelines");
}

void Program::bind(const Buffers& buffers, std::span<const std::uint64_t> bytes) {
  std::vector<VkDescriptorBufferInfo> infos;
  std::vector<VkWriteDescriptorSet> writes;
  infos.reserve(impl_->bindings.size());
  for (std::size_t i = 0; i < impl_->bindings.size(); ++i) {
    const ProgramBinding& binding = impl_->bindings[i];
    infos.push_back({buffers.impl().at.at(binding.buffer).buffer, 0, bytes[i]});
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = impl_->sets[binding.set];
    write.dstBinding = binding.binding;
    write.descriptorCount = 1;
    write.descriptorType = descriptor_type(binding);
    write.pBufferInfo = &infos.back();
    writes.push_back(write);
  }
  vkUpdateDescriptorSets(impl_->device.device, static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

std::vector<assign::ShaderStatistic> Program::statistics() const {
  const std::lock_guard turn(impl_->device.turn);
  return impl_->device.statistics_of(impl_->pipeline, impl_->name);
}

}  // namespace clusterbench::gpu
