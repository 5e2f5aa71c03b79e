#pragma once
// Counts what Vulkan makes and destroys, and lets the n-th call that makes something fail.

namespace clusterbench::gpu::testing {

// From its constructor to its end. Devices that are opened meanwhile are counted, others are not.
class CountedVulkan {
 public:
  CountedVulkan();
  ~CountedVulkan();
  CountedVulkan(const CountedVulkan&) = delete;
  CountedVulkan& operator=(const CountedVulkan&) = delete;

  // The n-th call from now on (from 1) that makes an object, memory or a mapping reports that there is no memory left.
  void fail(int call);
  int calls() const;  // since then
  int alive() const;  // made, and not destroyed
};

}  // namespace clusterbench::gpu::testing
