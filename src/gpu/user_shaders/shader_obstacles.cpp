#include "gpu/user_shaders/shader_obstacles.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "gpu/device/device.h"
#include "gpu/user_shaders/capability_names.h"

namespace clusterbench::gpu {
namespace {

// The reason why this device cannot run the module; "" if it can.
std::string module_obstacle(const DeviceFacts& facts, const SpirvModule& module, const std::string& name) {
  constexpr std::uint32_t k_version_1_5 = 0x00010500;
  if (!facts.has_vulkan_1_3 && module.version > k_version_1_5)
    return facts.name + " has Vulkan " + facts.vulkan + ", which reads SPIR-V 1.0 to 1.5; " + name +
           " is of a later one (--target-env vulkan1.2)";
  for (const std::uint32_t capability : module.capabilities)
    if (!std::ranges::binary_search(facts.capabilities, capability))
      return is_capability_asked_for(capability)
                 ? facts.name + " lacks the capability " + capability_name(capability) + " that " + name + " declares"
                 : name + " declares the capability " + capability_name(capability) +
                       ", which clusterbench asks no device for";
  if (module.argument_bytes > facts.max_argument_bytes)
    return facts.name + " takes " + number_of(facts.max_argument_bytes, "byte") + " of push constants; " + name +
           " has " + std::to_string(module.argument_bytes);
  if (module.shared_bytes > facts.shared_bytes)
    return facts.name + " has " + number_of(facts.shared_bytes, "byte") + " for a group to share; " + name + " takes " +
           std::to_string(module.shared_bytes);
  std::uint64_t storage = 0, uniform = 0;
  for (const ModuleBinding& binding : module.bindings) {
    (binding.kind == ModuleBinding::Kind::uniform ? uniform : storage) += 1;
    if (binding.set >= facts.max_sets)
      return facts.name + " has descriptor sets 0 to " + std::to_string(facts.max_sets - 1) + "; " + name +
             " uses set " + std::to_string(binding.set);
  }
  if (storage > facts.max_storage_buffers || uniform > facts.max_uniform_buffers)
    return facts.name + " lets a shader see " + number_of(facts.max_storage_buffers, "storage buffer") + " and " +
           number_of(facts.max_uniform_buffers, "uniform buffer") + "; " + name + " has " + std::to_string(storage) +
           " and " + std::to_string(uniform);
  return "";
}

// Does it compute slices of its own that are not those of the grid? Single precision is off by less than this.
std::string slices_obstacle(const result::ShaderMethod& method, const grid::Grid& grid) {
  constexpr double k_rounding = 1e-5;
  const std::string wanted = method.slices.value_or("any");
  if (wanted == "any") return "";
  const std::vector<float>& ends = grid.screen().slices.boundaries;
  const auto count = static_cast<double>(ends.size() - 1);
  const auto first = static_cast<double>(ends.front()), last = static_cast<double>(ends.back());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double share = static_cast<double>(i) / count;
    const double expected = wanted == "linear" ? first + (last - first) * share : first * std::pow(last / first, share);
    if (std::abs(expected - static_cast<double>(ends[i])) > k_rounding * std::abs(expected))
      return method.name + " has " + wanted + " slices; those of this grid are others";
  }
  return "";
}

std::string tiles_obstacle(const result::ShaderMethod& method, const grid::Grid& grid) {
  const grid::Tiles& tiles = grid.screen().tiles;
  if (method.tiles.value_or("any") == "any" || tiles.pixels.x == 0) return "";
  if (tiles.viewport.x % tiles.pixels.x == 0 && tiles.viewport.y % tiles.pixels.y == 0) return "";
  return method.name + " has tiles of equal size; the last ones of this grid are cut off";
}

std::string formula_obstacle(const ShaderFile& file, const grid::Grid& grid) {
  const bool has_none = grid.screen().slices.lookup.form == grid::SliceLookup::Form::search;
  if (!file.has_slice_formula || !has_none) return "";
  return file.record.name + " is told slice_scale or slice_bias; the slices of this grid follow no formula";
}

}  // namespace

std::string grid_obstacle(const ShaderFile& file, const grid::Grid& grid) {
  std::string reason = tiles_obstacle(file.record, grid);
  if (reason.empty()) reason = slices_obstacle(file.record, grid);
  return reason.empty() ? formula_obstacle(file, grid) : reason;
}

std::string shader_obstacle(const ShaderFile& file) {
  if (std::string none = device_obstacle(); !none.empty()) return none;
  try {
    for (const auto& [name, module] : file.modules)
      if (std::string reason = module_obstacle(gpu::device().facts(), module, name); !reason.empty()) return reason;
    return "";
  } catch (const DeviceError& error) {
    return error.message();
  }
}

}  // namespace clusterbench::gpu
