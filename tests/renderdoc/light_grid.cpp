// A program of others that clusters lights on Vulkan 1.1 and lets RenderDoc capture that, where its library is loaded
// (renderdoc_app.h: RENDERDOC_GetAPI, version 1.0.0). Prints the number of listed pairs.
// Vulkan 1.1, since RenderDoc offers no more on drivers that cannot replay addresses of buffers, as lavapipe.

#include <dlfcn.h>
#define VOLK_IMPLEMENTATION
#include <volk.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "light_grid_code.h"

namespace {

constexpr std::uint32_t k_columns = 16, k_rows = 9, k_slices = 12, k_lights = 60, k_lights_per_cell = 32;
constexpr std::uint32_t k_cells = k_columns * k_rows * k_slices;

void check(VkResult result, const char* call) {
  if (result == VK_SUCCESS) return;
  std::fprintf(stderr, "%s: %d\n", call, result);
  std::exit(1);
}

// The functions of RENDERDOC_API_1_0_0, in their order, of which two are called here.
class Capture {
 public:
  Capture() {
    void* library = dlopen("librenderdoc.so", RTLD_NOW | RTLD_NOLOAD);
    if (library == nullptr) return;
    using GetApi = int (*)(int version, void** api);
    constexpr int k_version_1_0_0 = 10000;
    const auto get = reinterpret_cast<GetApi>(dlsym(library, "RENDERDOC_GetAPI"));
    void* api = nullptr;
    if (get == nullptr || get(k_version_1_0_0, &api) != 1) return;
    std::memcpy(functions_.data(), api, sizeof functions_);
  }
  void start() const {
    if (functions_[k_start] != nullptr) reinterpret_cast<void (*)(void*, void*)>(functions_[k_start])(nullptr, nullptr);
  }
  void end() const {
    if (functions_[k_end] != nullptr) reinterpret_cast<unsigned (*)(void*, void*)>(functions_[k_end])(nullptr, nullptr);
  }

 private:
  static constexpr std::size_t k_start = 19, k_end = 21, k_count = 22;
  std::array<void (*)(), k_count> functions_{};
};

struct Buffer {
  VkBuffer handle = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* bytes = nullptr;
};

struct Gpu {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  bool has_names = false;
};

bool has_debug_utils() {
  std::uint32_t count = 0;
  vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> all(count);
  vkEnumerateInstanceExtensionProperties(nullptr, &count, all.data());
  for (const VkExtensionProperties& extension : all)
    if (std::strcmp(extension.extensionName, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) == 0) return true;
  return false;
}

Gpu open_gpu() {
  Gpu gpu;
  check(volkInitialize(), "volkInitialize");
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = VK_API_VERSION_1_1;
  VkInstanceCreateInfo instance{};
  instance.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  instance.pApplicationInfo = &application;
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  gpu.has_names = has_debug_utils();
  instance.enabledExtensionCount = gpu.has_names ? 1 : 0;
  instance.ppEnabledExtensionNames = &extension;
  check(vkCreateInstance(&instance, nullptr, &gpu.instance), "vkCreateInstance");
  volkLoadInstance(gpu.instance);
  std::uint32_t count = 1;
  vkEnumeratePhysicalDevices(gpu.instance, &count, &gpu.physical);
  if (count == 0) std::exit(77);  // no driver here
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo device{};
  device.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  device.queueCreateInfoCount = 1;
  device.pQueueCreateInfos = &queue;
  check(vkCreateDevice(gpu.physical, &device, nullptr, &gpu.device), "vkCreateDevice");
  volkLoadDevice(gpu.device);
  vkGetDeviceQueue(gpu.device, 0, 0, &gpu.queue);
  return gpu;
}

std::uint32_t host_memory(const Gpu& gpu, std::uint32_t allowed) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(gpu.physical, &memory);
  constexpr VkMemoryPropertyFlags k_wanted = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((allowed >> i & 1) != 0 && (memory.memoryTypes[i].propertyFlags & k_wanted) == k_wanted) return i;
  std::exit(1);
}

Buffer make_buffer(const Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage, const char* name) {
  Buffer out;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size;
  info.usage = usage;
  check(vkCreateBuffer(gpu.device, &info, nullptr, &out.handle), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(gpu.device, out.handle, &needs);
  VkMemoryAllocateInfo memory{};
  memory.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  memory.allocationSize = needs.size;
  memory.memoryTypeIndex = host_memory(gpu, needs.memoryTypeBits);
  check(vkAllocateMemory(gpu.device, &memory, nullptr, &out.memory), "vkAllocateMemory");
  vkBindBufferMemory(gpu.device, out.handle, out.memory, 0);
  check(vkMapMemory(gpu.device, out.memory, 0, size, 0, &out.bytes), "vkMapMemory");
  VkDebugUtilsObjectNameInfoEXT named{};
  named.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
  named.objectType = VK_OBJECT_TYPE_BUFFER;
  named.objectHandle = reinterpret_cast<std::uint64_t>(out.handle);
  named.pObjectName = name;
  if (gpu.has_names) vkSetDebugUtilsObjectNameEXT(gpu.device, &named);
  return out;
}

// A ring of lights before and around the eye, as tests/scripts/test_renderdoc.py does not know them: it reads them
// back.
void write_lights(void* bytes) {
  std::uint32_t state = 7;
  const auto drawn = [&state](float lo, float hi) {
    state = state * 1664525u + 1013904223u;
    return lo + (hi - lo) * static_cast<float>(state >> 8) / 16777216.0f;
  };
  std::vector<float> lights;
  for (std::uint32_t i = 0; i < k_lights; ++i)
    lights.insert(lights.end(), {drawn(-12.0f, 12.0f), drawn(-4.0f, 6.0f), drawn(-38.0f, 2.0f), drawn(1.0f, 5.0f)});
  std::memcpy(bytes, lights.data(), lights.size() * sizeof(float));
}

struct Bindings {
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;
};

constexpr VkDescriptorType k_types[] = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                        VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

Bindings bind(const Gpu& gpu, const std::array<Buffer, 3>& buffers) {
  Bindings out;
  std::array<VkDescriptorSetLayoutBinding, 3> bindings{};
  for (std::uint32_t i = 0; i < 3; ++i) bindings[i] = {i, k_types[i], 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo layout{};
  layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  layout.bindingCount = 3;
  layout.pBindings = bindings.data();
  check(vkCreateDescriptorSetLayout(gpu.device, &layout, nullptr, &out.layout), "vkCreateDescriptorSetLayout");
  const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1}, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2}};
  VkDescriptorPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = 2;
  pool_info.pPoolSizes = sizes;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(gpu.device, &pool_info, nullptr, &pool), "vkCreateDescriptorPool");
  VkDescriptorSetAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  allocate.descriptorPool = pool;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &out.layout;
  check(vkAllocateDescriptorSets(gpu.device, &allocate, &out.set), "vkAllocateDescriptorSets");
  for (std::uint32_t i = 0; i < 3; ++i) {
    const VkDescriptorBufferInfo range{buffers[i].handle, 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = out.set;
    write.dstBinding = i;
    write.descriptorCount = 1;
    write.descriptorType = k_types[i];
    write.pBufferInfo = &range;
    vkUpdateDescriptorSets(gpu.device, 1, &write, 0, nullptr);
  }
  return out;
}

struct Pipeline {
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline handle = VK_NULL_HANDLE;
};

Pipeline make_pipeline(const Gpu& gpu, VkDescriptorSetLayout set_layout) {
  Pipeline out;
  VkShaderModuleCreateInfo code{};
  code.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  code.codeSize = sizeof light_grid_code;
  code.pCode = light_grid_code;
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(gpu.device, &code, nullptr, &module), "vkCreateShaderModule");
  VkPipelineLayoutCreateInfo layout{};
  layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &set_layout;
  check(vkCreatePipelineLayout(gpu.device, &layout, nullptr, &out.layout), "vkCreatePipelineLayout");
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.layout = out.layout;
  check(vkCreateComputePipelines(gpu.device, VK_NULL_HANDLE, 1, &info, nullptr, &out.handle),
        "vkCreateComputePipelines");
  return out;
}

void dispatch(const Gpu& gpu, const Pipeline& pipeline, VkDescriptorSet set) {
  VkCommandPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  VkCommandPool pool = VK_NULL_HANDLE;
  check(vkCreateCommandPool(gpu.device, &pool_info, nullptr, &pool), "vkCreateCommandPool");
  VkCommandBufferAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  allocate.commandPool = pool;
  allocate.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(gpu.device, &allocate, &commands), "vkAllocateCommandBuffers");
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  vkBeginCommandBuffer(commands, &begin);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1, &set, 0, nullptr);
  vkCmdDispatch(commands, (k_cells + 63) / 64, 1, 1);
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                       nullptr, 0, nullptr);
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  check(vkQueueSubmit(gpu.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
  check(vkDeviceWaitIdle(gpu.device), "vkDeviceWaitIdle");
}

}  // namespace

int main() {
  const Gpu gpu = open_gpu();
  const Capture capture;
  const std::array<Buffer, 3> buffers{
      make_buffer(gpu, 32, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, "frame constants"),
      make_buffer(gpu, 16 * k_lights, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "lights in view space"),
      make_buffer(gpu, 4 * (1 + k_lights_per_cell) * k_cells, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "light grid")};
  const float frame[] = {1.0f, 16.0f / 9.0f, 0.25f, 40.0f};
  const std::uint32_t counts[] = {k_columns, k_rows, k_slices, k_lights};
  std::memcpy(buffers[0].bytes, frame, sizeof frame);
  std::memcpy(static_cast<char*>(buffers[0].bytes) + sizeof frame, counts, sizeof counts);
  write_lights(buffers[1].bytes);
  std::memset(buffers[2].bytes, 0xff, std::size_t{4} * (1 + k_lights_per_cell) * k_cells);
  const Bindings bindings = bind(gpu, buffers);
  const Pipeline pipeline = make_pipeline(gpu, bindings.layout);
  capture.start();
  dispatch(gpu, pipeline, bindings.set);
  capture.end();
  std::uint64_t pairs = 0;
  for (std::uint32_t cell = 0; cell < k_cells; ++cell)
    pairs += static_cast<const std::uint32_t*>(buffers[2].bytes)[std::size_t{cell} * (1 + k_lights_per_cell)];
  std::printf("%llu\n", static_cast<unsigned long long>(pairs));
}
