#include <algorithm>

#include "core/error.h"
#include "core/memory.h"
#include "gpu/vulkan/device_impl.h"

namespace clusterbench::gpu {

Buffers::Buffers(Device& device) : impl_(std::make_unique<Impl>(device.impl())) {}
Buffers::~Buffers() = default;

void Buffers::reserve(std::uint32_t binding, std::uint64_t bytes, const char* name) {
  Memory& memory = impl_->at.at(binding);
  if (bytes <= memory.bytes) return;
  const DeviceFacts& facts = impl_->device.facts;
  if (bytes > facts.max_buffer_bytes)
    throw DeviceError(std::string(name) + " need a buffer of " + std::to_string(bytes) + " bytes; " + facts.name +
                      " allows " + std::to_string(facts.max_buffer_bytes) + "; use fewer lights or cells");
  try {
    check_memory(name, bytes, 1);
  } catch (const Error& error) {
    throw DeviceError(error.where() + ": " + error.message());
  }
  impl_->device.free(memory);
  memory = impl_->device.allocate(bytes, Place::device);
  impl_->bind(binding);
}

std::uint64_t Buffers::bytes(std::uint32_t binding) const {
  return impl_->at.at(binding).bytes;
}

void Buffers::borrow(std::uint32_t binding, const Buffers& from) {
  impl_->bind(binding, from.impl_->at.at(binding).buffer);
}

std::uint64_t Buffers::all_bytes() const {
  std::uint64_t sum = impl_->to_device.bytes + impl_->to_host.bytes;
  for (const Memory& memory : impl_->at) sum += memory.bytes;
  return sum;
}

Buffers::Impl::Impl(Device::Impl& of) : Impl(of, Nothing{}) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, k_bindings};
  VkDescriptorPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = 1;
  pool_info.pPoolSizes = &size;
  check(vkCreateDescriptorPool(device.device, &pool_info, nullptr, &pool), "vkCreateDescriptorPool");
  VkDescriptorSetAllocateInfo set_info{};
  set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  set_info.descriptorPool = pool;
  set_info.descriptorSetCount = 1;
  set_info.pSetLayouts = &device.bindings;
  check(vkAllocateDescriptorSets(device.device, &set_info, &set), "vkAllocateDescriptorSets");
  for (std::uint32_t binding = 0; binding < k_bindings; ++binding) {
    at[binding] = device.allocate(0, Place::device);  // a shader may name bindings that a method does not use
    bind(binding);
  }
}

Buffers::Impl::~Impl() {
  for (Memory& memory : at) device.free(memory);
  for (Memory& memory : outgrown) device.free(memory);
  device.free(to_device);
  device.free(to_host);
  if (!device.is_stuck) vkDestroyDescriptorPool(device.device, pool, nullptr);
}

void Buffers::Impl::bind(std::uint32_t binding, VkBuffer buffer) const {
  const VkDescriptorBufferInfo info{buffer, 0, VK_WHOLE_SIZE};
  VkWriteDescriptorSet write{};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set;
  write.dstBinding = binding;
  write.descriptorCount = 1;
  write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  write.pBufferInfo = &info;
  vkUpdateDescriptorSets(device.device, 1, &write, 0, nullptr);
}

}  // namespace clusterbench::gpu
