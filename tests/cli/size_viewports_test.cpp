#include <gtest/gtest.h>

#include "cli/tool.h"

namespace clusterbench::test {
namespace {

// A shader of a level that is drawn in several sizes has one lookup, which takes the viewport.
TEST(SizeOverViewports, gives_a_shader_the_one_lookup_that_takes_the_viewport) {
  const std::string level = source_file("scenes/street.glb");
  for (const std::string grid : {"--tiles 64 --slices 8", "--tiles 16x9t --slices 8"}) {
    const Outcome size =
        tool("size " + level + " --viewport 640x360,320x180,300x170 --one-for-viewports --grid frustum " + grid +
             " --assigner exact-fast --set scenes.*.frames=2 --format hlsl --name lights -q");
    ASSERT_EQ(size.code, 0) << size.err;
    EXPECT_NE(size.out.find("int lights_lookup_cell_of(float2 pixel, float along, float2 viewport)"), std::string::npos)
        << size.out;
    EXPECT_EQ(size.out.find("lights_walk"), std::string::npos) << "a lookup of each viewport";
  }
}

// Cubical cells have other slices in each viewport: no function is the same for all.
TEST(SizeOverViewports, gives_a_lookup_of_each_viewport_where_slices_depend_on_it) {
  const Outcome size =
      tool("size " + source_file("scenes/street.glb") +
           " --viewport 640x360,320x180 --one-for-viewports --grid frustum --tiles 64 --scheme cubical "
           "--assigner exact-fast --set scenes.*.frames=2 --format hlsl --name lights -q");
  ASSERT_EQ(size.code, 0) << size.err;
  EXPECT_EQ(size.out.find("float2 viewport)"), std::string::npos) << size.out;
  EXPECT_NE(size.out.find("lights_walk_2_lookup_cell_of(float2 pixel, float along)"), std::string::npos) << size.out;
}

}  // namespace
}  // namespace clusterbench::test
