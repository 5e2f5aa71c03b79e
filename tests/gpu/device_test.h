#pragma once
// What tests on a device share. CTest runs them on each software driver, as gpu.DRIVER.SUITE.NAME.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "assign/contract/assigner.h"
#include "gpu/device/device.h"
#include "gpu/methods/methods.h"

namespace clusterbench::gpu::testing {

class DeviceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    register_methods();
    if (const std::string obstacle = device_obstacle(); !obstacle.empty()) GTEST_SKIP() << "skipped: " << obstacle;
  }
};

// The methods on the device whose lists are those of common.glsl's tests, for every light and every cell: all but those
// that test cells themselves, too.
inline std::vector<const assign::AssignerDescriptor*> list_methods() {
  std::vector<const assign::AssignerDescriptor*> methods;
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors())
    if (row->on_device && row->conservative && !row->exact && !row->needs.depth &&
        row->answers(assign::Answer::lists) && row->name != "gpu-refined")
      methods.push_back(row);
  return methods;
}

}  // namespace clusterbench::gpu::testing
