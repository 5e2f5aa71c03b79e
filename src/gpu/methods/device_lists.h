#pragma once
// The steps that methods with packed lists share: upload, counts of each cell, their sums, lists, and back to the host.

#include "gpu/methods/device_floor.h"
#include "gpu/methods/device_frame.h"

namespace clusterbench::gpu {

class DeviceLists : public assign::ListAssigner {
 public:
  void build(const grid::Grid& grid, const assign::LightKinds& kinds) final;
  void assign(const assign::FrameInput& input, assign::Lists& out) final;

  std::uint64_t tests_done() const final { return tests_; }
  const assign::DeviceSpans* device_spans() const final { return &spans_; }
  double device_floor_ns() final { return floor_.measured_ns(buffers(), spans_.dispatches, spans_.result_bytes); }
  std::size_t scratch_bytes() const final { return frame_.host_bytes() + frame_.buffers().all_bytes(); }

 protected:
  explicit DeviceLists(const assign::Params& params);

  // Of a method: makes room in the buffers of its own.
  virtual void reserve(const FrameArguments&) {}
  // Records what counts the lights of each cell, and what writes the lists to where the sums of the counts say.
  virtual void record_counts(Commands& commands, const FrameArguments& arguments) = 0;
  virtual void record_lists(Commands& commands, const FrameArguments& arguments) = 0;
  // Tests of lights against cells, or what they are tested against first: one row of a shader's work.
  virtual std::uint64_t tests_of(const FrameArguments& arguments) const = 0;

  DeviceFrame& frame() { return frame_; }
  Buffers& buffers() { return frame_.buffers(); }
  Kernel kernel(const char* shader, std::uint32_t group_size, Mode mode = Mode::count) {
    return frame_.device().kernel(shader, group_size, mode);
  }

 private:
  // Returns the number of entries that all lists need. Where that is more than the capacity, their ends are missing.
  std::uint32_t run_all(const view::LightArrays& lights, std::uint32_t capacity, assign::Lists& out);
  std::uint32_t capacity_for(std::uint32_t entries);
  void read_lists(std::uint32_t entries, assign::Lists& out);

  DeviceFrame frame_;
  DeviceFloor floor_;
  Kernel sum_blocks_, sum_sums_;
  std::uint32_t capacity_ = 0;  // of all lists
  std::uint64_t tests_ = 0;
  assign::DeviceSpans spans_;
};

// Groups of this size for one invocation each.
constexpr std::uint64_t groups_for(std::uint64_t invocations, std::uint32_t group_size) {
  return (invocations + group_size - 1) / group_size;
}

// Methods whose shader writes a bit for each cell and light, from which lists are made.
class MaskLists : public DeviceLists {
 protected:
  explicit MaskLists(const assign::Params& params);

  virtual void record_masks(Commands& commands, const FrameArguments& arguments) = 0;
  void reserve(const FrameArguments& arguments) final;
  void record_counts(Commands& commands, const FrameArguments& arguments) final;
  void record_lists(Commands& commands, const FrameArguments& arguments) final;

  static std::uint64_t mask_bytes(const FrameArguments& arguments) {
    return std::uint64_t{arguments.cells} * arguments.words * sizeof(std::uint32_t);
  }

 private:
  Kernel count_, fill_;
};

}  // namespace clusterbench::gpu
