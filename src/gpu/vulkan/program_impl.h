#pragma once
// A program on Vulkan: a pipeline, its layout, and its descriptor sets.

#include <vector>

#include "gpu/device/program.h"
#include "gpu/vulkan/device_impl.h"

namespace clusterbench::gpu {

struct Program::Impl {
  Impl(Device::Impl& of, const ProgramCode& code);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Device::Impl& device;
  std::string name;
  std::vector<ProgramBinding> bindings;
  std::vector<VkDescriptorSetLayout> set_layouts;  // of set 0 to the last
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  std::vector<VkDescriptorSet> sets;

 private:
  struct Nothing {};
  Impl(Device::Impl& of, Nothing) : device(of) {}  // as that of Device::Impl
  void create_set_layouts();
  void create_layout(std::uint32_t argument_bytes);
  void create_sets();
  void create_pipeline(const ProgramCode& code);
};

}  // namespace clusterbench::gpu
