// Searches whose method's device fails on the way.

#include <gtest/gtest.h>

#include "gpu/failing_method.h"
#include "search/worst_case_fixture.h"

namespace clusterbench::search::test {
namespace {

using gpu::testing::FailingMethod;

Json lights_around() {
  std::vector<TestLight> lights;
  for (int i = 0; i < 30; ++i) lights.push_back({{i % 6 - 3.0, i % 3 * 1.0, -1.0 * i}, 1.0 + 0.1 * i});
  return scene_json(lights, {{0.0, 1.5, 8.0}});
}

TEST(WorstCaseOnADevice, that_fails_keeps_what_was_found_by_then) {
  const assign::AssignerRegistration registration(gpu::testing::failing_method());
  const SearchFolder folder;
  const Searched whole = searched(folder, lights_around(), frustum(), "fails");
  FailingMethod::fail_after(1'000'000);
  const WorstCase all = whole.search(few(400));
  EXPECT_EQ(all.ended, Ended::evaluations);
  EXPECT_EQ(all.device_failure, "");
  for (const int frames : {20, 150, 300, 420}) {  // in each stage, and among the random frames
    FailingMethod::fail_after(frames);
    const WorstCase cut = whole.search(few(400));
    EXPECT_EQ(cut.ended, Ended::device) << frames;
    EXPECT_EQ(cut.device_failure, "the device was lost");
    ASSERT_EQ(cut.frames.size(), 1u);
    EXPECT_GE(cut.frames[0].value, cut.recorded.max);
    EXPECT_LE(cut.frames[0].value, all.frames[0].value);
    EXPECT_LE(cut.evaluations, frames);
    EXPECT_GE(cut.evaluations, std::min(frames, 400) - 20) << "but those of the path and of warming up";
    EXPECT_TRUE(cut.buffers.empty()) << "nothing could measure them";
    EXPECT_GT(cut.lights_in_view, 0u);
    EXPECT_EQ(cut.path_scene.cameras.size(), all.path_scene.cameras.size()) << "the path can be written";
  }
}

TEST(WorstCaseOnADevice, that_fails_once_measures_the_path_after_all) {
  const assign::AssignerRegistration registration(gpu::testing::failing_method());
  const SearchFolder folder;
  const Searched whole = searched(folder, lights_around(), frustum(), "fails");
  FailingMethod::fail_after(150, 1);
  const WorstCase cut = whole.search(few(400));
  EXPECT_EQ(cut.ended, Ended::device);
  EXPECT_FALSE(cut.buffers.empty());
  EXPECT_TRUE(cut.theoretical_max);
}

TEST(WorstCaseOnADevice, that_fails_before_the_first_frame_is_an_error_with_the_reason) {
  const assign::AssignerRegistration registration(gpu::testing::failing_method());
  const SearchFolder folder;
  const Searched whole = searched(folder, lights_around(), frustum(), "fails");
  for (const int frames : {0, 1}) {  // of the path, and of the search
    FailingMethod::fail_after(frames);
    EXPECT_THROW(whole.search(few(400)), gpu::DeviceError) << frames;
  }
}

}  // namespace
}  // namespace clusterbench::search::test
