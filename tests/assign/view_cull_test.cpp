#include "assign/grid_cull/view_cull.h"

#include <gtest/gtest.h>

#include "assign/settings.h"

namespace clusterbench::assign {
namespace {

using testing::Setting;

// 90 degrees wide and high, 1 to 21 m deep.
grid::ScreenGrid square_view(grid::Kind kind = grid::Kind::frustum) {
  const view::Frame frame = testing::frame_of({false, -1, 1, -1, 1, 1, 21}, {1000, 1000}, {});
  grid::GridSpec spec;
  spec.kind = kind;
  spec.tiles.count = {10, 10};
  spec.slices = {.scheme = grid::Scheme::list, .boundaries_m = {1, 5, 21}};
  return testing::grid_of(spec, frame).screen();
}

TEST(ViewCull, leaves_out_a_ball_beyond_any_side_or_end_and_none_that_reaches_in) {
  const ViewCull view(square_view());
  const float inwards = std::sqrt(0.5f);  // of the sides' normals
  for (const Vec3f& out : {Vec3f{inwards, 0, inwards}, Vec3f{-inwards, 0, inwards}, Vec3f{0, inwards, inwards},
                           Vec3f{0, -inwards, inwards}, Vec3f{0, 0, -1}, Vec3f{0, 0, 1}}) {
    // From the middle of the view to its side or end, and 3 m further.
    const Vec3f middle{0, 0, -10};
    const float way = out.z == 1.0f ? 9.0f : out.z == -1.0f ? 11.0f : 10.0f * inwards;
    const Vec3f center = middle + (way + 3.0f) * out;
    EXPECT_TRUE(view.misses({center, 2.999f})) << out.x << " " << out.y << " " << out.z;
    EXPECT_FALSE(view.misses({center, 3.001f})) << out.x << " " << out.y << " " << out.z;
    EXPECT_FALSE(view.misses({middle, 0.5f}));
  }
  EXPECT_FALSE(view.misses({{0, 0, 1e6f}, std::numeric_limits<float>::infinity()}));
}

TEST(ViewCull, of_shells_begins_at_the_eye) {
  const ViewCull view(square_view(grid::Kind::distance));
  EXPECT_FALSE(view.misses({{0, 0, -0.5f}, 0.1f}));
  EXPECT_TRUE(view.misses({{0, 0, 3.0f}, 2.0f}));
  EXPECT_FALSE(view.misses({{0, 0, 3.0f}, 3.1f}));
  EXPECT_TRUE(view.misses({{0, 0, -24.0f}, 2.9f}));
}

// Lights that touch cells by a hair, too, and are not padded.
TEST(ViewCull, leaves_out_no_ball_that_is_listed) {
  for (const char* name : {"exact-fast", "distance-fast"}) {
    const AssignerDescriptor& row = *find_assigner(name);
    for (const Setting& setting : testing::settings_for(row, 4)) {
      const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
      const auto assigner = row.make(Params(row.params));
      assigner->build(setting.grid);
      Lists lists;
      assigner->assign({setting.frame, lights}, lists);
      const ViewCull view(setting.grid.screen());
      for (const std::uint32_t light : lists.lights)
        ASSERT_FALSE(view.misses(lights.ball(light, 0.0f))) << setting.name << ", light " << light;
    }
  }
}

}  // namespace
}  // namespace clusterbench::assign
