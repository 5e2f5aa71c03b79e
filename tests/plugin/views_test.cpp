// What a plug-in sees of a frame, against numbers by hand.

#include "plugin/views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "assign/settings.h"

namespace clusterbench::plugin::testing {
namespace {

using assign::testing::settings::far_and_turned;

// A point through a matrix in columns; w last.
Vec4d times(const double* m, const Vec4d& v) {
  Vec4d out(0.0);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) out[row] += m[4 * column + row] * v[column];
  return out;
}

Vec3d projected(const clusterbench_frame& frame, const Vec3d& view) {
  const Vec4d clip = times(frame.clip_from_view, {view.x, view.y, view.z, 1.0});
  return Vec3d(clip) / clip.w;
}

void expect_near(const Vec3d& found, const Vec3d& expected) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], expected[axis], 1e-9) << axis;
}

view::Frame frame_with(const view::Projection& projection) {
  view::Frame frame;
  frame.viewport = {320, 200};
  frame.projection = projection;
  frame.view_space = far_and_turned();
  return frame;
}

TEST(ViewOfFrame, corners_of_the_view_are_corners_of_clip_space) {
  const view::Projection perspective{false, -0.5, 1.5, -0.25, 0.75, 0.5, 20.0};
  const clusterbench_frame frame = view_of(frame_with(perspective), nullptr);
  expect_near(projected(frame, {-0.5 * 0.5, -0.25 * 0.5, -0.5}), {-1, -1, 0});
  expect_near(projected(frame, {1.5 * 20, 0.75 * 20, -20}), {1, 1, 1});
  const view::Projection orthographic{true, -4.0, 12.0, -3.0, 1.0, -2.0, 30.0};
  const clusterbench_frame flat = view_of(frame_with(orthographic), nullptr);
  expect_near(projected(flat, {-4, -3, 2}), {-1, -1, 0});
  expect_near(projected(flat, {12, 1, -30}), {1, 1, 1});
}

TEST(ViewOfFrame, a_far_plane_may_be_at_infinity) {
  const view::Projection endless{false, -1, 1, -1, 1, 0.5, std::numeric_limits<double>::infinity()};
  const clusterbench_frame frame = view_of(frame_with(endless), nullptr);
  expect_near(projected(frame, {0, 0, -0.5}), {0, 0, 0});
  EXPECT_NEAR(projected(frame, {0, 0, -1e12}).z, 1.0, 1e-9);
  EXPECT_TRUE(std::isinf(frame.far_plane));
}

TEST(ViewOfFrame, the_eye_is_the_origin_of_view_space) {
  const view::Frame given = frame_with({false, -1, 1, -1, 1, 0.1, 10});
  const clusterbench_frame frame = view_of(given, nullptr);
  expect_near(Vec3d(times(frame.view_from_world, {frame.eye[0], frame.eye[1], frame.eye[2], 1})), {0, 0, 0});
  const Vec3d place = given.view_space.origin + Vec3d{3, -5, 7};
  expect_near(Vec3d(times(frame.view_from_world, {place.x, place.y, place.z, 1})),
              given.view_space.rotation * Vec3d{3, -5, 7});
  EXPECT_EQ(frame.viewport[0], 320u);
  EXPECT_EQ(frame.viewport[1], 200u);
  EXPECT_EQ(frame.depth, nullptr);
}

// The exact position, by the numbers of the interface, rounds to the position in single precision.
TEST(ViewOfLights, exact_numbers_and_rounded_ones_belong_together) {
  for (const assign::AssignerDescriptor* row :
       {assign::find_assigner("brute-force"), assign::find_assigner("light-boxes")})
    for (const assign::testing::Setting& setting : assign::testing::settings_for(*row, 9)) {
      const view::LightArrays arrays = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
      const clusterbench_lights lights = view_of(arrays);
      ASSERT_EQ(lights.point_count + lights.spot_count + lights.box_count, setting.frame.lights.size());
      for (std::uint32_t i = 0; i < setting.frame.lights.size(); ++i) {
        const auto at = [&](const double* first) {
          return reinterpret_cast<const double*>(reinterpret_cast<const char*>(first) + i * lights.world_stride);
        };
        for (int axis = 0; axis < 3; ++axis) {
          double exact = 0.0;
          for (int k = 0; k < 3; ++k)
            exact += lights.space_rotation[3 * axis + k] * (at(lights.world_position)[k] - lights.space_origin[k]);
          const float rounded = axis == 0 ? lights.x[i] : axis == 1 ? lights.y[i] : lights.z[i];
          EXPECT_NEAR(rounded, exact, 1e-6 * std::abs(exact) + 1e-9) << setting.name;
        }
        EXPECT_EQ(*at(lights.world_radius), setting.frame.lights[i].range_m);
        EXPECT_EQ(*at(lights.world_angle), setting.frame.lights[i].outer_cone_rad);
        EXPECT_EQ(at(lights.world_half_axes)[8], setting.frame.lights[i].half_axes_m[2].z);
        EXPECT_EQ(at(lights.world_axis)[2], setting.frame.lights[i].direction.z);
        if (setting.frame.ranges().is_box(i)) {
          EXPECT_EQ(lights.half_axes[9 * (i - lights.point_count - lights.spot_count) + 8],
                    arrays.half_axes[i - arrays.boxes.first][2].z);
        }
      }
    }
}

}  // namespace
}  // namespace clusterbench::plugin::testing
