#pragma once
// A compute shader that is not ours: its module, entry point and constants, with descriptor sets of its own.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gpu/device/device.h"

namespace clusterbench::gpu {

struct ProgramBinding {
  std::uint32_t set = 0, binding = 0;
  bool is_uniform = false;
  std::uint32_t buffer = 0;  // a binding of Buffers
};

struct ProgramCode {
  std::string name;  // for messages and statistics
  std::span<const std::uint32_t> words;
  std::string entry = "main";
  std::vector<std::pair<std::uint32_t, std::uint32_t>> constants{};  // ids and words
  std::vector<ProgramBinding> bindings{};
  std::uint32_t argument_bytes = 0;
};

class Program {
 public:
  // Reads and writes beyond its buffers are harmless. Throws DeviceError where the driver refuses it. The caller has
  // checked the module, and that the device has what it needs.
  Program(Device& device, const ProgramCode& code);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // What it sees from now on: the first `bytes[i]` bytes of the buffer of binding i. Not while commands are recorded.
  void bind(const Buffers& buffers, std::span<const std::uint64_t> bytes);
  std::vector<assign::ShaderStatistic> statistics() const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace clusterbench::gpu
