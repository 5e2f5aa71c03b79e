// A device with no memory left, at each single call: nothing is left behind, one sentence says why, and the next one
// works.

#include "assign/contract/assigner_run.h"
#include "assign/settings.h"
#include "gpu/device_test.h"
#include "gpu/faults/made_and_destroyed.h"
#include "gpu/user_shaders/shader_method.h"
#include "gpu/vulkan/vulkan.h"
#include "places.h"

namespace clusterbench::gpu {
namespace {

using testing::CountedVulkan;

class DeviceFaults : public testing::DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    close_device();
  }
  void TearDown() override { close_device(); }

  // Does the work with each call of it failing, one after the other, until none is left.
  template <class Work>
  int each_fault(CountedVulkan& vulkan, Work work) {
    for (int call = 1; call < 1000; ++call) {
      vulkan.fail(call);
      try {
        work();
        EXPECT_EQ(vulkan.calls(), call - 1);
        return call - 1;
      } catch (const DeviceError& error) {
        EXPECT_TRUE(error.message().starts_with("the device has no memory left (vk")) << error.message();
        EXPECT_EQ(error.where(), "device");
      }
      vulkan.fail(0);
      const int left = vulkan.alive();
      EXPECT_EQ(left, 0) << "after call " << call;
      if (left != 0) return 0;
    }
    return 0;
  }
};

TEST_F(DeviceFaults, while_it_is_opened_leave_nothing_behind) {
  CountedVulkan vulkan;
  EXPECT_GE(each_fault(vulkan, [] { const Device opened(""); }), 7);
  EXPECT_EQ(vulkan.alive(), 0);
  EXPECT_EQ(objections().first, "");
}

TEST_F(DeviceFaults, while_buffers_and_kernels_are_made_leave_nothing_behind) {
  CountedVulkan vulkan;
  const auto work = [] {
    Device opened("");
    Buffers buffers(opened);
    buffers.reserve(0, 100'000, "words");
    opened.kernel("write", 64);
  };
  EXPECT_GE(each_fault(vulkan, work), 7 + 2 + 3 * static_cast<int>(Buffers::k_bindings) + 3 + 2);
  EXPECT_EQ(objections().first, "");
}

// Each method, from opening to its lists, then the same method with a device that works again.
TEST_F(DeviceFaults, while_a_method_works_leave_nothing_behind_and_the_next_frame_is_right) {
  CountedVulkan vulkan;
  add_shader_method(test::source_dir() + "/configs/shaders/tutorial.json");
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors()) {
    if (!row->on_device) continue;
    const assign::testing::Setting setting = assign::testing::settings_for(*row, 9).front();
    const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
    assign::Lists right;
    const auto work = [&] {
      struct Closes {
        ~Closes() { close_device(); }
      } behind;
      assign::AssignerRun run(*row, assign::Params(row->params),
                              row->own_lists ? assign::Answer::structure : assign::Answer::lists);
      run.build(setting.grid, assign::kinds_of(lights));
      run.assign(setting.input(lights));
      right = run.cell_lists();
    };
    vulkan.fail(0);
    work();
    const assign::Lists expected = right;
    EXPECT_GT(expected.pair_count(), 0u) << row->name;
    EXPECT_EQ(vulkan.alive(), 0) << row->name;
    EXPECT_GT(each_fault(vulkan, work), 60) << row->name;
    EXPECT_TRUE(right == expected) << row->name;
  }
  remove_shader_methods();
  EXPECT_EQ(objections().first, "");
}

}  // namespace
}  // namespace clusterbench::gpu
