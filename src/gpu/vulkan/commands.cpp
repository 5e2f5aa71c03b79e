#include <algorithm>
#include <chrono>
#include <cstring>
#include <optional>
#include <string>

#include "core/error.h"
#include "gpu/vulkan/device_impl.h"
#include "gpu/vulkan/program_impl.h"
#include "os/stop_signals.h"

namespace clusterbench::gpu {
namespace {

constexpr std::uint64_t k_wait_ns = 50'000'000;
constexpr std::chrono::seconds k_longest_run{600}, k_longest_after_signal{2};
constexpr std::uint64_t k_groups_in_a_row = 32768;  // devices take at least 65,535

}  // namespace

Commands::Commands(Device& device, Buffers& buffers)
    : device_(device.impl()), buffers_(buffers.impl()), turn_(device_.turn) {
  if (device_.is_stuck) throw DeviceError(device_.facts.name + " did not answer an earlier frame");
  buffers_.uploaded = 0;
  buffers_.downloads.clear();
  buffers_.mark_count = 0;
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkResetCommandPool(device_.device, device_.pool, 0), "vkResetCommandPool");
  check(vkBeginCommandBuffer(device_.commands, &info), "vkBeginCommandBuffer");
  vkCmdResetQueryPool(device_.commands, device_.marks, 0, Device::Impl::k_marks);
  vkCmdBindDescriptorSets(device_.commands, VK_PIPELINE_BIND_POINT_COMPUTE, device_.layout, 0, 1, &buffers_.set, 0,
                          nullptr);
}

void Commands::upload(std::uint32_t binding, const void* data, std::uint64_t bytes) {
  if (bytes == 0) return;
  Memory& staging = buffers_.to_device;
  if (buffers_.uploaded + bytes > staging.bytes) {
    const std::uint64_t outgrown_bytes = staging.bytes;
    if (buffers_.uploaded > 0)
      buffers_.outgrown.push_back(staging);
    else
      device_.free(staging);
    staging = {};
    buffers_.uploaded = 0;
    staging = device_.allocate(std::max({2 * bytes, 2 * outgrown_bytes, std::uint64_t{1} << 16}), Place::host_writes);
  }
  std::memcpy(static_cast<std::byte*>(staging.mapped) + buffers_.uploaded, data, bytes);
  const VkBufferCopy copy{buffers_.uploaded, 0, bytes};
  vkCmdCopyBuffer(device_.commands, staging.buffer, buffers_.at.at(binding).buffer, 1, &copy);
  buffers_.uploaded += (bytes + 15) / 16 * 16;
}

void Commands::fill(std::uint32_t binding, std::uint32_t word, std::uint64_t bytes) {
  if (bytes == 0) return;
  has_work_ = true;
  vkCmdFillBuffer(device_.commands, buffers_.at.at(binding).buffer, 0, bytes, word);
}

void Commands::use(Buffers& buffers) {
  vkCmdBindDescriptorSets(device_.commands, VK_PIPELINE_BIND_POINT_COMPUTE, device_.layout, 0, 1, &buffers.impl().set,
                          0, nullptr);
}

void Commands::bind(Kernel kernel, const Arguments& arguments) {
  has_work_ = true;
  const VkPipeline pipeline = device_.pipelines.at(kernel);
  if (device_.run_before.insert(pipeline).second) new_shaders_.push_back(device_.name_of(kernel));
  vkCmdBindPipeline(device_.commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  vkCmdPushConstants(device_.commands, device_.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof arguments.words,
                     arguments.words.data());
}

void Commands::dispatch(Kernel kernel, const Arguments& arguments, std::uint64_t groups) {
  if (groups == 0) return;
  bind(kernel, arguments);
  const std::uint64_t in_a_row = std::min(groups, k_groups_in_a_row);
  vkCmdDispatch(device_.commands, static_cast<std::uint32_t>(in_a_row),
                static_cast<std::uint32_t>((groups + in_a_row - 1) / in_a_row), 1);
}

void Commands::dispatch_indirect(Kernel kernel, const Arguments& arguments, std::uint32_t groups_binding) {
  bind(kernel, arguments);
  vkCmdDispatchIndirect(device_.commands, buffers_.at.at(groups_binding).buffer, 0);
}

void Commands::dispatch(const Program& program, std::span<const std::byte> arguments,
                        std::array<std::uint32_t, 3> groups) {
  if (groups[0] == 0 || groups[1] == 0 || groups[2] == 0) return;
  has_work_ = true;
  const Program::Impl& of = program.impl();
  if (device_.run_before.insert(of.pipeline).second) new_shaders_.push_back(of.name);
  vkCmdBindPipeline(device_.commands, VK_PIPELINE_BIND_POINT_COMPUTE, of.pipeline);
  vkCmdBindDescriptorSets(device_.commands, VK_PIPELINE_BIND_POINT_COMPUTE, of.layout, 0,
                          static_cast<std::uint32_t>(of.sets.size()), of.sets.data(), 0, nullptr);
  if (!arguments.empty())
    vkCmdPushConstants(device_.commands, of.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       static_cast<std::uint32_t>(arguments.size()), arguments.data());
  vkCmdDispatch(device_.commands, groups[0], groups[1], groups[2]);
}

void Commands::barrier(Barrier kind) {
  steps_ = steps();
  has_work_ = false;
  constexpr VkPipelineStageFlags k_work = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
  const VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_MEMORY_WRITE_BIT,
                               VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT};
  const VkPipelineStageFlags next =
      kind == Barrier::before_indirect ? k_work | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT : k_work;
  vkCmdPipelineBarrier(device_.commands, k_work, next, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

void Commands::flush() {
  barrier();
  vkCmdFillBuffer(device_.commands, device_.flushed.buffer, 0, device_.flushed.bytes, 0);
  barrier();
}

std::uint32_t Commands::mark() {
  if (device_.facts.timestamp_bits > 0)
    vkCmdWriteTimestamp(device_.commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, device_.marks, buffers_.mark_count);
  return buffers_.mark_count++;
}

void Commands::download(std::uint32_t binding, std::uint64_t bytes) {
  const std::uint64_t offset =
      buffers_.downloads.empty() ? 0 : buffers_.downloads.back().offset + buffers_.downloads.back().bytes;
  buffers_.downloads.push_back({binding, bytes, offset});
}

void Commands::run() {
  if (!buffers_.downloads.empty()) {
    const std::uint64_t bytes = buffers_.downloads.back().offset + buffers_.downloads.back().bytes;
    if (bytes > buffers_.to_host.bytes) {
      device_.free(buffers_.to_host);
      buffers_.to_host = device_.allocate(bytes + bytes / 4, Place::host_reads);
    }
    barrier();
    for (const Buffers::Impl::Download& one : buffers_.downloads) {
      if (one.bytes == 0) continue;
      const VkBufferCopy copy{0, one.offset, one.bytes};
      vkCmdCopyBuffer(device_.commands, buffers_.at.at(one.binding).buffer, buffers_.to_host.buffer, 1, &copy);
    }
    const VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_TRANSFER_WRITE_BIT,
                                 VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(device_.commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &memory, 0,
                         nullptr, 0, nullptr);
  }
  mark();
  check(vkEndCommandBuffer(device_.commands), "vkEndCommandBuffer");
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &device_.commands;
  const FrameCapture::Scope capture(device_.capture, new_shaders_);
  check(vkQueueSubmit(device_.queue, 1, &submit, device_.fence), "vkQueueSubmit");
  wait_for_end();
  check(vkResetFences(device_.device, 1, &device_.fence), "vkResetFences");
  for (Memory& memory : buffers_.outgrown) device_.free(memory);
  buffers_.outgrown.clear();
  if (device_.facts.timestamp_bits > 0)
    check(vkGetQueryPoolResults(device_.device, device_.marks, 0, buffers_.mark_count,
                                buffers_.mark_count * sizeof(std::uint64_t), buffers_.ticks.data(),
                                sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
  if (objections().count > 0)
    throw Error("", "device", "the validation layer objects: " + objections().first, ExitCode::internal);
  turn_.unlock();
}

// A step cannot be ended. Once a signal has stopped the program, one that goes on for long is left behind.
void Commands::wait_for_end() {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point began = Clock::now();
  std::optional<Clock::time_point> stopped;
  VkResult waited = VK_TIMEOUT;
  while (waited == VK_TIMEOUT && Clock::now() - began < k_longest_run) {
    waited = vkWaitForFences(device_.device, 1, &device_.fence, VK_TRUE, k_wait_ns);
    if (os::stop_signal() == 0 || waited != VK_TIMEOUT) continue;
    if (!stopped) stopped = Clock::now();
    if (Clock::now() - *stopped < k_longest_after_signal) continue;
    device_.is_stuck = true;
    throw DeviceError(device_.facts.name + " was still at work " + std::to_string(k_longest_after_signal.count()) +
                      " s after the signal that stopped this program");
  }
  device_.is_stuck = waited == VK_TIMEOUT;
  check(waited, "vkWaitForFences");
}

double Commands::ns_between(std::uint32_t first, std::uint32_t last) const {
  const std::uint32_t bits = device_.facts.timestamp_bits;
  if (bits == 0) return 0.0;
  const std::uint64_t mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  return static_cast<double>((buffers_.ticks[last] - buffers_.ticks[first]) & mask) * device_.facts.timestamp_period_ns;
}

std::span<const std::uint32_t> Commands::downloaded(std::uint32_t n) const {
  const Buffers::Impl::Download& one = buffers_.downloads.at(n);
  const auto* bytes = static_cast<const std::byte*>(buffers_.to_host.mapped) + one.offset;
  return {reinterpret_cast<const std::uint32_t*>(bytes), one.bytes / sizeof(std::uint32_t)};
}

}  // namespace clusterbench::gpu
