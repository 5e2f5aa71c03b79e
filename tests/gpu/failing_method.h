#pragma once
// A method that says that it runs on a device, which fails when the test wants it to: what commands then keep.

#include <atomic>
#include <memory>

#include "assign/contract/assigner.h"
#include "gpu/device/device.h"

namespace clusterbench::gpu::testing {

// The lists of aabb.
class FailingMethod final : public assign::ListAssigner {
 public:
  // Of all such methods together: frames until the device fails, and how often it then does before it works again.
  static inline std::atomic<int> frames_left{0}, failures_left{0};
  static inline std::atomic<int> frames_done{0};

  static void fail_after(int frames, int failures = 1'000'000) {
    frames_left = frames;
    failures_left = failures;
    frames_done = 0;
  }

  explicit FailingMethod(const assign::Params& params) : aabb_(assign::find_assigner("aabb")->make(params)) {}
  void build(const grid::Grid& grid, const assign::LightKinds& kinds) override { aabb_->build(grid, kinds); }
  void assign(const assign::FrameInput& input, assign::Lists& out) override {
    if (frames_left-- <= 0 && failures_left-- > 0) throw DeviceError("the device was lost");
    ++frames_done;
    aabb_->assign(input, out);
  }
  std::uint64_t tests_done() const override { return aabb_->tests_done(); }
  std::size_t scratch_bytes() const override { return aabb_->scratch_bytes(); }
  const assign::DeviceSpans* device_spans() const override { return &spans_; }
  double device_floor_ns() override { return 500.0; }

 private:
  std::unique_ptr<assign::ListAssigner> aabb_;
  assign::DeviceSpans spans_{100.0, 2000.0, 30.0, 3, 64};
};

inline assign::AssignerDescriptor failing_method(const std::string& name = "fails") {
  assign::AssignerDescriptor row = *assign::find_assigner("aabb");
  row.name = name;
  row.by_name = row.on_device = true;
  row.make = [](const assign::Params& params) -> std::unique_ptr<assign::ListAssigner> {
    return std::make_unique<FailingMethod>(params);
  };
  return row;
}

}  // namespace clusterbench::gpu::testing
