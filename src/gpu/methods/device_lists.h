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
  std::vector<assign::ShaderStatistic> shader_statistics() const final { return frame_.statistics_of(kernels_); }
  const assign::DeviceSpans* device_spans() const final { return &spans_; }
  void repeat_on_device(const assign::DeviceRepeats& repeats) final { frame_.repeat(repeats); }
  double device_floor_ns() final { return floor_.measured_ns(buffers(), spans_, frame_.repeats()); }
  std::optional<double> device_build_ns() final { return frame_.device_build_ns(); }
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
  Kernel kernel(const char* shader, std::uint32_t group_size, std::uint32_t mode = Mode::count) {
    kernels_.push_back(frame_.device().kernel(shader, group_size, mode));
    return kernels_.back();
  }

 private:
  void record_run(Commands& commands, const FrameArguments& arguments);
  // Returns the number of entries that all lists need. Where that is more than the capacity, their ends are missing.
  std::uint32_t run_all(const view::LightArrays& lights, std::uint32_t capacity, assign::Lists& out);
  std::uint32_t capacity_for(std::uint32_t entries);
  void read_lists(std::uint32_t entries, assign::Lists& out);

  DeviceFrame frame_;
  DeviceFloor floor_;
  std::vector<Kernel> kernels_;
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
  // Records more into the step behind record_masks(), which reads the masks alone.
  virtual void record_beside_counts(Commands&) {}
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
