#include "depth/depth_image.h"

#include <gtest/gtest.h>

namespace clusterbench::depth {
namespace {

TEST(PixelGrid, covers_the_picture_with_one_pixel_in_each_block) {
  const PixelGrid pixels({10, 7}, 4);
  EXPECT_EQ(pixels.size, Vec2i(3, 2));
  EXPECT_EQ(pixels.pixel(0), Vec2d(1.5, 1.5));
  EXPECT_EQ(pixels.pixel(5), Vec2d(8.5, 5.5));
  EXPECT_EQ(PixelGrid({10, 7}, 1).pixel(13), Vec2d(3.5, 1.5));
}

}  // namespace
}  // namespace clusterbench::depth
