#include "scene/camera_jitter.h"

#include <gtest/gtest.h>

namespace clusterbench::scene {
namespace {

TEST(CameraJitter, halton_offsets_are_mirrored_digits_within_a_pixel) {
  const std::vector<Vec2d> offsets = halton_jitter(6);
  ASSERT_EQ(offsets.size(), 6u);
  const double x[] = {0.5, 0.25, 0.75, 0.125, 0.625, 0.375};
  const double y[] = {1.0 / 3, 2.0 / 3, 1.0 / 9, 4.0 / 9, 7.0 / 9, 2.0 / 9};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_DOUBLE_EQ(offsets[i].x + 0.5, x[i]);
    EXPECT_NEAR(offsets[i].y + 0.5, y[i], 1e-15);
  }
}

}  // namespace
}  // namespace clusterbench::scene
