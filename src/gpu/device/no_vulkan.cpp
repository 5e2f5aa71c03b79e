// Of a build without Vulkan's headers, volk or glslang: there is no device. CLUSTERBENCH_GPU_OBSTACLE is the reason.

#include "core/error.h"
#include "gpu/device/device.h"
#include "gpu/device/program.h"

#ifndef CLUSTERBENCH_GPU_OBSTACLE
#define CLUSTERBENCH_GPU_OBSTACLE "this clusterbench was built without Vulkan"
#endif

namespace clusterbench::gpu {
namespace {

[[noreturn]] void refuse() {
  throw Error("", "device", CLUSTERBENCH_GPU_OBSTACLE);
}

}  // namespace

struct Device::Impl {};
struct Buffers::Impl {};
struct Program::Impl {};

DeviceList list_devices() {
  return {{}, CLUSTERBENCH_GPU_OBSTACLE};
}

std::vector<std::string> taken_captures() {
  return {};
}

Device::Device(const std::string&, const DeviceFacts*, bool) {
  refuse();
}
Device::~Device() = default;
const DeviceFacts& Device::facts() const {
  refuse();
}
std::string Device::obstacle(const std::string&) const {
  refuse();
}
Kernel Device::kernel(const std::string&, std::uint32_t, std::uint32_t) {
  refuse();
}
std::vector<assign::ShaderStatistic> Device::statistics(Kernel) const {
  refuse();
}
std::uint64_t Device::reserve_flushed() {
  refuse();
}

// None of these can be reached: there is no Device.
Buffers::Buffers(Device&) {
  refuse();
}
Buffers::~Buffers() = default;
void Buffers::reserve(std::uint32_t, std::uint64_t, const char*) {}
std::uint64_t Buffers::bytes(std::uint32_t) const {
  return 0;
}
void Buffers::borrow(std::uint32_t, const Buffers&) {}
std::uint64_t Buffers::all_bytes() const {
  return 0;
}
Program::Program(Device&, const ProgramCode&) {
  refuse();
}
Program::~Program() = default;
void Program::bind(const Buffers&, std::span<const std::uint64_t>) {}
std::vector<assign::ShaderStatistic> Program::statistics() const {
  return {};
}
Commands::Commands(Device& device, Buffers& buffers) : device_(device.impl()), buffers_(buffers.impl()) {}
void Commands::upload(std::uint32_t, const void*, std::uint64_t) {}
void Commands::use(Buffers&) {}
void Commands::fill(std::uint32_t, std::uint32_t, std::uint64_t) {}
void Commands::dispatch(Kernel, const Arguments&, std::uint64_t) {}
void Commands::dispatch(const Program&, std::span<const std::byte>, std::array<std::uint32_t, 3>) {}
void Commands::dispatch_indirect(Kernel, const Arguments&, std::uint32_t) {}
void Commands::barrier(Barrier) {}
void Commands::flush() {}
std::uint32_t Commands::mark() {
  return 0;
}
void Commands::download(std::uint32_t, std::uint64_t) {}
void Commands::run() {}
double Commands::ns_between(std::uint32_t, std::uint32_t) const {
  return 0.0;
}
std::span<const std::uint32_t> Commands::downloaded(std::uint32_t) const {
  return {};
}

}  // namespace clusterbench::gpu
