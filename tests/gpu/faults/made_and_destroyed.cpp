#include "gpu/faults/made_and_destroyed.h"

#include <volk.h>

#include <cstring>
#include <mutex>

namespace clusterbench::gpu::testing {
namespace {

struct Count {
  std::mutex counting;
  int alive = 0, calls = 0, fails_at = 0;
};
Count& count() {
  static Count& only = *new Count;
  return only;
}
bool is_to_fail() {
  const std::lock_guard lock(count().counting);
  return ++count().calls == count().fails_at;
}
void add(int objects) {
  const std::lock_guard lock(count().counting);
  count().alive += objects;
}

// The driver's call of a type; each call has a type of its own.
template <class Call>
Call g_real = nullptr;

// Calls in its place: of one that makes an object; of one that may fail, and whose work goes with another object; and
// of one that destroys an object.
template <class Call>
struct Makes;
template <class... Arguments>
struct Makes<VkResult (*)(Arguments...)> {
  static VkResult call(Arguments... arguments) {
    if (is_to_fail()) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    const VkResult result = g_real<VkResult (*)(Arguments...)>(arguments...);
    add(result == VK_SUCCESS ? 1 : 0);
    return result;
  }
};
template <class Call>
struct Fails;
template <class... Arguments>
struct Fails<VkResult (*)(Arguments...)> {
  static VkResult call(Arguments... arguments) {
    return is_to_fail() ? VK_ERROR_OUT_OF_DEVICE_MEMORY : g_real<VkResult (*)(Arguments...)>(arguments...);
  }
};
template <class Call>
struct Destroys;
template <class Handle>
struct Destroys<void (*)(VkDevice, Handle, const VkAllocationCallbacks*)> {
  static void call(VkDevice device, Handle handle, const VkAllocationCallbacks* memory) {
    add(handle != VK_NULL_HANDLE ? -1 : 0);
    g_real<void (*)(VkDevice, Handle, const VkAllocationCallbacks*)>(device, handle, memory);
  }
};
template <>
struct Destroys<PFN_vkDestroyDevice> {
  static void call(VkDevice device, const VkAllocationCallbacks* memory) {
    add(-1);
    g_real<PFN_vkDestroyDevice>(device, memory);
  }
};

struct Call {
  const char* name;
  void (*keep)(PFN_vkVoidFunction real);
  PFN_vkVoidFunction counted;
};
template <class Type, template <class> class In>
Call call_of(const char* name) {
  return {name, [](PFN_vkVoidFunction real) { g_real<Type> = reinterpret_cast<Type>(real); },
          reinterpret_cast<PFN_vkVoidFunction>(&In<Type>::call)};
}

const Call k_calls[] = {
    call_of<PFN_vkCreateCommandPool, Makes>("vkCreateCommandPool"),
    call_of<PFN_vkCreateFence, Makes>("vkCreateFence"),
    call_of<PFN_vkCreateQueryPool, Makes>("vkCreateQueryPool"),
    call_of<PFN_vkCreateDescriptorSetLayout, Makes>("vkCreateDescriptorSetLayout"),
    call_of<PFN_vkCreatePipelineLayout, Makes>("vkCreatePipelineLayout"),
    call_of<PFN_vkCreateShaderModule, Makes>("vkCreateShaderModule"),
    call_of<PFN_vkCreateComputePipelines, Makes>("vkCreateComputePipelines"),  // one at a time
    call_of<PFN_vkCreateDescriptorPool, Makes>("vkCreateDescriptorPool"),
    call_of<PFN_vkCreateBuffer, Makes>("vkCreateBuffer"),
    call_of<PFN_vkAllocateMemory, Makes>("vkAllocateMemory"),
    call_of<PFN_vkAllocateCommandBuffers, Fails>("vkAllocateCommandBuffers"),
    call_of<PFN_vkAllocateDescriptorSets, Fails>("vkAllocateDescriptorSets"),
    call_of<PFN_vkBindBufferMemory, Fails>("vkBindBufferMemory"),
    call_of<PFN_vkMapMemory, Fails>("vkMapMemory"),
    call_of<PFN_vkDestroyCommandPool, Destroys>("vkDestroyCommandPool"),
    call_of<PFN_vkDestroyFence, Destroys>("vkDestroyFence"),
    call_of<PFN_vkDestroyQueryPool, Destroys>("vkDestroyQueryPool"),
    call_of<PFN_vkDestroyDescriptorSetLayout, Destroys>("vkDestroyDescriptorSetLayout"),
    call_of<PFN_vkDestroyPipelineLayout, Destroys>("vkDestroyPipelineLayout"),
    call_of<PFN_vkDestroyShaderModule, Destroys>("vkDestroyShaderModule"),
    call_of<PFN_vkDestroyPipeline, Destroys>("vkDestroyPipeline"),
    call_of<PFN_vkDestroyDescriptorPool, Destroys>("vkDestroyDescriptorPool"),
    call_of<PFN_vkDestroyBuffer, Destroys>("vkDestroyBuffer"),
    call_of<PFN_vkFreeMemory, Destroys>("vkFreeMemory"),
    call_of<PFN_vkDestroyDevice, Destroys>("vkDestroyDevice"),
};

// volk asks it for every call of a device.
PFN_vkVoidFunction proc_addr(VkDevice device, const char* name) {
  const PFN_vkVoidFunction real = g_real<PFN_vkGetDeviceProcAddr>(device, name);
  for (const Call& call : k_calls)
    if (std::strcmp(name, call.name) == 0) {
      call.keep(real);
      return call.counted;
    }
  return real;
}

}  // namespace

CountedVulkan::CountedVulkan() {
  g_real<PFN_vkGetDeviceProcAddr> = vkGetDeviceProcAddr;
  g_real<PFN_vkCreateDevice> = vkCreateDevice;
  vkGetDeviceProcAddr = proc_addr;
  vkCreateDevice = &Makes<PFN_vkCreateDevice>::call;
  count().alive = 0;
  fail(0);
}
// The calls of the last device stay as they are until the next one is opened: each ends in the driver's.
CountedVulkan::~CountedVulkan() {
  fail(0);
  vkGetDeviceProcAddr = g_real<PFN_vkGetDeviceProcAddr>;
  vkCreateDevice = g_real<PFN_vkCreateDevice>;
}

void CountedVulkan::fail(int call) {
  const std::lock_guard lock(count().counting);
  count().calls = 0;
  count().fails_at = call;
}
int CountedVulkan::calls() const {
  const std::lock_guard lock(count().counting);
  return count().calls;
}
int CountedVulkan::alive() const {
  const std::lock_guard lock(count().counting);
  return count().alive;
}

}  // namespace clusterbench::gpu::testing
