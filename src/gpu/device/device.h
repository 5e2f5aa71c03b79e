#pragma once
// The device of this process, its buffers, and commands that run shaders on them. What Vulkan needs is behind
// Device::Impl (gpu/vulkan).

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "assign/contract/device_work.h"
#include "core/error.h"
#include "gpu/device/device_facts.h"

namespace clusterbench::gpu {

// The device failed, or cannot hold what a method needs. It ends the cases that run on it, and not the run.
class DeviceError : public Error {
 public:
  explicit DeviceError(std::string message) : Error("", "device", std::move(message)) {}
};

// What a user's shader left cannot be read. The device is as well as before; the fault is the shader's, and fails the
// run.
class ShaderFault : public DeviceError {
 public:
  using DeviceError::DeviceError;
};

// A compute pipeline: a shader with the size of its groups and its mode (both specialization constants).
using Kernel = std::uint32_t;

class Device {
 public:
  // The device that chosen_device() or, where a device was open before, same_device() takes. Throws Error with the
  // reason if there is none.
  explicit Device(const std::string& wanted, const DeviceFacts* before = nullptr, bool has_robust_buffers = false);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceFacts& facts() const;
  // Compiles src/gpu/shaders/SHADER.comp at the first request.
  Kernel kernel(const std::string& shader, std::uint32_t group_size, std::uint32_t mode = 0);
  // What the driver tells of a kernel's use of registers and memory; empty where it tells nothing.
  std::vector<assign::ShaderStatistic> statistics(Kernel kernel) const;
  // The size of the memory that Commands::flush() fills, which this makes room for.
  std::uint64_t reserve_flushed();
  // The reason why this device cannot run that shader; "" if it can.
  std::string obstacle(const std::string& shader) const;

  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

// Which device device() opens, as chosen_device() takes it. Closes the one that is open.
void use_device(const std::string& wanted);
// After a failure: the next device() opens it anew, and no other one, so that all results of this process are of one
// device. Nothing that was made with the old one may be left.
void close_device();
// The device of this process: opened at the first call, and closed by use_device() and close_device() alone. All
// methods and threads of a run share it. Throws Error with the reason if there is none.
Device& device();
// From the next device() on, reads and writes beyond buffers are harmless in all shaders, where this cannot be asked of
// single ones (DeviceFacts::has_pipeline_robustness). It may cost time.
void use_robust_buffers();
// The reason why device() throws; "" if it does not.
std::string device_obstacle();

// A line for each capture that RenderDoc has made since the last call: of what, and its file.
std::vector<std::string> taken_captures();

// The buffers that kernels see, by binding. Memory is kept, and grows.
class Buffers {
 public:
  static constexpr std::uint32_t k_bindings = 15;

  explicit Buffers(Device& device);
  ~Buffers();
  Buffers(const Buffers&) = delete;
  Buffers& operator=(const Buffers&) = delete;

  // At least this many bytes; if it has to grow, the contents are lost. Not while commands are recorded. Throws
  // DeviceError (with `name` and the numbers) above the device's limit or where it has no memory left.
  void reserve(std::uint32_t binding, std::uint64_t bytes, const char* name);
  std::uint64_t bytes(std::uint32_t binding) const;
  // Kernels see another set's buffer at this binding, until that set makes more room there or is gone. Not while
  // commands are recorded.
  void borrow(std::uint32_t binding, const Buffers& from);
  std::uint64_t all_bytes() const;

  struct Impl;
  Impl& impl() { return *impl_; }
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

// Arguments of a dispatch: what its shader declares as push constants.
struct Arguments {
  std::array<std::uint32_t, 32> words{};
};

// Commands that are recorded, then run once. Steps within a dispatch run in any order; what a later step reads of an
// earlier one needs a barrier() between them. Threads take turns: from the constructor to the end of run() the device
// belongs to this recording.
class Program;

class Commands {
 public:
  Commands(Device& device, Buffers& buffers);

  // Data for a buffer: copied now, arrives as a step.
  void upload(std::uint32_t binding, const void* data, std::uint64_t bytes);
  void fill(std::uint32_t binding, std::uint32_t word, std::uint64_t bytes);
  // The dispatches that follow see these buffers in place of the constructor's.
  void use(Buffers& buffers);
  // Groups are spread over two dimensions beyond 65,535: shaders number them by group_index().
  void dispatch(Kernel kernel, const Arguments& arguments, std::uint64_t groups);
  // As many groups, in three dimensions, as the first three words of a buffer say. Its barrier: before_indirect.
  void dispatch_indirect(Kernel kernel, const Arguments& arguments, std::uint32_t groups_binding);
  // `arguments`: as many bytes as the program has. Kernels that follow in this recording see no buffers.
  void dispatch(const Program& program, std::span<const std::byte> arguments, std::array<std::uint32_t, 3> groups);
  // `before_indirect`: a dispatch_indirect() behind it reads its groups from a buffer that a step before it wrote.
  enum class Barrier : std::uint8_t { usual, before_indirect };
  void barrier(Barrier kind = Barrier::usual);
  // Fills memory that nothing else uses, and waits, so that no cache holds what comes next. No step of the work.
  void flush();
  // The time of all steps until now, by the device's clock. Up to 64 in one recording; returns the number of this one.
  std::uint32_t mark();
  // Steps until now that wait for each other: dispatches and fills between two barriers are one.
  std::uint32_t steps() const { return steps_ + (has_work_ ? 1 : 0); }
  // The first bytes of a buffer, for downloaded() after run().
  void download(std::uint32_t binding, std::uint64_t bytes);

  // Throws DeviceError if the device fails. Where RenderDoc is in this process, the first run of each shader is a
  // capture.
  void run();
  // Between two marks; 0 without a clock.
  double ns_between(std::uint32_t first, std::uint32_t last) const;
  // The n-th download of the last run, valid until the next one.
  std::span<const std::uint32_t> downloaded(std::uint32_t n) const;

 private:
  void wait_for_end();

  void bind(Kernel kernel, const Arguments& arguments);

  Device::Impl& device_;
  Buffers::Impl& buffers_;
  std::unique_lock<std::recursive_mutex> turn_;
  std::uint32_t steps_ = 0;  // until the last barrier
  bool has_work_ = false;    // since then
  std::vector<std::string> new_shaders_;
};

}  // namespace clusterbench::gpu
