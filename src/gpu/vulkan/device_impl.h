#pragma once
// The logical device: memory, pipelines, and the one command buffer that all commands are recorded into.

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "gpu/device/device.h"
#include "gpu/vulkan/frame_capture.h"
#include "gpu/vulkan/vulkan.h"

namespace clusterbench::gpu {

struct Memory {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  std::uint64_t bytes = 0;
  void* mapped = nullptr;  // of memory that the host sees
};

// Where a buffer lies.
enum class Place : std::uint8_t { device, host_writes, host_reads };

struct Device::Impl {
  Impl(const std::string& wanted, const DeviceFacts* before, bool has_robust_buffers);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Memory allocate(std::uint64_t bytes, Place place) const;
  void free(Memory& memory) const;
  Kernel kernel(const std::string& shader, std::uint32_t group_size, std::uint32_t mode);
  std::string name_of(Kernel kernel) const;
  std::vector<assign::ShaderStatistic> statistics(Kernel kernel) const;
  // Of a pipeline; `shader`: what the statistics are of.
  std::vector<assign::ShaderStatistic> statistics_of(VkPipeline pipeline, const std::string& shader) const;
  std::string obstacle(const std::string& shader) const;

  static constexpr std::uint32_t k_marks = 66;

  bool is_stuck = false;      // it may still work on what was submitted: nothing is destroyed, and nothing more is run
  std::recursive_mutex turn;  // of who records or adds a kernel
  DeviceFacts facts;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory_properties{};
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  VkQueryPool marks = VK_NULL_HANDLE;
  Memory flushed;  // no buffer until it is asked for
  VkDescriptorSetLayout bindings = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  std::vector<VkPipeline> pipelines;  // by Kernel
  std::map<std::tuple<std::string, std::uint32_t, std::uint32_t>, Kernel> kernels;
  std::set<VkPipeline> run_before;
  FrameCapture capture;

 private:
  Impl() = default;  // what is complete is destroyed, however far the constructor after it comes
  void create_device(std::uint32_t queue_family, bool has_robust_buffers);
  void create_layout();
  VkPipeline create_pipeline(const std::string& shader, std::uint32_t group_size, std::uint32_t mode) const;
  std::uint32_t memory_type(std::uint32_t allowed, Place place) const;
};

struct Buffers::Impl {
  explicit Impl(Device::Impl& of);  // with buffers at all bindings
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void bind(std::uint32_t binding) const { bind(binding, at[binding].buffer); }
  void bind(std::uint32_t binding, VkBuffer buffer) const;

  Device::Impl& device;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;
  std::array<Memory, k_bindings> at{};

  // Between host and device. Uploads of one recording stand one after the other; a buffer that became too small in the
  // middle of a recording lives until its end.
  Memory to_device, to_host;
  std::uint64_t uploaded = 0;
  std::vector<Memory> outgrown;
  struct Download {
    std::uint32_t binding = 0;
    std::uint64_t bytes = 0, offset = 0;
  };
  std::vector<Download> downloads;
  std::uint32_t mark_count = 0;
  std::array<std::uint64_t, Device::Impl::k_marks> ticks{};

 private:
  struct Nothing {};
  Impl(Device::Impl& of, Nothing) : device(of) {}  // as that of Device::Impl
};

}  // namespace clusterbench::gpu
