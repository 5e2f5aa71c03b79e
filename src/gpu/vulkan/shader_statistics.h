#pragma once
// What a driver tells of a compiled shader (VK_KHR_pipeline_executable_properties).

#include <vulkan/vulkan_core.h>

#include <cctype>
#include <span>
#include <string>
#include <vector>

#include "assign/contract/device_work.h"

namespace clusterbench::gpu {

// Of the many statistics those of registers, spills and memory of a group or an invocation. Drivers name them as they
// like: "Register Count" (NVIDIA), "VGPRs", "Spilled SGPRs", "LDS size" (AMD), "Spill count", "Scratch memory size"
// (Intel).
inline bool is_about_resources(const std::string& name) {
  std::string small;
  for (const char c : name) small += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* word : {"register", "gpr", "spill", "fill", "shared", "lds", "scratch", "local memory", "stack"})
    if (small.find(word) != std::string::npos) return true;
  return false;
}

inline double number_of(const VkPipelineExecutableStatisticKHR& told) {
  switch (told.format) {
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
      return told.value.b32 == VK_FALSE ? 0.0 : 1.0;
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
      return static_cast<double>(told.value.i64);
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
      return static_cast<double>(told.value.u64);
    default:
      return told.value.f64;
  }
}

inline void add_statistics(std::span<const VkPipelineExecutableStatisticKHR> told, const std::string& shader,
                           std::vector<assign::ShaderStatistic>& out) {
  for (const VkPipelineExecutableStatisticKHR& one : told)
    if (is_about_resources(one.name)) out.push_back({shader, one.name, number_of(one)});
}

}  // namespace clusterbench::gpu
