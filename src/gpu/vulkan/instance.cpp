#define VOLK_IMPLEMENTATION
#include "gpu/vulkan/vulkan.h"

#include <cstdlib>
#include <mutex>
#include <vector>

#include "core/error.h"
#include "gpu/device/device.h"

namespace clusterbench::gpu {
namespace {

constexpr const char* k_validation_layer = "VK_LAYER_KHRONOS_validation";

Objections& noted_objections() {
  static Objections all;
  return all;
}

std::mutex& noting() {
  static std::mutex only;
  return only;
}

VKAPI_ATTR VkBool32 VKAPI_CALL note(VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT,
                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
  if (severity < VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT) return VK_FALSE;
  const std::lock_guard lock(noting());
  Objections& all = noted_objections();
  if (all.count++ == 0) all.first = data->pMessage;
  return VK_FALSE;
}

const char* meaning(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "no memory left";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "the device has no memory left";
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost: its driver stopped it, mostly because a shader ran too long";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no driver for any device of this machine";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "the validation layer is not installed (Debian: vulkan-validationlayers)";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "the driver could not be started";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "the driver lacks an extension";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "the driver lacks a feature";
    case VK_TIMEOUT:
      return "the device did not answer in ten minutes";
    default:
      return nullptr;
  }
}

// The kinds of validation that CLUSTERBENCH_VULKAN_VALIDATION asks for.
std::vector<VkValidationFeatureEnableEXT> wanted_validation(const std::string& words) {
  if (words == "sync") return {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  if (words == "gpu")
    return {VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT,
            VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT};
  if (words == "core") return {};
  throw Error("", "CLUSTERBENCH_VULKAN_VALIDATION", "'" + words + "' is not known; core, sync or gpu is allowed");
}

void create(Instance& made) {
  if (volkInitialize() != VK_SUCCESS) {
    made.obstacle = "no Vulkan loader on this machine (Debian: libvulkan1)";
    return;
  }
  const char* validation = std::getenv("CLUSTERBENCH_VULKAN_VALIDATION");
  const bool validates = validation != nullptr && *validation != '\0';
  const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                      .pNext = nullptr,
                                      .pApplicationName = "clusterbench",
                                      .applicationVersion = 0,
                                      .pEngineName = nullptr,
                                      .engineVersion = 0,
                                      .apiVersion = VK_API_VERSION_1_3};
  const auto kinds = validates ? wanted_validation(validation) : std::vector<VkValidationFeatureEnableEXT>{};
  const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                         .pNext = nullptr,
                                         .enabledValidationFeatureCount = static_cast<std::uint32_t>(kinds.size()),
                                         .pEnabledValidationFeatures = kinds.data(),
                                         .disabledValidationFeatureCount = 0,
                                         .pDisabledValidationFeatures = nullptr};
  const VkDebugUtilsMessengerCreateInfoEXT messenger_info{
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
      .pNext = &features,
      .flags = 0,
      .messageSeverity =
          VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
      .pfnUserCallback = note,
      .pUserData = nullptr};
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                  .pNext = validates ? &messenger_info : nullptr,
                                  .flags = 0,
                                  .pApplicationInfo = &application,
                                  .enabledLayerCount = validates ? 1u : 0u,
                                  .ppEnabledLayerNames = &k_validation_layer,
                                  .enabledExtensionCount = validates ? 1u : 0u,
                                  .ppEnabledExtensionNames = &extension};
  if (const VkResult result = vkCreateInstance(&info, nullptr, &made.handle); result != VK_SUCCESS) {
    const char* reason = meaning(result);
    made.obstacle = std::string("Vulkan cannot be used: ") + (reason != nullptr ? reason : "vkCreateInstance failed");
    made.handle = VK_NULL_HANDLE;
    return;
  }
  volkLoadInstance(made.handle);
  if (!validates) return;
  VkDebugUtilsMessengerCreateInfoEXT later = messenger_info;
  later.pNext = nullptr;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;  // as long as the instance
  check(vkCreateDebugUtilsMessengerEXT(made.handle, &later, nullptr, &messenger), "vkCreateDebugUtilsMessengerEXT");
}

}  // namespace

void check(VkResult result, const char* call) {
  if (result == VK_SUCCESS) return;
  const char* reason = meaning(result);
  throw DeviceError(std::string(reason != nullptr ? reason : "the driver reported an error") + " (" + call +
                    ": VkResult " + std::to_string(result) + ")");
}

Objections objections() {
  const std::lock_guard lock(noting());
  return noted_objections();
}

// Never destroyed: drivers and layers may be unloaded before the statics of this process are.
const Instance& instance() {
  static const Instance& only = []() -> const Instance& {
    auto* made = new Instance;
    create(*made);
    return *made;
  }();
  return only;
}

std::vector<VkPhysicalDevice> physical_devices() {
  std::uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance().handle, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> all(count);
  check(vkEnumeratePhysicalDevices(instance().handle, &count, all.data()), "vkEnumeratePhysicalDevices");
  return all;
}

}  // namespace clusterbench::gpu
