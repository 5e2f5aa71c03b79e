// Matrices and numbers that users' shaders are told.

#include "gpu/user_shaders/known_values.h"

#include <cmath>

#include <gtest/gtest.h>

#include "assign/settings.h"

namespace clusterbench::gpu {
namespace {

using assign::testing::Setting;

result::ShaderMethod method_with(const char* depth, const char* clip_y, const char* forward, const char* order) {
  result::ShaderMethod method;
  method.camera.emplace();
  method.camera->depth = depth;
  method.camera->clip_y = clip_y;
  method.camera->forward = forward;
  method.camera->order = order;
  return method;
}

Setting setting_with(const view::Projection& projection) {
  Setting setting;
  setting.frame = assign::testing::frame_of(projection, {1280, 720}, {});
  setting.frame.view_space = assign::testing::settings::far_and_turned();
  setting.grid = assign::testing::grid_of(
      assign::testing::settings::screen_spec(grid::Kind::frustum, {4, 3}, grid::Scheme::linear, 5, 0.0), setting.frame);
  return setting;
}

Mat4d matrix_of(const FrameValues& values, const char* name, bool is_by_rows = false) {
  const std::vector<double> numbers = values.numbers(name, "");
  Mat4d out(0.0);
  for (int i = 0; i < 16; ++i)
    (is_by_rows ? out[i % 4][i / 4] : out[i / 4][i % 4]) = numbers[static_cast<std::size_t>(i)];
  return out;
}
Vec3d projected(const Mat4d& matrix, const Vec3d& point) {
  const Vec4d clip = matrix * Vec4d(point, 1.0);
  return {clip.x / clip.w, clip.y / clip.w, clip.z / clip.w};
}

void expect_near(const Vec3d& found, const Vec3d& wanted, double off, const std::string& where) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], wanted[i], off) << where << ", axis " << i;
}

// The corners of the picture at the near and the far plane, in every convention.
TEST(KnownValues, have_matrices_that_map_corners_to_corners) {
  const double endless = std::numeric_limits<double>::infinity();
  for (const view::Projection& projection : {view::Projection{false, -0.9, 0.9, -0.5, 0.5, 0.1, 300.0},
                                             view::Projection{false, -0.3, 1.1, -0.9, 0.2, 0.5, endless},
                                             view::Projection{true, -40.0, 20.0, -10.0, 22.5, 1.0, 200.0}})
    for (const char* depth : {"0..1", "-1..1", "1..0"})
      for (const char* clip_y : {"up", "down"})
        for (const char* forward : {"-z", "+z"})
          for (const char* order : {"columns", "rows"}) {
            const std::string where = std::string(depth) + " " + clip_y + " " + forward + " " + order;
            const bool is_by_rows = order == std::string("rows");
            const result::ShaderMethod method = method_with(depth, clip_y, forward, order);
            const Setting setting = setting_with(projection);
            const FrameValues values(method, {}, setting.frame, setting.grid.screen(), {});
            const Mat4d to_clip = matrix_of(values, "projection", is_by_rows);
            const double sign = depth_sign(method), up = clip_y == std::string("up") ? 1.0 : -1.0;
            const double at_near = depth == std::string("0..1")   ? 0.0
                                   : depth == std::string("1..0") ? 1.0
                                                                  : -1.0,
                         at_far = depth == std::string("1..0") ? 0.0 : 1.0;
            for (const bool is_far : {false, true}) {
              const double z = is_far ? std::min(projection.far_m, 1e9) : projection.near_m,
                           scale = projection.orthographic ? 1.0 : z;
              const Vec3d corner{projection.right * scale, projection.top * scale, -z},
                  other{projection.left * scale, projection.bottom * scale, -z};
              for (const auto& [view, x] : {std::pair(corner, 1.0), std::pair(other, -1.0)}) {
                const Vec3d seen{view.x, view.y, sign * view.z}, wanted{x, x * up, is_far ? at_far : at_near};
                expect_near(projected(to_clip, seen), wanted, 1e-6, where);
                const Vec3d world =
                    setting.frame.view_space.origin + glm::transpose(setting.frame.view_space.rotation) * view;
                if (!is_far)
                  expect_near(projected(matrix_of(values, "world_to_clip", is_by_rows), world), wanted, 1e-6, where);
                if (!is_far)
                  expect_near(projected(matrix_of(values, "inverse_projection", is_by_rows), wanted), seen, 1e-6,
                              where);
              }
            }
          }
}

TEST(KnownValues, all_have_as_many_numbers_as_they_say) {
  const Setting setting = setting_with({false, -0.9, 0.9, -0.5, 0.5, 0.1, 300.0});
  const FrameValues values({}, {}, setting.frame, setting.grid.screen(), view::LightRanges(40, 7));
  const std::map<std::string, double> numbers{
      {"cells", 60.0},      {"columns", 4.0},           {"rows", 3.0},    {"slices", 5.0},
      {"tiles", 12.0},      {"lights", 47.0},           {"points", 40.0}, {"spots", 7.0},
      {"light_words", 2.0}, {"viewport_width", 1280.0}, {"near", 0.1}};
  for (const auto& [name, number] : numbers) EXPECT_EQ(values.numbers(name, ""), std::vector<double>{number}) << name;
  for (const KnownValue& value : known_values())
    EXPECT_TRUE(value.numbers == 0 || values.numbers(value.name, "").size() == value.numbers) << value.name;
  EXPECT_EQ(values.numbers("slice_boundaries", "").size(), 6u);
  EXPECT_EQ(values.numbers("column_boundaries", "").size(), 5u);
  EXPECT_EQ(values.numbers("row_boundaries", "").size(), 4u);
  EXPECT_EQ(values.numbers("tile_pixels", ""), (std::vector<double>{320.0, 240.0}));
}

}  // namespace
}  // namespace clusterbench::gpu
