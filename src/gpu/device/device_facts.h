#pragma once
// A device on which shaders run: a GPU, or a driver that computes on the processor. As `clusterbench list devices`
// shows it.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace clusterbench::gpu {

enum class DeviceType : std::uint8_t { discrete, integrated, virtual_gpu, software, other };

std::string type_name(DeviceType type);

struct DeviceFacts {
  std::string name, driver;
  std::string vulkan;  // version of the interface: "1.3.204"
  std::string uuid;    // 32 hexadecimal digits
  DeviceType type = DeviceType::other;
  std::string obstacle;  // the reason why it cannot be used; "" if it can

  // Limits.
  std::uint64_t max_buffer_bytes = 0;                                            // of what a shader sees of one buffer
  std::uint32_t max_group_size = 0;                                              // invocations
  std::uint32_t shared_bytes = 0;                                                // of a group
  std::array<std::uint32_t, 3> max_group_sizes{}, max_groups{};                  // along each axis
  std::uint32_t max_argument_bytes = 0;                                          // of push constants
  std::uint32_t max_sets = 0, max_storage_buffers = 0, max_uniform_buffers = 0;  // that a shader sees
  std::uint64_t max_uniform_bytes = 0;                                           // of one uniform buffer
  std::uint32_t subgroup_size = 0;

  // The clock: 0 bits where it has none.
  std::uint32_t timestamp_bits = 0;
  double timestamp_period_ns = 0.0;

  // Arithmetic: whether shaders can ask for rounding to nearest in single precision. Otherwise a sum or a product may
  // be the next number on either side.
  bool rounds_to_nearest = false;
  bool has_vulkan_1_3 = false;  // 1.2 otherwise, whose modules are of SPIR-V 1.5 at most
  // Subgroups in compute shaders: each invocation in use, where a group is whole subgroups; ballots and broadcasts; and
  // sums, minima and bitwise operations beside these.
  bool has_full_subgroups = false, has_ballots = false, has_subgroup_arithmetic = false;

  // What shaders of users may declare: numbers of SPIR-V's capabilities, ascending.
  std::vector<std::uint32_t> capabilities;
  bool has_pipeline_robustness = false;  // reads and writes beyond buffers can be forbidden to single pipelines

  bool has_shader_clock = false;         // shaders can count cycles
  bool tells_shader_statistics = false;  // its driver tells registers and spills

  // Its times are those of a processor.
  bool is_software() const { return type == DeviceType::software; }
};

struct DeviceList {
  std::vector<DeviceFacts> devices;  // in the driver's order: their index selects them
  std::string obstacle;              // the reason why there are none
};

// All devices of this machine. Slow: it loads every driver.
DeviceList list_devices();

}  // namespace clusterbench::gpu
